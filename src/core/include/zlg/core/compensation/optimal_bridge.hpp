#pragma once
// Best linear unbiased prediction of the ticks of a gap for a known covariance of the motion: universal kriging, the
// linear minimum mean-square-error estimate with unknown regression coefficients (Kay, Estimation Theory, 1993, ch. 12;
// Cressie, Statistics for Spatial Data, 1993).
//
//   z = H b + x + e       points around the gap                                                          (1)
//     x  motion about its mean and rounding of the counter, covariance C
//     e  error of the re-lock correction, covariance E, independent of x
//     H  unknown coefficients b: a constant rate; of half-ticks also the alternation by the bias, on either side
//   V = (C + E)^-1,   P = V - V H (H^T V H)^-1 H^T V                                                     (2)
//   t = h b + tau         a tick of the gap, k = cov(z, tau), v = var(tau); h: its part in H
//   t^ = k^T P z + h b^,  b^ = (H^T V H)^-1 H^T V z                                                      (3)
//   var(t^ - t) = v - k^T V k + (h - H^T V k)^T (H^T V H)^-1 (h - H^T V k)                               (4)
//
// Only the rate has a part in t: of the alternation h is 0.
//
// C comes from the learnt moments M: (M + J M J)/2 with J the reversal of time, since the motion has the same
// covariance in both directions, plus a weak smooth prior and a part of the counter's rounding; or from a given prior
// and the whole rounding. The target of the whole switch is the sum of the ticks with the rounding at both edges of the
// gap, which C contains, less the sum of the errors e: what the false angles that were not corrected leave after the
// gap.

#include <array>
#include <cstddef>
#include <cstdint>

#include <zlg/core/compensation/cholesky.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/motion_moments.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

inline constexpr int max_points_a_side = 8;  // ticks
inline constexpr int max_solved_gap = 15;    // ticks: with two points a side it fills the learnt window of 19
inline constexpr int max_nuisances = 2;      // columns of H but the rate

struct OptimalBridgeConfig {
    bool learns = true;      // false: `prior_arcsec2` is the covariance of the motion
    bool halves = false;     // points are half-ticks
    Window prior_arcsec2{};  // between two half-ticks of the motion, by their distance in half-ticks
};

enum class OptimalBridgeFault : unsigned char { none, prior };

[[nodiscard]] OptimalBridgeFault check(const OptimalBridgeConfig& config) noexcept;

// Rounding that repeats with the motion (20 Hz repeats every 10 ticks) is learnt as if it were motion; this part of its
// covariance is added as noise. By trial on exactly 20 Hz, where without it the error is 2.7 arcsec and its square nine
// times the claimed variance, and with it 1.65 arcsec and 1.35 times.
inline constexpr double learnt_rounding_part = 0.3;

// Points after a gap of n ticks that fit into the learnt window.
[[nodiscard]] constexpr int points_a_side(int n_gap) noexcept {
    const int room = (window_ticks - n_gap) / 2;
    return room < max_points_a_side ? room : max_points_a_side;
}

// Points before it; one more where an even gap leaves an odd number.
[[nodiscard]] constexpr int points_before_gap(int n_gap) noexcept {
    const int room = window_ticks - n_gap - points_a_side(n_gap);
    return room < max_points_a_side ? room : max_points_a_side;
}

// The covariance C: learnt moments or a given prior, with what is added to them.
class MotionCovariance {
public:
    // config  and the moments must outlive it.
    // memory  which of the two learnt matrices.
    // scale   of the whole covariance: how much more, or less, the motion is than was learnt.
    // with_phase  the points have the place within the count, and so have the edges of the gap.
    MotionCovariance(const CompensationConstants& gyro, const OptimalBridgeConfig& config,
                     const MotionMomentsState& moments, MotionMemory memory, double scale = 1.0,
                     bool with_phase = false) noexcept;

    MotionCovariance(const MotionCovariance&) = delete;
    MotionCovariance& operator=(const MotionCovariance&) = delete;

    // Of two samples of a window: half-ticks where the configuration has them.
    [[nodiscard]] double of_samples(int a, int b) const noexcept {
        const int low = a < b ? a : b;
        const int high = a < b ? b : a;
        const auto index = [this](int i, int j) { return static_cast<unsigned>(row_[i] + j); };
        return per_sum_ * (sum_[index(low, high)] + sum_[index(window_ - 1 - high, window_ - 1 - low)]) +
               by_lag(high - low);
    }
    [[nodiscard]] double of_ticks(int a, int b) const noexcept;

private:
    const double* sum_;
    const std::int16_t* row_;  // where the triangle holds element 0 of each row
    int window_;
    bool halves_;
    double per_sum_ = 0.0;

    // Prior and rounding, by the distance of two samples.
    [[nodiscard]] double by_lag(int lag) const noexcept {
        if (static_cast<unsigned>(lag) < near_.size()) return near_[static_cast<unsigned>(lag)];
        return prior_ * shape_[lag];
    }

