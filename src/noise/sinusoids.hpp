#pragma once
// Lines in the spectrum of a rate: found in a Welch spectrum by Fisher's F-test against its neighbourhood, placed by
// the maximum of the demodulated power (the maximum-likelihood frequency of a single tone: Rife and Boorstyn, IEEE
// Trans. Inf. Theory 20, 1974), and refined by linearised least squares.

#include <span>
#include <vector>

namespace zlg::noise {

struct Sinusoid {
    double amplitude_arcsec_s = 0.0;  // of the rate itself; its mean over a sample has less
    double amplitude_sigma = 0.0;
    double frequency_hz = 0.0;
    double frequency_sigma_hz = 0.0;
    double cosine = 0.0;  // of the samples' means, from the first sample on
    double sine = 0.0;
};

// Finds the strongest line, subtracts it from the rates, and so on: at most `most`. A line stands out of the spectrum
// around it so that noise would do it in one of 500 records, at any frequency. What is not coherent, and leaves as much
// beside the line as was in it, is no sinusoid and stays.
//
// rates_arcsec_s  NaN where missing. Periods of more than an eighth of the record are not looked for.
[[nodiscard]] std::vector<Sinusoid> take_out_sinusoids(std::span<double> rates_arcsec_s, double rate_hz, int most);

}  // namespace zlg::noise
