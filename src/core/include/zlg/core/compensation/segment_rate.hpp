#pragma once
// Mean rate over a segment of unknown length, blind to oscillations and to its own ends; curvature of the rate in it.
//
// Weighted least squares of a parabola, with a weight that vanishes smoothly at both ends: a window in the sense of
// spectral analysis (Harris, Proc. IEEE 66 (1978) 51). The weight is a polynomial in time, so that five running sums of
// angle times k^p, p = 2..6, suffice, and the length may stay unknown until the segment ends.

#include <array>
#include <cstdint>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>

namespace zlg::core {

// Weighted sums of the ticks of a segment.
struct SegmentRateState {
    std::int64_t n_ticks = 0;
    std::array<double, 5> moments{};  // sums of angle times k^2 .. k^6, k the tick's middle in ticks from the start

    friend constexpr bool operator==(const SegmentRateState&, const SegmentRateState&) = default;
};

// Add the angle of the next tick, arcsec.
inline void accumulate(SegmentRateState& state, double angle_arcsec) noexcept {
    const double k = as_double(state.n_ticks) + 0.5;
    double term = angle_arcsec * k;
    for (double& moment : state.moments) {
        term *= k;
        moment += term;
    }
    ++state.n_ticks;
}

// Add so many ticks that share an angle evenly.
//
// accuracy  1/n^4 of the sums for n ticks, by the rule of the middles and its next term.
inline void accumulate(SegmentRateState& state, double angle_arcsec, std::int64_t ticks) noexcept {
    const double tick_arcsec = angle_arcsec / as_double(ticks);
    const double first = as_double(state.n_ticks), last = as_double(state.n_ticks + ticks);
    double first_power = first, last_power = last;
    double p = 2.0;
    for (double& moment : state.moments) {
        const double at_last = last_power * (last * last / (p + 1.0) - p / 24.0);
        moment += tick_arcsec * (at_last - first_power * (first * first / (p + 1.0) - p / 24.0));
        first_power *= first;
        last_power *= last;
        p += 1.0;
    }
    state.n_ticks += ticks;
}

// Least squares with the weight u^2 (1 - u)^2, u = 0..1 from start to end, x = 2 u - 1:
//
//   rate(x) = mean + change x/2 + curvature (x^2 - 1/7)
//
// The three functions are orthogonal with this weight: the weighted mean of x^2 is 1/7, that of (x^2 - 1/7)^2 is 4/147.
// Nobody asks for the change.
struct SegmentRate {
    double mean_arcsec_s = 0.0;
    double curvature_arcsec_s = 0.0;  // of the ends over the middle
};

// The weight and its slope vanish at both ends, so an oscillation of angular frequency w leaves at most 120/(w L)^3 of
// its amplitude in the mean, L the length: 7e-10 of 20 Hz in 45 s, where a plain mean leaves 2/(w L), 4e-4. Errors of a
// switch at the ends of a segment have next to no weight. A steady change of the rate leaves the mean that of the
// middle.
//
// accuracy  1/n^4 of the mean rate for n ticks.
// return    zeros for a segment without a tick.
[[nodiscard]] inline SegmentRate rate_of(const SegmentRateState& state, double tick_s) noexcept {
    if (state.n_ticks < 1) return {};
    const auto n = as_double(state.n_ticks);
    // Sums of angle times u^2 .. u^6, over what the weight sums up to, which is n/30, and the tick.
    std::array<double, 5> m = state.moments;
    double power = n;
    for (double& moment : m) {
        power *= n;
        moment *= 30.0 / (n * tick_s) / power;
    }
    // u^2 (1 - u)^2 = u^2 - 2 u^3 + u^4: weighted means of 1, and of x^2 = (2 u - 1)^2.
    const double mean = m[0] - 2.0 * m[1] + m[2];
    const double of_x2 = 4.0 * (m[2] - 2.0 * m[3] + m[4] - (m[1] - 2.0 * m[2] + m[3])) + mean;
    // The projection on x^2 - 1/7, over its weighted mean square.
    return {.mean_arcsec_s = mean, .curvature_arcsec_s = 147.0 / 4.0 * (of_x2 - mean / 7.0)};
}

// Variance of the mean on a base at rest: 10/7 W^2/L of an angle random walk W, and 120/7 (c^2/12)/(n L^2) of n ticks
// that are rounded to counts c, as if independent.
//
// return  (arcsec/s)^2; infinite for a segment without a tick.
[[nodiscard]] inline double mean_rate_variance(const SegmentRateState& state, double tick_s, double walk_arcsec_sqrt_s,
                                               double count_arcsec) noexcept {
    if (state.n_ticks < 1) return infinity;
    const auto n = as_double(state.n_ticks);
    const double length_s = n * tick_s;
    const double of_walk = 10.0 / 7.0 * walk_arcsec_sqrt_s * walk_arcsec_sqrt_s / length_s;
    return of_walk + 120.0 / 7.0 / 12.0 * count_arcsec * count_arcsec / (n * length_s * length_s);
}

}  // namespace zlg::core
