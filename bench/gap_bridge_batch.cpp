// gap_bridge over ten million ticks in memory, against copying what goes in and what comes out.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <zlg/core/compensation/gap_bridge.hpp>

#include "paired.hpp"

namespace {

using namespace zlg;

constexpr std::size_t n_ticks = 10'000'000;
constexpr std::size_t interval_ticks = 18'000;  // 90 s
constexpr std::size_t gap_ticks = 3;

std::vector<core::TickInput> recorded() {
    std::vector<core::TickInput> ticks(n_ticks);
    for (std::size_t k = 0; k < n_ticks; ++k) {
        core::TickInput& tick = ticks[k];
        tick.measured = k % interval_ticks >= gap_ticks;
        tick.value_arcsec = 3.263 * std::floor(18.0 * std::sin(0.22 * static_cast<double>(k)));
        tick.variance_arcsec2 = 1.77;
        tick.mode = (k / interval_ticks) % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
        tick.flags = tick.measured ? 0u : std::uint32_t{core::flag_loop_unlocked};
    }
    return ticks;
}

std::size_t bridge(const std::vector<core::TickInput>& ticks, std::vector<core::AngleRow>& rows) {
    const core::CompensationConstants gyro;
    const core::GapBridgeConfig config;
    core::GapBridgeState state;
    std::size_t n = 0;
    for (const core::TickInput& tick : ticks) {
        const core::AngleSample sample = step(gyro, config, state, tick);
        if (sample.has_final) rows[n++] = sample.final_row;
    }
    for (auto out = drain(gyro, config, state); out.has_row || out.has_gap; out = drain(gyro, config, state))
        if (out.has_row) rows[n++] = out.row;
    return n;
}

}  // namespace

int main() {
    const std::vector<core::TickInput> ticks = recorded();
    std::vector<core::TickInput> ticks_copy = ticks;
    std::vector<core::AngleRow> rows(n_ticks);
    std::vector<core::AngleRow> rows_copy(n_ticks);
    std::size_t n = 0;
    const auto result = bench::paired(
        7, [&] { n = bridge(ticks, rows); },
        [&] {
            std::copy(ticks.begin(), ticks.end(), ticks_copy.begin());
            std::copy(rows.begin(), rows.end(), rows_copy.begin());
        });
    constexpr double bytes = n_ticks * (sizeof(core::TickInput) + sizeof(core::AngleRow));
    fmt::print("gap_bridge, {} ticks, {} rows out: {:.2f} times copying them ({:.2f}..{:.2f}); allowed 3\n", n_ticks, n,
               result.ratio, result.min_ratio, result.max_ratio);
    fmt::print("  {:.1f} ns a tick; copying {:.1f} ns, which is {:.1f} GB/s read and as much written\n",
               1e9 * result.work_s / n_ticks, 1e9 * result.reference_s / n_ticks, 1e-9 * bytes / result.reference_s);
    return n == n_ticks && result.ratio <= 3.0 ? 0 : 1;
}
