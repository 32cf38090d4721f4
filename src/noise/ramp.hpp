#pragma once
// The steady growth of a rate, under noise of which the slow part is not known: generalised least squares under a
// covariance whose sizes are integrated out numerically (restricted likelihood: Patterson and Thompson, Biometrika 58,
// 1971).

#include <span>

#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

struct Ramp {
    double slope_arcsec_s2 = 0.0;
    double sigma = 0.0;
    double chance = 1.0;  // that noise alone makes a slope so steep, of either sign
};

// Means over up to 64 blocks of the record, whose covariance follows from the terms. Over one record a random walk or
// the flicker of a rate looks much like a ramp, so their sizes do not come from the fit of the variances: all sizes are
// weighed by the likelihood of what the blocks show beside a ramp (restricted likelihood), as there or not at odds of 3
// to 1, and if there evenly in their logarithms.
//
// terms   quantisation and angle random walk are presumed; with a Markov term shorter than a block, of which the time
// is
//         presumed, bias instability is not looked for.
// errors  SeriesError: fewer than 4 blocks with a known rate; no covariance that is positive, as without any noise.
[[nodiscard]] Ramp find_ramp(std::span<const double> rates_arcsec_s, double rate_hz, const NoiseTerms& terms);

}  // namespace zlg::noise
