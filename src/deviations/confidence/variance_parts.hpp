#pragma once
// A variance of few degrees of freedom as what it is: a sum of squares of independent normal numbers, each with its own
// weight.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <zlg/deviations/variance_law.hpp>

namespace zlg::deviations {

// How many averaging times the starts of its differences may span for a variance to be taken apart.
inline constexpr double max_averagings = 14.0;

using Parts = std::vector<ChiSquarePart>;

// For scale >= 0 in any order: normalised to the mean 1; the smallest are merged into one of the right mean and
// variance.
[[nodiscard]] Parts condensed(Parts parts);

// The law of parts with the mean 1.
[[nodiscard]] VarianceLaw law_of(Parts parts);

// The covariance of n values at equal distances, by their lag.
[[nodiscard]] Eigen::MatrixXd toeplitz(const Eigen::VectorXd& of_lag, Eigen::Index n);

// Eigenvalues, those that rounding made negative as 0.
[[nodiscard]] Parts parts_of_covariance(const Eigen::MatrixXd& covariance);

struct DifferenceTerms {
    int noise = 0;
    int d = 2;  // order of the differences of the angle
    bool is_modified = false, is_side_by_side = false;
    std::int64_t m = 1, starts = 1;
};

// Of all differences of a record, from the eigenvalues of their covariance.
//
// Terms from every start are averaged over cells, 128 at most; what that leaves out has the share and the degrees of
// freedom that make the mean and, with `edf`, the variance of the whole right.
[[nodiscard]] VarianceLaw law_of_difference_parts(const DifferenceTerms& terms, double edf);

// The law of a sum of independent chi-square variables, each times its own scale.
struct Tails {
    double below = 0.0;
    double above = 0.0;
};

// Probabilities that sum scale_i chi2(dof_i) is below and above x > 0: the inverse Laplace transform of
// prod (1 + 2 scale_i s)^(-dof_i/2), integrated over a parabola through the saddle point, where nothing oscillates.
//
// source  C. Helstrom, IEEE Trans. Aerosp. Electron. Syst. 32 (1996) 867
// accuracy  1e-7 of the smaller tail
[[nodiscard]] Tails tails(std::span<const ChiSquarePart> parts, double x);

// x with that much below, 0 < below < 1, and above = 1 - below, given for its digits.
[[nodiscard]] double quantile(std::span<const ChiSquarePart> parts, const Tails& probability);

// The total variance as a quadratic form of the angle, and what follows: its expectation over that of the variance
// without mirroring, and its law, for rate noise f^noise. Of a record of which m is at most a half.
[[nodiscard]] double total_bias(int noise, std::int64_t m, std::int64_t n_intervals);

// Up to 14 averaging times between the ends with parts; beyond, degrees of freedom and skewness, which grow evenly with
// the length.
[[nodiscard]] VarianceLaw total_law(int noise, std::int64_t m, std::int64_t n_intervals);

}  // namespace zlg::deviations
