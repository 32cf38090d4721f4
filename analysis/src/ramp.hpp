#pragma once
// The steady growth of a rate, under noise of known terms.

#include <array>
#include <span>

#include <zlg/analysis/noise_terms.hpp>

namespace zlg::analysis {

struct Ramp {
    double slope_arcsec_s2 = 0.0;
    double variance = 0.0;  // of the slope, by the terms
    // Part of the variance that each of Q^2, N^2, B^2, K^2, Markov deviation^2 contributes for each unit of it.
    std::array<double, 5> by_square{};
};

// Generalised least squares over means of up to 128 blocks of the record, whose covariance follows from the terms.
//
// errors  SeriesError: fewer than 3 blocks with a known rate.
[[nodiscard]] Ramp find_ramp(std::span<const double> rates_arcsec_s, double rate_hz, const NoiseTerms& terms);

}  // namespace zlg::analysis
