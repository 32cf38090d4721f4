#pragma once
// Roundings of the counter at the borders of ticks, or of half-ticks, around a gap.
//
// A reading is the whole part of a phase, and its rounding is uniform over a count. Of a phase that may start anywhere, two
// readings between which the gyro turns by x counts have roundings with the covariance
//
//   R(x) = (x^2 - x + 1/6)/2,  x taken modulo 1         [counts^2]
//
// In irregular motion x is anything and R averages to 0; at rest it is 1/12, and at a steady rate it is known: the roundings
// of neighbouring readings do not average. A rotation that scatters by s counts about its mean leaves about
// exp(-2 pi^2 s^2) of R. Across a gap nothing is left: the fraction behind it is a new one.

#include <array>

#include <zlg/core/compensation/optimal_bridge.hpp>

namespace zlg::core {

// R(x), of a rotation of x counts that scatters with this variance.
[[nodiscard]] double rounding_covariance(double turned_counts, double variance_counts2) noexcept;

// What a rotation of x counts scatters, where the counter reads it with so much scatter. The two differ by both roundings,
// 1/6 - 2 R.
[[nodiscard]] double scatter_of_rotation(double turned_counts, double read_variance_counts2) noexcept;

// Covariances by the distance of two borders, in samples.
struct RoundingLaw {
    double step_arcsec = 0.0;
    double rate_counts = 0.0;  // a sample
    double bias_counts = 0.0;  // that the first half of a tick has more; 0 where borders are those of ticks
    std::array<double, max_window + 1> left_arcsec2{};  // what the scatter leaves of R = 1
    // [0]: the earlier one begins a tick; [1]: it lies in the middle of one. Where the bias is negative in the first half they
    // change places.
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

// The law for the recent motion.
//
// halves       borders are those of half-ticks.
// bias_arcsec  what the bias adds to the first half of a tick where its sign is positive.
[[nodiscard]] RoundingLaw rounding_law(const OptimalBridgeConfig& config, const MotionMomentsState& moments,
                                       bool halves, double bias_arcsec) noexcept;

// The same at the borders of whole ticks.
[[nodiscard]] RoundingLaw of_whole_ticks(const RoundingLaw& halves) noexcept;

// Weights of readings at the borders of a window: what the points of an estimate, and the edges of its gap, make of them.
struct BorderWeights {
    int gap_begin = 0, gap_end = 0;                     // borders of the gap
    std::array<double, max_window + 1> weight{};        // by border
    std::array<std::int8_t, max_window + 1> stretch{};  // that were counted without a break, by border

    // By what the false angle after the gap has turned the phase, from its end to each border, and how well that is known.
    std::array<double, max_window + 1> false_arcsec{}, false_arcsec2{};
    int next = -1;  // border at which the last point ended

    // A point of the estimate, from border `place` to the next; in order of time.
    //
    // false_angle  that the reading holds beyond the rotation, and its variance.
    void add(int place, double of_point, double false_angle_arcsec = 0.0, double false_variance_arcsec2 = 0.0) noexcept;

    // The angle of the gap: its error has the roundings at both edges.
    void add_edges() noexcept;
};

struct RoundingSums {
    double broken_arcsec2 = 0.0;      // of a gap behind which the fraction is a new one
    double continuing_arcsec2 = 0.0;  // of one that was counted, as what was learnt was
    double white_arcsec2 = 0.0;       // if no two roundings had anything to do with each other
};

// sign_before, sign_after  of the bias in the first half of a tick.
[[nodiscard]] RoundingSums rounding_of(const RoundingLaw& law, const BorderWeights& weights, int sign_before,
                                       int sign_after) noexcept;

}  // namespace zlg::core
