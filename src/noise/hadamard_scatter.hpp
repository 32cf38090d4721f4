#pragma once
// How overlapped Hadamard variances of a record scatter, and scatter together, if its noise is of given terms: the sums
// that give equivalent degrees of freedom (Greenhall and Riley, Uncertainty of stability variances based on finite
// differences, PTTI 2003), here between two averaging times as well and for a sum of terms.

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

// Covariance of the estimates at factors m, relative to their expectations:
//
//   C_ij = 2/(M_i M_j E_i E_j) sum over pairs of differences of their covariance^2      (Gaussian noise; Isserlis)
//
// factors  powers of 2 in rising order; from 16 on, lags in eighths of the shorter factor stand for all. Factors more
//          than 64 apart count as correlated by quantisation only.
[[nodiscard]] Eigen::MatrixXd hadamard_scatter(const NoiseTerms& terms, double tau_0_s,
                                               std::span<const std::int64_t> factors, std::int64_t n_intervals);

}  // namespace zlg::noise
