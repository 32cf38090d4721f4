#pragma once
// The points z around a gap with the covariance E of their re-lock errors, as they enter its problem, and the use of
// the estimated errors e^ = E u.
//
//   whole ticks  z_k: the tick; E: diagonal
//   half-ticks   z_k = y_k + (1 + d) s D_k (joint_relock.hpp), d the learnt scale of chi f0;
//                E_kl = cov(sD_k, sD_l) + var(d) sD_k sD_l
//                those lit at the end of the gap (lit_halves.hpp) are points too, numbered -1, -2, ... backwards from
//                the first half after it
//
// All have a number k, in order of time: those before the gap, the lit halves in it, those after it.

#include <cstdint>

#include <zlg/core/compensation/gap_bridge_state.hpp>

namespace zlg::core {

[[nodiscard]] constexpr int stride_of(const GapProblem& problem) noexcept { return problem.halves ? 2 : 1; }

// Points that a problem would have if all were measured.
[[nodiscard]] constexpr int n_places(const EstimatedGap& e, const GapProblem& problem) noexcept {
    return (problem.n_side + e.n_after) * stride_of(problem) + e.lit.n;
}

// Place of the k-th among those after the gap; negative where it is lit, and less where it lies before the gap.
[[nodiscard]] constexpr int place_after(const EstimatedGap& e, const GapProblem& problem, int k) noexcept {
    return k - problem.n_side * stride_of(problem) - e.lit.n;
}

// The k-th lies after the gap.
[[nodiscard]] constexpr bool is_after(const EstimatedGap& e, const GapProblem& problem, int k) noexcept {
    return place_after(e, problem, k) >= 0;
}

// Place of the k-th, in samples from the start of the window.
[[nodiscard]] constexpr int sample_of(const EstimatedGap& e, const GapProblem& problem, int k) noexcept {
    const int stride = stride_of(problem);
    return k < problem.n_side * stride ? k : stride * (problem.n_side + problem.n_gap) + place_after(e, problem, k);
}

// The tick of the k-th.
[[nodiscard]] constexpr std::int64_t tick_of(const EstimatedGap& e, const GapProblem& problem, int k) noexcept {
    return e.first_tick - problem.n_side + sample_of(e, problem, k) / stride_of(problem);
}

// The lit halves of a gap become points, and so many of the earliest ones are left out.
void take_lit_halves(GapBridgeState& state) noexcept;

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

// The points of the mixture, as ticks.
void begin_mixture(const MotionCovariance& covariance, GapBridgeState& state) noexcept;

// Replace a part of the estimate by that of the mixture: the ticks of the gap, and the dual by which e is estimated.
void mix(GapBridgeState& state) noexcept;

// Mean square of the points, as ticks, about their mean.
[[nodiscard]] double scatter_of_points(const GapBridgeState& state) noexcept;

// Variance of the re-lock corrections in the ticks behind the points, `n_after` after the gap, with those still to come at
// `end`, and of the random walk in all re-lock ticks.
[[nodiscard]] double relock_beyond(const GapBridgeState& state, const Gap& gap, std::int64_t end, int n_after) noexcept;

// False angle in the reading of a point, as it is known, and its variance.
struct FalseReading {
    double value_arcsec = 0.0, variance_arcsec2 = 0.0;
};
[[nodiscard]] FalseReading false_reading(const GapBridgeState& state, unsigned point) noexcept;

// Subtract the estimated errors of the re-lock correction from the final values after the gap; `change` is their sum. What is
// beyond `sure_sq` times its variance may be the motion: sigma of the tick then holds it.
void correct_ticks(GapBridgeState& state, const GapEstimate& found, double sure_sq, ExactSum& change) noexcept;

// The same for half-ticks, which were corrected by the profile of the detuning.
void correct_halves(GapBridgeState& state, const GapEstimate& found, double sure_sq, ExactSum& change) noexcept;

// Learn the scale d of chi f0 from this switch. v: its variance; P: the projection (2) of optimal_bridge.hpp.
//
//   d <- d - v p^T P z,  v <- v - v^2 p^T P p + process noise
void learn_scale(GapBridgeState& state) noexcept;

}  // namespace zlg::core
