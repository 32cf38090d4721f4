#pragma once
// The steady growth of a rate, under noise of which the slow part is not known.

#include <span>

#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

struct Ramp {
    double slope_arcsec_s2 = 0.0;
    double sigma = 0.0;
    double chance = 1.0;  // that noise alone makes a slope so steep, of either sign
};

// Means over up to 64 blocks of the record, whose covariance follows from the terms. Over one record a random walk or the
// flicker of a rate looks much like a ramp, so how large they are is not taken from elsewhere: all sizes are weighed by the
// likelihood of what the blocks show beside a ramp (restricted likelihood), as there or not at odds of 3 to 1, and if there
// evenly in their logarithms.
//
// terms   quantisation and angle random walk are taken as given; with a Markov term shorter than a block, of which the time
//         is taken, bias instability is not looked for.
// errors  SeriesError: fewer than 4 blocks with a known rate; no covariance that is positive, as without any noise.
[[nodiscard]] Ramp find_ramp(std::span<const double> rates_arcsec_s, double rate_hz, const NoiseTerms& terms);

}  // namespace zlg::noise
