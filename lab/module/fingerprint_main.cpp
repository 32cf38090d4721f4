// Runs the closed loop of one configuration for run.duration_s and says in one line what came out, so that compilers and machines can
// be held against each other.
//
// usage: zlg_loop_fingerprint [section.key=value...]

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <zlg/core/records.hpp>

#include "loop_run.hpp"

namespace {

using namespace zlg;

// FNV-1a, 64 bits, of whole numbers by their bytes.
class Hash {
public:
    void add(std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) sum_ = (sum_ ^ ((word >> (8 * byte)) & 0xff)) * 0x100000001b3u;
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    [[nodiscard]] std::uint64_t sum() const { return sum_; }

private:
    std::uint64_t sum_ = 0xcbf29ce484222325u;
};

void add(Hash& hash, const core::HalfRecord& half) {
    hash.add(static_cast<std::uint64_t>(half.counts));
    hash.add(static_cast<std::uint64_t>(half.bias_sign * half.mode));
    hash.add(half.detuning_lambda);
    hash.add(half.detuning_sq_lambda2);
    hash.add(half.piezo_v);
    hash.add(half.temperature_c);
}

void add(Hash& hash, const core::AngleRow& row) {
    hash.add(row.dtheta_arcsec);
    hash.add(row.dtheta_final_arcsec);
    hash.add(row.sigma_arcsec);
    hash.add(std::uint64_t{row.flags});
}

std::string run(const std::vector<std::string>& settings) {
    lab::LoopRun loop{lab::configured(settings)};
    Hash records, rows;
    const auto add_row = [&](const core::AngleRow& row) { add(rows, row); };
    while (loop.halves() < loop.run_halves()) add(records, loop.advance(add_row).record);
    loop.end(add_row);
    return fmt::format("{} half-periods, records {:016x}, angles {:016x}\n", loop.halves(), records.sum(), rows.sum());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        std::fputs(run({argv + 1, argv + argc}).c_str(), stdout);
        return EXIT_SUCCESS;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "zlg_loop_fingerprint: %s\n", error.what());
        return EXIT_FAILURE;
    }
}
