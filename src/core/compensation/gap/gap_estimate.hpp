#pragma once
// The optimal estimate of a gap from the ticks around it (optimal_bridge.hpp), what sigma it may claim, and whether a
// polynomial does better.
//
// Sigma. The claimed variance var of (4) there is that of the learnt covariance. Two facts correct it:
//
//   misfit   f = max(1, q min(1, c)),  q = z^T P z/degrees of freedom, c the calibration of the covariance   (1)
//   rounding the learnt moments come from windows that were counted throughout, the gap was not: with both kinds of c^T R c
//            (rounding_law.hpp), variance = broken + f max(0, var - continuing)                              (2)
//
// Before pseudo-gaps have judged the covariance, f is further multiplied by (1 + n q)/(1 + n) where q < 1, n its degrees of
// freedom. Where f > 1.4 the points deviate by more than chance, and the variance is at least f var.

#include <cstdint>

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>
#include <zlg/core/compensation/gap_tick.hpp>

namespace zlg::core {

// Ticks of a gap that are predicted when it begins; the later ones get the mean rate.
inline constexpr int predicted_ticks = 4;

// The misfit (1). A calibration below 1 says that the angle is known better than the points: that alone is no misfit.
[[nodiscard]] constexpr double inflation(double calibration, double innovation_ratio) noexcept {
    const double ratio = innovation_ratio * (calibration < 1.0 ? calibration : 1.0);
    return ratio > 1.0 ? ratio : 1.0;
}

// A gap begins at `tick`: predict it from the ticks before, if the motion is known.
void predict_gap(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                 std::int64_t tick) noexcept;

// Go on with the estimate of a gap that waits, from earlier ticks alone: once between two ticks. An estimate of
// half-ticks that is not ready in time leaves its gap to the polynomial.
void advance_estimate(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state) noexcept;

// Points or stages done in one half-period, also in the one that delivers the estimate: 36 half-tick points and their
// solution take ten half-periods.
inline constexpr int work_a_half = 6;

struct EstimatedAngle {
    bool known = false;                        // rows have their final values
    bool has_history = false;                  // false: nothing is known of the motion
    int order = 2;                             // of the polynomial, where that does better
    double sigma_sum_arcsec = 0.0;             // of the whole switch
    double polynomial_variance_arcsec2 = 0.0;  // at least, of the polynomial's angle
    ExactSum gap_arcsec{};                     // final minus delivered in the gap
    ExactSum after_arcsec{};                   // change of the final values after it
};

// Give a gap of at most 16 ticks and the re-lock ticks after it their final values, from the ticks before `end`.
//
// work  that may still be done: points, or stages of the solution; a stage of half-ticks is 2. Where it does not suffice, because
//       gaps follow each other closely, the gap is left to the polynomial.
[[nodiscard]] EstimatedAngle estimate(const CompensationConstants& gyro, const GapBridgeConfig& config,
                                      GapBridgeState& state, const Gap& gap, std::int64_t end, int work) noexcept;

// Learn from one tick.
//
// idle  no gap lasts, waits or was resolved in this tick.
void learn(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
           const TickInput& tick, bool idle) noexcept;

// Order of the polynomial that stands in for the estimate.
[[nodiscard]] int order_in_place(const GapBridgeConfig& config, const GapBridgeState& state) noexcept;

}  // namespace zlg::core