    const double* shape_;           // of the prior, by distance
    double prior_ = 1.0;            // scale of the shape
    std::array<double, 2> near_{};  // prior and rounding at the distances 0 and 1, where the rounding is not 0
    std::array<double, window_ticks> given_of_ticks_;  // where a prior is given by halves and points are ticks
};

// A gap and the points around it, with the Cholesky factor L of C + E, which grows point by point. This and the
// following types exist for 36 unknowns and for 8.
template <std::size_t capacity>
struct GapProblemOf {
    bool halves = false;        // points are half-ticks
    int n_gap = 0, n_side = 0;  // ticks; the window begins n_side ticks before the gap
    MotionMemory memory = fast_memory;
    double scale = 1.0;                         // of the motion's covariance
    bool with_phase = false;                    // only ticks with the place within the count are points
    std::array<std::int8_t, capacity> place{};  // of each point, in samples from the start of the window
    bool failed = false;
    CholeskyFactorOf<capacity> factor{};

    friend bool operator==(const GapProblemOf&, const GapProblemOf&) = default;
};
using GapProblem = GapProblemOf<max_unknowns>;

// Add a point, in order of place.
//
// error  covariance of its error e with those of the earlier points and, last, with itself.
template <std::size_t capacity>
void add_point(const MotionCovariance& covariance, GapProblemOf<capacity>& problem, int place,
               const ColumnOf<capacity>& error) noexcept;

template <std::size_t capacity>
struct GapDataOf {
    ColumnOf<capacity> value{};           // z, less the level
    ColumnOf<capacity> error_with_all{};  // covariance of each point's e with the sum of all e
    double error_variance = 0.0;          // of that sum
    double level = 0.0;                   // of a tick
    ColumnOf<capacity> probe{};           // p of an unknown factor d in e = -p d; its covariance is part of E

    friend bool operator==(const GapDataOf&, const GapDataOf&) = default;
};
using GapData = GapDataOf<max_unknowns>;

// L^-1 H, made orthogonal (Gram-Schmidt): the nuisances, each of norm 1, and the rate.
template <std::size_t capacity>
struct GapRatesOf {
    int n_nuisances = 0;
    std::array<ColumnOf<capacity>, max_nuisances> nuisance{};
    ColumnOf<capacity> rate{};
    double information = 0.0;  // of a constant rate, per sample: H^T V H of the rate, the nuisances eliminated

    friend bool operator==(const GapRatesOf&, const GapRatesOf&) = default;
};

template <std::size_t capacity>
struct GapEstimateOf {
    bool known = false;
    std::array<double, max_solved_gap> value_arcsec{};  // of the gap's ticks
    std::array<double, max_solved_gap> variance_arcsec2{};
    // Of each tick's error about what the counter would have read there: sum of the squared weights of the roundings at all
    // borders but those of the tick itself, and sum of the weights at these two, less 1 each. Not of a prediction.
    std::array<double, max_solved_gap> border_weight_sq{}, edge_weight{};
    double sum_variance_arcsec2 = 0.0;  // of the angle of the whole switch
    ColumnOf<capacity> sum_weight{};    // of the points in it
    double innovation_ratio = 0.0;      // z^T P z over its degrees of freedom: 1 on average if C and E are right
    ColumnOf<capacity> dual{};          // u = P z; the estimate of e_k is (E u)_k
    double probe_dual = 0.0;            // p^T P z
    double probe_information = 0.0;     // p^T P p

    friend bool operator==(const GapEstimateOf&, const GapEstimateOf&) = default;
};
using GapEstimate = GapEstimateOf<max_unknowns>;

// The solution, stage by stage: the rates, the points, each tick of the gap, the sum, the probe.
template <std::size_t capacity>
struct GapSolutionOf {
    int stage = 0;
    bool done = false;
    GapRatesOf<capacity> rates{};
    double rate = 0.0;
    ColumnOf<capacity> with_sum{};  // covariance of the points with the angle of the whole switch
    GapEstimateOf<capacity> estimate{};

    friend bool operator==(const GapSolutionOf&, const GapSolutionOf&) = default;
};
using GapSolution = GapSolutionOf<max_unknowns>;

// Advance by one stage: the solution is spread over several half-periods of the processor.
//
// cost  three triangular systems for the rates of half-ticks, else one or two.
template <std::size_t capacity>
void advance(const MotionCovariance& covariance, const GapProblemOf<capacity>& problem, const GapDataOf<capacity>& data,
             GapSolutionOf<capacity>& solution) noexcept;

// All stages at once.
[[nodiscard]] GapEstimate solve(const MotionCovariance& covariance, const GapProblem& problem,
                                const GapData& data) noexcept;

// Weights of the points for the gap's angle, and its variance.
struct GapWeights {
    bool known = false;
    Column weight{};
    double variance_arcsec2 = 0.0;

    friend bool operator==(const GapWeights&, const GapWeights&) = default;
};

[[nodiscard]] GapWeights weights(const MotionCovariance& covariance, const GapProblem& problem) noexcept;

}  // namespace zlg::core
