#pragma once
// Ticks of a gap whose sum the counter knows: what the motion makes of them is shifted to that sum.
//
//   final_j = m_j + w_j r,  r = known sum - sum of m,  sum of w = 1
//
// m and w come from the learnt covariance of the motion, with the ticks around the gap and the sum as points (gap_known_estimate);
// where it is not known, from the bridge's own values and a bump j (n + 1 - j). A sum that no such motion explains may
// be the turn of any one tick: that adds r^2 w (1 - w) to the variance.
//
// Rows that have left already keep their value: the others bear the whole sum.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/gap_bridge.hpp>

namespace zlg::core {

// The tick that was taken last ends a stretch of its gap with a known sum.
void note_known(const GapBridgeConfig& config, const TickInput& input, Gap& gap, HistoryTick& entry) noexcept;

// Ticks first..last of a gap: shift what ends there.
//
// constant_arcsec  what rows of the gap that have left have.
// return           sum of what was added to final values.
[[nodiscard]] ExactSum settle_known(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap,
                                    std::int64_t first, std::int64_t last, double constant_arcsec) noexcept;

// All ticks of the gap are known.
[[nodiscard]] constexpr bool is_known(const Gap& gap) noexcept { return gap.n > 0 && gap.known_ticks == gap.n; }

struct KnownEstimate {
    bool known = false;
    std::array<double, max_solved_gap> value_arcsec{};
    std::array<double, max_solved_gap> variance_arcsec2{};
};

// The ticks of a gap of 2 to 15, all of one known sum, by the learnt motion.
//
// error_arcsec2  variance of the sum beyond that of the motion and of the readings.
[[nodiscard]] KnownEstimate estimate_known(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap,
                                           double sum_arcsec, double error_arcsec2) noexcept;

// Variance of a tick about its mean over a long time, as learnt; infinite where it is not.
[[nodiscard]] double tick_variance(const GapBridgeConfig& config, GapBridgeState& state) noexcept;

}  // namespace zlg::core
