#pragma once
// The points around a gap, as they enter its problem, and what the estimate says of their re-lock errors.

#include <cstdint>

#include <zlg/core/compensation/gap_bridge.hpp>

namespace zlg::core {

[[nodiscard]] constexpr int stride_of(const GapProblem& problem) noexcept { return problem.halves ? 2 : 1; }

// Points that a problem would have if all were measured.
[[nodiscard]] constexpr int n_places(const GapProblem& problem) noexcept {
    return 2 * problem.n_side * stride_of(problem);
}

// The k-th of them lies after the gap.
[[nodiscard]] constexpr bool is_after(const EstimatedGap&, const GapProblem& problem, int k) noexcept {
    return k >= problem.n_side * stride_of(problem);
}

// The tick of the k-th.
[[nodiscard]] constexpr std::int64_t tick_of(const EstimatedGap& e, const GapProblem& problem, int k) noexcept {
    return e.first_tick - problem.n_side + place_of(k / stride_of(problem), problem.n_side, problem.n_gap);
}

// Add the next point of the problem in `state`, if it was measured.
void try_point(const MotionCovariance& covariance, GapBridgeState& state) noexcept;

// A prediction has the points of one side alone, as ticks, and so a problem that fits on a stack.
using PredictionProblem = GapProblemOf<few_unknowns>;
using PredictionData = GapDataOf<few_unknowns>;
static_assert(max_points_a_side <= static_cast<int>(few_unknowns));

// Points for a prediction from the ticks before `tick`.
[[nodiscard]] PredictionData points_before(const MotionCovariance& covariance, const GapBridgeState& state,
                                           std::int64_t tick, PredictionProblem& problem) noexcept;

// All points are in.
void begin_solution(GapBridgeState& state) noexcept;

// Mean square of the points, as ticks, about their mean.
[[nodiscard]] double scatter_of_points(const GapBridgeState& state) noexcept;

// What a point reads beyond the rotation, and the variance of what is known of it.
struct FalseReading {
    double value_arcsec = 0.0, variance_arcsec2 = 0.0;
};
[[nodiscard]] FalseReading false_reading(const GapBridgeState& state, unsigned point) noexcept;

// Take the estimated errors of the re-lock correction out of the final values after the gap; `change` is their sum.
void correct_ticks(GapBridgeState& state, const GapEstimate& found, ExactSum& change) noexcept;

// The same where each half was corrected by the profile of the detuning.
void correct_halves(GapBridgeState& state, const GapEstimate& found, ExactSum& change) noexcept;

// The scale of chi f0, by this switch: P <- P - P^2 p^T P p.
void learn_scale(GapBridgeState& state) noexcept;

}  // namespace zlg::core
