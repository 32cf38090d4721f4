#include <fmt/format.h>

#include <unistd.h>

#include <limits>
#include <zlg/logs/error.hpp>
#include <zlg/logs/table_file.hpp>

#include "part_file.hpp"

namespace zlg::logs {

namespace {

// Large enough that the system call costs nothing beside the formatting.
constexpr std::size_t block_bytes = std::size_t{1} << 20;

}  // namespace

struct TableFile::State {
    State(std::string path, bool force) : file{std::move(path), force} { buffer.reserve(2 * block_bytes); }

    ~State() {
        if (!file.is_open() || keep_from == never) return;
        try {
            flush();
            give_up();
        } catch (const IoError&) {
            // What could be written was kept by `flush`, and nobody is left to be informed.
            return;
        }
    }

    // What was lost once cannot be completed: nothing appears under the name any more.
    void flush() {
        const Written written = write_all(file.fd(), buffer, written_bytes);
        const std::size_t line_end = std::string_view{buffer}.substr(0, written.n).rfind('\n');
        if (line_end != std::string_view::npos) whole_bytes = written_bytes + line_end + 1;
        written_bytes += written.n;
        if (written.error != 0) fail(written.error);
        buffer.clear();
        if (has_rows_to_keep()) file.keep_if_abandoned();
    }

    [[noreturn]] void fail(int error) {
        give_up();
        fail_io("write", file.part(), error);
    }

    // What is still in the buffer goes to its place in the file first.
    void overwrite(std::size_t at, std::string_view text) {
        flush();
        if (const int error = write_all(file.fd(), text, at).error; error != 0) fail(error);
    }

    [[nodiscard]] bool has_rows_to_keep() const { return whole_bytes > keep_from; }

    // Only whole lines stay, if any.
    void give_up() {
        if (has_rows_to_keep() && ::ftruncate(file.fd(), static_cast<off_t>(whole_bytes)) == 0)
            file.keep();
        else
            file.discard();
    }

    void require_open(const char* what) const {
        if (!file.is_open()) throw IoError(fmt::format("cannot {} {}: it is closed", what, file.part()));
    }

    static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

    PartFile file;
    std::string buffer;
    std::size_t written_bytes = 0;
    std::size_t whole_bytes = 0;  // of them, up to the end of a line
    std::size_t keep_from = never;
};

TableFile::TableFile(std::string path, bool force) : state_{std::make_unique<State>(std::move(path), force)} {}
TableFile::~TableFile() = default;
TableFile::TableFile(TableFile&&) noexcept = default;
TableFile& TableFile::operator=(TableFile&&) noexcept = default;

const std::string& TableFile::part_path() const { return state_->file.part(); }

void TableFile::append(std::string_view text) {
    State& s = *state_;
    s.require_open("write");
    s.buffer += text;
    if (s.buffer.size() >= block_bytes) s.flush();
}

void TableFile::overwrite(std::size_t at, std::string_view text) {
    state_->require_open("write");
    state_->overwrite(at, text);
}

void TableFile::flush() {
    state_->require_open("write");
    state_->flush();
}

void TableFile::close() {
    state_->require_open("close");
    state_->flush();
    state_->file.complete(state_->has_rows_to_keep());
}

void TableFile::keep_what_follows() { state_->keep_from = state_->written_bytes + state_->buffer.size(); }

}  // namespace zlg::logs
