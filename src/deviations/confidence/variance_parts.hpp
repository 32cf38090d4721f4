#pragma once
// A variance of few degrees of freedom as what it is: a sum of squares of independent normal numbers, each with its own
// weight.

#include <cstdint>
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

}  // namespace zlg::deviations
