#pragma once

#include <complex>

namespace zlg::twin {

// The Faddeeva function, which is the plasma dispersion function but for a factor.
//
//   w(z) = exp(-z^2) erfc(-i z) = (i / pi) int exp(-t^2) / (z - t) dt        Im z > 0
//
// Trapezoidal or midpoint rule with 12 nodes plus the residue of the pole, whichever keeps its nodes off Re z.
// z         Im z >= 0, |z| < 1e100.
// accuracy  4e-15 of |w|, as the source proves.
// cost      about 60 ns.
// source    M. Al Azah, S. N. Chandler-Wilde, SIAM J. Numer. Anal. 59 (2021) 2346.
[[nodiscard]] std::complex<double> faddeeva(std::complex<double> z);

// (w(b) - w(a)) / (b - a) where w_a = w(a), w_b = w(b) and b - a is real; w'(a) where a = b.
//
// accuracy  1e-13 of the largest |w|, also as b approaches a.
[[nodiscard]] std::complex<double> faddeeva_slope(std::complex<double> a, std::complex<double> w_a,
                                                  std::complex<double> b, std::complex<double> w_b);

}  // namespace zlg::twin
