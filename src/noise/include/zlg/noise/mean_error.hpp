#pragma once
// What the mean of a record is uncertain by, where slow noise may hide under the white noise.
//
// Noise is white, white and a random walk of the rate, or white and flicker. A record that is 2, 4, 8 or 16 times as
// long as the time at which a walk crosses the white noise has its greatest likelihood as white in 44, 24, 8 and 1 of
// 100 cases (20000 spectra by numpy), with an error of 2, 4, 8 and 16 deviations of white noise. So sigma^2 is the mean
// of the mean's variance over all these laws, each with its probability (Bayes; Box and Tiao, Bayesian Inference in
// Statistical Analysis, 1973), and the kurtosis of the mixture gives the degrees of freedom. Without prejudice of the
// scale (weight 1/variance) a law of the shape S_k has of the spectrum X_k^2, k = 1 ... m, the restricted likelihood
//
//   prod S_k^(-1/2) Q^(-m/2),   Q = sum X_k^2/S_k          mean of the white variance Q/(m - 2), of its square
//                                                          Q^2/((m - 2)(m - 4))
//
// X_k is the cosine transform of the second kind, which diagonalises a random walk without its mean exactly.
//
// The three kinds are equally probable beforehand. S_k = 1 + r s_k, of known s_k; r has the reference prior beside an
// unknown scale (Jeffreys' rule; Bernardo and Smith, Bayesian Theory, 1994), the root of the information of log r:
//
//   sqrt(mean g^2 - (mean g)^2),   g_k = r s_k/S_k
//
// It vanishes towards small r, where slow noise is none, and towards large, where white noise is none.
//
// A mixture is right for the average of such gyros: docs/acceptance.md, "Limits", says by how much it is not for each.

#include <limits>
#include <span>

namespace zlg::noise {

struct MeanError {
    // Standard deviation of what such a mean and the next one differ by, over sqrt(2). NaN: not known.
    double sigma = std::numeric_limits<double>::quiet_NaN();
    double degrees = 1.0;  // of freedom of a Student law with that kurtosis; 4 or more where sigma is known
    double white = 0.0;    // probability that the noise is white alone, so that a longer record knows the mean better
    double white_sigma = std::numeric_limits<double>::quiet_NaN();  // sigma if it is
};

// rates  of equal intervals one after the other, NaN where not known; from 128 on they are joined to 64 or some more.
// half_periods  of the record, that sinusoids have which were taken out; the spectrum beside them, where they took
// noise along, is left out.
//
// return  not known where fewer than 8 means are, or all are equal.
[[nodiscard]] MeanError mean_error(std::span<const double> rates, std::span<const double> half_periods = {});

}  // namespace zlg::noise
