#pragma once
// The gap that comes before the motion is known: its angle and its sigma are those of the mixture without a learnt member
// (gap_mixture.hpp), C being that of the readings alone.

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>

#include "compensation/motion/rounding_law.hpp"
#include "gap_estimate.hpp"

namespace zlg::core {

// Ticks on each side that such a gap uses: what each shape of the mixture costs fits into one half.
inline constexpr int points_beside_first = 6;

// Nothing moves but at a constant rate: the readings and the random walk are all that there is.
inline constexpr OptimalBridgeConfig readings_alone{.learns = false};

// The readings at both edges of the gap have the place within the count.
[[nodiscard]] bool is_read_by_phase(const GapBridgeState& state, const Gap& gap) noexcept;

// Finish such a gap, whose solution is there, and its mixture where there was time for it.
//
// misfit  of the points from a constant rate.
// return  known; or, where there was no time or one side has no points, the variance of the polynomial instead.
[[nodiscard]] EstimatedAngle first_angle(const CompensationConstants& gyro, const GapBridgeConfig& config,
                                         GapBridgeState& state, const Gap& gap, std::int64_t end,
                                         double misfit) noexcept;

}  // namespace zlg::core
