#pragma once
// Series of the oscillation A sin(2 pi nu t), eq (20), and the leading laws of the substitution error.
//
// The series are those of the RATE over a time x from the point of expansion. What a polynomial of order 0..2 cannot
// follow is their remainder, and the paper reads the error off it; the exact error is that of ErrorResponse.

#include <zlg/design/substitution.hpp>

namespace zlg::design {

// Terms of powers 0..5 of the rate about a point, in arcsec/s at time x.
struct RateSeries {
    double power[6] = {};

    [[nodiscard]] double sum() const;
    // What lies above a polynomial of this order, 0..5.
    [[nodiscard]] double above(int order) const;
};

// About t = 0, eq (20) as printed: 2 A p x - A p^3 x^3 + (4/15) A p^5 x^5 with p = pi nu.
[[nodiscard]] RateSeries series_at_zero_as_printed(const Tone& tone, double x_s);

// About t = 0, right: the cubic term is -(4/3) A p^3 x^3.
//
// range     error below A (2 p x)^7/7!
[[nodiscard]] RateSeries series_at_zero(const Tone& tone, double x_s);

// About the extremum t = 1/(4 nu): A - 2 A p^2 x^2 + (2/3) A p^4 x^4; right as printed.
//
// range     error below A (2 p x)^6/6!
[[nodiscard]] RateSeries series_at_extremum(const Tone& tone, double x_s);

// The time axis of figs 8-10 that agrees with its own captions: half the gap with one tick more, (n + 1) T/2.
[[nodiscard]] double figure_time_s(int n, double tick_s);

// The highest frequency up to which the worst error of the gap sum stays at or below limit_arcsec; 0.5/T where it does
// so over the whole band of the ticks.
//
// accuracy  1e-12 relative; the scan before it has 256 steps per 1/(span T).
[[nodiscard]] double highest_frequency_hz(const Substitution& substitution, double amplitude_arcsec_s,
                                          double limit_arcsec);

}  // namespace zlg::design
