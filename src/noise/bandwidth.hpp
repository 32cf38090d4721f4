#pragma once
// Where a low pass cuts white noise off, from the spectrum of a rate.

#include <limits>
#include <span>

#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

struct Bandwidth {
    double hz = std::numeric_limits<double>::quiet_NaN();  // density half of that of low frequencies, -3 dB
    double sigma_hz = std::numeric_limits<double>::quiet_NaN();
};

// Whittle's likelihood of the Welch spectrum: beside the other terms there is white noise the logarithm of whose
// density is a + b ln(1 + 3u) + c u, u = (f/f_4)^2, up to the frequency f_4 where a quarter of it is left: b = -1, c =
// 0 is a low pass of first order, b = 0 nearly a moving average. The place of the half does not depend on the level a.
//
// terms     with the angle random walk, and what hides it at low frequencies.
// memory_s  about the time over which the sensor correlates its white noise.
// return    NaN: the density does not fall to a half below half the rate.
[[nodiscard]] Bandwidth find_bandwidth(std::span<const double> rates_arcsec_s, double rate_hz, const NoiseTerms& terms,
                                       double memory_s);

}  // namespace zlg::noise
