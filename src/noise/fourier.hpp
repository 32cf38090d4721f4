#pragma once
// The Fourier transform of real numbers.

#include <complex>
#include <cstddef>
#include <vector>

namespace zlg::noise {

// The least length from n on that has no prime factor over 5.
[[nodiscard]] std::size_t quick_length(std::size_t n);

// Sums of x_k exp(-2 pi i j k/n), j = 0..n/2.
[[nodiscard]] std::vector<std::complex<double>> half_spectrum(const std::vector<double>& values);

}  // namespace zlg::noise
