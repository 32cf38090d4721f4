#pragma once
// The law of the counter's roundings: the covariance of two readings of a free-running counter.
//
// A reading is the whole part of a phase. Its rounding error is uniform over a count, and two readings between which the phase
// turned by x counts, Gaussian with the variance s^2, have the covariance
//
//   R(x, s^2) = (x^2 - x + 1/6)/2 exp(-2 pi^2 s^2),    x modulo 1                      [counts^2]
//
// the second Bernoulli polynomial, of whose Fourier series sum cos(2 pi k x)/(2 pi^2 k^2) the scatter leaves the first term.
// Source: Widrow and Kollar, Quantization Noise, 2008, ch. 4 and 9.

namespace zlg::core {

// turn_counts  of which no fraction is known beyond 2^51: taken for whole there.
// return       0 beyond a scatter of 2 counts^2, where the factor is below 1e-17.
[[nodiscard]] double rounding_law(double turn_counts, double scatter_counts2) noexcept;

}  // namespace zlg::core
