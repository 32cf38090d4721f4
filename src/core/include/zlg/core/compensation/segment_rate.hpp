#pragma once
// Mean rate over a segment of unknown length, blind to oscillations and to its own ends; curvature of the rate in it.
//
// Weighted least squares of a parabola, with a weight that vanishes smoothly at both ends: a window in the sense of
// spectral analysis (Harris, Proc. IEEE 66 (1978) 51). The weight is a polynomial in time, so that five running sums of
// angle times k^p, p = 2..6, suffice, and the length may stay unknown until the segment ends.

#include <array>
#include <cstdint>

namespace zlg::core {

// Weighted sums of the ticks of a segment.
struct SegmentRateState {
    std::int64_t n_ticks = 0;
    std::array<double, 5> moments{};  // sums of angle times k^2 .. k^6, k the tick's middle in ticks from the start

    friend constexpr bool operator==(const SegmentRateState&, const SegmentRateState&) = default;
};

// Add the angle of the next tick, arcsec.
void accumulate(SegmentRateState& state, double angle_arcsec) noexcept;

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
[[nodiscard]] SegmentRate rate_of(const SegmentRateState& state, double tick_s) noexcept;

// Variance of the mean on a base at rest: 10/7 W^2/L of an angle random walk W, and 120/7 (c^2/12)/(n L^2) of n ticks
// that are rounded to counts c, as if independent.
//
// return  (arcsec/s)^2; infinite for a segment without a tick.
[[nodiscard]] double mean_rate_variance(const SegmentRateState& state, double tick_s, double walk_arcsec_sqrt_s,
                                        double count_arcsec) noexcept;

}  // namespace zlg::core
