#pragma once
// Ticks of a gap whose sum the counter knows: estimates m_j conditioned on that sum.
//
//   final_j = m_j + w_j r,  r = known sum - sum of m,  sum of w = 1                                      (1)
//
// m comes from the bridge, and w is proportional to j (n + 1 - j): the covariance with its sum of a rate that is a
// random walk and known at both ends. A sum that the motion does not explain may be a rotation within any one tick: it
// is tick j with probability w_j, which adds the variance
//
//   r^2 w (1 - w)                                                                                        (2)
//
// Rows that were delivered already keep their value: the remaining ones get the whole residual.
//
// A rough sum S, of a re-lock, is used where its variance is less than those of the m together, or where it contradicts
// them:
//
//   r^2 > 9 (var S + n sum of var m)                                                                     (3)
//
// since errors of the m that are all alike add up to the last term. Where the sum of a part of a gap does (3),
// something turned beside that part, too: each of the gap's other ticks may have turned by r, all with one sign.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>

namespace zlg::core {

// Variances beyond which a rate, a sum or the points around a gap do not belong to the learnt motion: three standard
// deviations.
inline constexpr double outlier_sq = 9.0;

// The tick that was added last ends a stretch of its gap with a known sum.
//
// rounding_arcsec2  of a tick, by both of its readings. A rough sum counts as known only once it is used.
void note_known(double rounding_arcsec2, const TickInput& input, Gap& gap, HistoryTick& entry) noexcept;

struct KnownShift {
    ExactSum change_arcsec{};       // sum of what was added to final values
    double variance_arcsec2 = 0.0;  // of the gap's angle, beyond what the bridge claims
};

// Ticks first..last of a gap: shift what ends there.
//
// constant_arcsec  value of the rows of the gap that were delivered already.
[[nodiscard]] KnownShift settle_known(const CompensationConstants& gyro, const GapBridgeConfig& config,
                                      GapBridgeState& state, Gap& gap, std::int64_t first, std::int64_t last,
                                      double constant_arcsec) noexcept;

// All ticks of the gap are known.
[[nodiscard]] constexpr bool is_known(const Gap& gap) noexcept { return gap.n > 0 && gap.known_ticks == gap.n; }

}  // namespace zlg::core
