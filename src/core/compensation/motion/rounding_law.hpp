#pragma once
// Covariance of the counter's rounding errors at the borders of ticks, or of half-ticks, around a gap.
//
// A reading is the whole part of a phase p, its rounding error e = 1/2 - (p mod 1) is uniform over a count. For a phase
// that is uniform at the first reading, two readings between which the gyro turns by x counts have the covariance
//
//   R(x) = (x^2 - x + 1/6)/2,  x modulo 1               [counts^2]                                       (1)
//        = sum over n >= 1 of cos(2 pi n x)/(2 pi^2 n^2)
//
// the second Bernoulli polynomial. In irregular motion x is arbitrary and R averages to 0; at rest it is 1/12; at a
// steady rate it is known, and the errors of neighbouring readings do not average out. If x is Gaussian with variance
// s^2 about its mean, term n of the series is multiplied by exp(-2 pi^2 n^2 s^2); the first term dominates, so
//
//   R(x, s^2) = R(x) exp(-2 pi^2 s^2)                                                                    (2)
//
// where the factor is called coherence here. Across a gap the coherence is 0: the counter restarts with a new fraction.
// The angle of a switch has weights c on the readings at the borders, and the rounding variance c^T R c.
//
// Source: the statistics of quantisation, Widrow and Kollar, Quantization Noise, 2008.

#include <array>

#include <zlg/core/compensation/optimal_bridge.hpp>

namespace zlg::core {

// (2): of a rotation of x counts with this variance.
[[nodiscard]] double rounding_covariance(double rotation_counts, double variance_counts2) noexcept;

// Variance s^2 of a rotation of x counts of which the counter's readings scatter by s^2 + 1/6 - 2 R(x, s^2): the two
// rounding errors are in them.
[[nodiscard]] double scatter_of_rotation(double rotation_counts, double read_variance_counts2) noexcept;

// Covariances by the distance of two borders, in samples.
struct RoundingLaw {
    double step_arcsec = 0.0;
    double rate_counts = 0.0;  // a sample
    double bias_counts = 0.0;  // that the first half of a tick has more; 0 where borders are those of ticks
    std::array<double, max_window + 1> coherent_arcsec2{};  // the coherence times a count squared
    // (2). [0]: the earlier border begins a tick; [1]: it lies in the middle of one. Where the bias is negative in the
    // first half the two change places.
    std::array<std::array<double, max_window + 1>, 2> arcsec2{};

    friend bool operator==(const RoundingLaw&, const RoundingLaw&) = default;
};

// The law where the counter reads a mean square of `read_arcsec2[n]` in n ticks, about n times the rate.
//
// rate_arcsec  a tick.
// halves, bias_arcsec  as below.
[[nodiscard]] RoundingLaw rounding_law(double step_arcsec, double rate_arcsec,
                                       const std::array<double, window_ticks + 1>& read_arcsec2, bool halves,
                                       double bias_arcsec) noexcept;

// The law of readings with the phase of the fringe: noise of this step's variance, independent from border to border.
[[nodiscard]] RoundingLaw independent_readings(double step_arcsec) noexcept;

// The law for the recent motion.
//
// halves       borders are those of half-ticks.
// bias_arcsec  what the bias adds to the first half of a tick where its sign is positive.
[[nodiscard]] RoundingLaw rounding_law(const CompensationConstants& gyro, const OptimalBridgeConfig& config,
                                       const MotionMomentsState& moments, bool halves, double bias_arcsec) noexcept;

// The same at the borders of whole ticks.
[[nodiscard]] RoundingLaw of_whole_ticks(const RoundingLaw& halves) noexcept;

// Weights c of the readings at the borders of a window, from the weights w of the points of an estimate and the edges
// of its gap: point k is the difference of the readings at its ends, so c_i = w_(i-1) - w_i.
struct BorderWeights {
    int gap_begin = 0, gap_end = 0;                     // borders of the gap
    std::array<double, max_window + 1> weight{};        // by border
    std::array<std::int8_t, max_window + 1> stretch{};  // by border: its stretch, counted without a break

    // The false angle after the gap turns the phase as well: its sum from the end of the gap to each border, and its
    // variance.
    std::array<double, max_window + 1> false_arcsec{}, false_arcsec2{};
    int next = -1;  // border at which the last point ended

    // A point of the estimate, from border `place` to the next; in order of time.
    //
    // false_angle  that the reading holds beyond the rotation, and its variance.
    void add(int place, double of_point, double false_angle_arcsec = 0.0, double false_variance_arcsec2 = 0.0) noexcept;

    // The angle of the gap: its error has the roundings at both edges.
    void add_edges() noexcept;
};

// c^T R c under three assumptions.
struct RoundingSums {
    double broken_arcsec2 = 0.0;      // the counter restarts behind the gap: both sides are independent
    double continuing_arcsec2 = 0.0;  // the gap was counted, as the windows were from which the moments are learnt
    double white_arcsec2 = 0.0;       // all rounding errors are independent
};

// sign_before, sign_after  of the bias in the first half of a tick.
[[nodiscard]] RoundingSums rounding_of(const RoundingLaw& law, const BorderWeights& weights, int sign_before,
                                       int sign_after) noexcept;

}  // namespace zlg::core
