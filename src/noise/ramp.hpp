#pragma once
// The steady growth of a rate, by generalised least squares under the noise of the rate.

#include <span>

#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

struct Ramp {
    double slope_arcsec_s2 = 0.0;
    double sigma = 0.0;
    double chance = 1.0;  // that noise alone makes a slope so steep, of either sign
};

// Means over up to 64 blocks of the record, whose covariance follows from the terms.
//
// terms   over one record a random walk or the flicker of a rate looks much like a ramp: what may be there of them and
//         was not found belongs to the terms too.
// errors  SeriesError: fewer than 4 blocks with a known rate; no covariance that is positive, as without any noise.
[[nodiscard]] Ramp find_ramp(std::span<const double> rates_arcsec_s, double rate_hz, const NoiseTerms& terms);

}  // namespace zlg::noise
