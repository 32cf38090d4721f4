// A plug-in of QEMU that counts the instructions of each half-period, module by module, while the image runs unchanged.
//
// bench/count_image gives it `table`, lines of `kind begin end number` with addresses in hexadecimal:
//   module      instructions from here to there count for the module of this number
//   half        the half-period's interrupt begins at this address
//   background  a half-period has ended when the processor is here again
//   work        the module of this number works in the background, too
// and `out`, to which it writes one row of 32-bit counts for each half-period, in the order of the modules' numbers;
// the last number of a row is what the modules of `work` took in the background before it.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// Version 1 of QEMU's interface for plug-ins; Debian has no header of it.
extern "C" {

struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info_t;
using qemu_plugin_id_t = std::uint64_t;

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_cb(qemu_plugin_tb*, void (*)(unsigned, void*), int flags, void*);
void qemu_plugin_register_vcpu_tb_exec_inline(qemu_plugin_tb*, int operation, void*, std::uint64_t);
void qemu_plugin_register_vcpu_insn_exec_inline(qemu_plugin_insn*, int operation, void*, std::uint64_t);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void*), void*);
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb*);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb*, std::size_t);
std::uint64_t qemu_plugin_tb_vaddr(const qemu_plugin_tb*);
std::uint64_t qemu_plugin_insn_vaddr(const qemu_plugin_insn*);

[[gnu::visibility("default")]] extern const int qemu_plugin_version;
const int qemu_plugin_version = 1;

}  // extern "C"

namespace {

constexpr int no_registers = 0;
constexpr int add_u64 = 0;

struct Range {
    std::string kind;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::size_t number = 0;
};

class Counter {
public:
    Counter(const std::string& table, const std::string& out) : out_{std::fopen(out.c_str(), "wb")} {
        // The emulator may be ended by a signal: nothing waits in a buffer.
        if (out_ != nullptr) std::setvbuf(out_, nullptr, _IONBF, 0);
        std::ifstream lines{table};
        for (Range r; lines >> r.kind >> std::hex >> r.begin >> r.end >> std::dec >> r.number;) ranges_.push_back(r);
        std::size_t n = 0;
        for (const Range& r : ranges_) n = std::max(n, r.number + 1);
        counts_.resize(n);
    }

    [[nodiscard]] bool is_good() const { return out_ != nullptr && !counts_.empty(); }

    // A block runs from its first instruction to its last.
    void translate(qemu_plugin_tb* block) {
        const std::uint64_t address = qemu_plugin_tb_vaddr(block);
        if (find("background", address) != nullptr)
            qemu_plugin_register_vcpu_tb_exec_cb(
                block, [](unsigned, void* self) { as(self).end(); }, no_registers, this);
        const bool begins = find("half", address) != nullptr;
        if (begins)
            qemu_plugin_register_vcpu_tb_exec_cb(
                block, [](unsigned, void* self) { as(self).begin(); }, no_registers, this);
        std::map<std::size_t, std::uint64_t> in_block;
        for (std::size_t k = 0; k < qemu_plugin_tb_n_insns(block); ++k) {
            qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(block, k);
            const Range* module = find("module", qemu_plugin_insn_vaddr(instruction));
            if (module == nullptr) continue;
            // Those of the first block are counted one by one: surely after `begin`.
            if (begins)
                qemu_plugin_register_vcpu_insn_exec_inline(instruction, add_u64, &counts_[module->number], 1);
            else
                ++in_block[module->number];
        }
        for (const auto& [number, n] : in_block)
            qemu_plugin_register_vcpu_tb_exec_inline(block, add_u64, &counts_[number], n);
    }

    void close() {
        std::fclose(out_);
        out_ = nullptr;
    }

private:
    static Counter& as(void* self) { return *static_cast<Counter*>(self); }

    [[nodiscard]] const Range* find(std::string_view kind, std::uint64_t address) const {
        const auto hit = std::find_if(ranges_.begin(), ranges_.end(), [&](const Range& r) {
            return r.kind == kind && r.begin <= address && address < r.end;
        });
        return hit == ranges_.end() ? nullptr : &*hit;
    }

    void begin() {
        in_background_ = 0;
        for (const Range& r : ranges_)
            if (r.kind == "work") in_background_ += counts_[r.number];
        std::fill(counts_.begin(), counts_.end(), 0);
        in_half_ = true;
    }

    void end() {
        if (!in_half_ || out_ == nullptr) return;
        in_half_ = false;
        std::vector<std::uint32_t> row(counts_.begin(), counts_.end());
        row.push_back(static_cast<std::uint32_t>(in_background_));
        // What follows is the background's.
        std::fill(counts_.begin(), counts_.end(), 0);
        std::fwrite(row.data(), sizeof(std::uint32_t), row.size(), out_);
    }

    std::vector<Range> ranges_;
    std::vector<std::uint64_t> counts_;  // QEMU keeps the addresses of its elements
    std::uint64_t in_background_ = 0;
    bool in_half_ = false;
    std::FILE* out_;
};

// Never destroyed: the emulator may still call when the destructors of static objects have run.
Counter* counter = nullptr;

std::string argument(std::string_view name, int n, char** all) {
    for (int k = 0; k < n; ++k) {
        const std::string_view word{all[k]};
        if (word.starts_with(name) && word.substr(name.size()).starts_with('='))
            return std::string{word.substr(name.size() + 1)};
    }
    return {};
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t*, int n,
                                                                  char** all);

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t*, int n, char** all) {
    counter = std::make_unique<Counter>(argument("table", n, all), argument("out", n, all)).release();
    if (!counter->is_good()) {
        std::fputs("image_counter: needs table=FILE and out=FILE\n", stderr);
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id,
                                          [](qemu_plugin_id_t, qemu_plugin_tb* block) { counter->translate(block); });
    qemu_plugin_register_atexit_cb(
        id, [](qemu_plugin_id_t, void*) { counter->close(); }, nullptr);
    return 0;
}
