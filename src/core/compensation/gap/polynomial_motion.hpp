#pragma once
// What the motion does in a gap beyond the polynomial that bridges it, where there was no time for the estimate.
//
// The value of a polynomial at tick j is w^T z of its points z, so that its error is c^T (z, t_j) with c = (w, -1), and by the
// learnt covariance C of the motion (optimal_bridge.hpp)
//
//   variance of the error = c^T C c        for one tick, and for the sum of all ticks of the gap

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>

#include "gap_interpolation.hpp"

namespace zlg::core {

// Eq (15) as a line, or with this order if that is lower: a parabola through so few points swings more than the motion. These variances
// are in its own, infinite where no motion is known.
//
// cost  some 30 000 instructions
[[nodiscard]] GapSums sums_with_motion(const CompensationConstants& gyro, const GapBridgeConfig& config,
                                       const GapBridgeState& state, const Gap& gap, std::int64_t end,
                                       int order) noexcept;

}  // namespace zlg::core
