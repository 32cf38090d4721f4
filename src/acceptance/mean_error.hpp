#pragma once
// What the mean of a record is uncertain by, where slow noise may hide under the white noise.

#include <span>

namespace zlg::acceptance {

struct MeanError {
    double sigma = 0.0;    // standard deviation of what such a mean and the next one differ by, over sqrt(2)
    double degrees = 0.0;  // of freedom of a Student law with that kurtosis; 4 or more
};

// Noise is white, white and a random walk of the rate, or white and flicker. A record that is longer than half the
// time at which a walk crosses the white noise, and shorter than thirty times it, tells hardly which: chosen for the
// greatest likelihood, white noise would leave an error of 16 of its deviations unsaid. So sigma^2 is the mean of the
// mean's variance over all these laws, each with its likelihood (Bayes; Box and Tiao, Bayesian Inference in Statistical
// Analysis, 1973), and the kurtosis of the mixture gives the degrees of freedom. Without prejudice of the scale (weight
// 1/variance) a law of the shape S_k has of the spectrum X_k^2, k = 1 ... m, the restricted likelihood
//
//   prod S_k^(-1/2) Q^(-m/2),   Q = sum X_k^2/S_k          mean of the white variance Q/(m - 2), of its square
//                                                          Q^2/((m - 2)(m - 4))
//
// X_k is the cosine transform of the second kind, which diagonalises a random walk without its mean exactly. White
// noise alone weighs as much as eight octaves of walk or 27 of flicker: about where errors are overstated for a white
// gyro and understated for one that walks by the same factor.
//
// means    over equal stretches one after the other, NaN: nothing is known; from 64 on they are joined to 64.
// half_periods  of the record, that sinusoids have which are no noise; the spectrum beside them is left out.
//
// return  sigma infinite where fewer than 8 are known, or all are equal.
[[nodiscard]] MeanError mean_error(std::span<const double> means, std::span<const double> half_periods = {});

}  // namespace zlg::acceptance
