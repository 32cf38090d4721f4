#pragma once
// What the counter's roundings add to the error of a gap's angle, for the weights that the angle was made with.

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>

#include "compensation/motion/rounding_law.hpp"

namespace zlg::core {

// Roundings as they go with the recent motion, borders of ticks or of half-ticks.
[[nodiscard]] RoundingLaw law_of(const CompensationConstants& gyro, const GapBridgeConfig& config,
                                 const GapBridgeState& state, bool halves, bool with_phase) noexcept;

// Of the estimate.
[[nodiscard]] RoundingSums rounding_of_estimate(const GapBridgeState& state, const Gap& gap,
                                                const RoundingLaw& law) noexcept;

// Variance of the final value of each tick of the gap, which is compared with the rotation: the tick's own roundings, which
// the covariance holds because the counter would have read it with them, are no error.
//
// learns  the covariance is learnt; else it is given, with independent roundings.
// misfit  of the points.
void take_out_own_rounding(const GapBridgeState& state, const RoundingLaw& law, bool learns, double misfit,
                           GapEstimate& found) noexcept;

// Of a polynomial. The law is that of ticks.
[[nodiscard]] RoundingSums rounding_of_fit(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap,
                                           const PolynomialFit& fit, const RoundingLaw& law) noexcept;

// Of a pseudo-gap by which the polynomials are judged.
[[nodiscard]] RoundingSums rounding_of_score(BridgeCandidate polynomial, const RoundingLaw& law) noexcept;

// What is expected of a gap that was counted, without its roundings: there those before and after it belong together, and
// what repeats is learnt with them.
[[nodiscard]] inline double motion_in(double continuing_arcsec2, const RoundingSums& rounding) noexcept {
    const double motion = continuing_arcsec2 - rounding.continuing_arcsec2;
    return motion > 0.0 ? motion : 0.0;
}

}  // namespace zlg::core
