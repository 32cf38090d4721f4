#pragma once
// The terms of the total variances as weights of a thinned record, and how that record is correlated.

#include <compare>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <zlg/deviations/deviation_kind.hpp>

namespace zlg::deviations {

inline constexpr std::int64_t max_flicker_m = 512;  // flicker of the angle depends on the sampling, up to there

// The record thinned to `steps` values in an averaging time of m: angles, or mean rates of what lies between them.
struct Thinned {
    DeviationKind kind;
    int noise;
    std::int64_t m, steps;

    [[nodiscard]] auto operator<=>(const Thinned&) const = default;
    [[nodiscard]] bool of_rates() const { return kind == DeviationKind::htotdev; }
    [[nodiscard]] bool is_piecewise() const { return kind != DeviationKind::totdev; }
};

// Generalised covariances of flicker noise of the angle at lags 0 .. n of the thinned record, of a mean of `width_a`
// samples and one of `width_b`.
[[nodiscard]] std::vector<double> flicker_means_covariance(const Thinned& thin, std::int64_t n, double width_a,
                                                           double width_b);

// Covariances at lags 0 .. n of the second differences of the values; or with those of the angle given, farther.
[[nodiscard]] Eigen::VectorXd second_difference_covariance(const Thinned& thin, Eigen::Index n);
[[nodiscard]] Eigen::VectorXd second_difference_covariance(const Thinned& thin, Eigen::Index n,
                                                           const std::vector<double>& of_angle);

// Weights of values, in which constants and lines cancel, as weights of their second differences.
[[nodiscard]] Eigen::MatrixXd of_second_differences(const Eigen::MatrixXd& of_values);

// totdev: a difference about every angle from `first` to `last` of a record of n intervals.
[[nodiscard]] Eigen::MatrixXd mirrored_terms(std::int64_t s, std::int64_t n, std::int64_t first, std::int64_t last);

// Means over s values: third less twice the second and the first.
[[nodiscard]] Eigen::RowVectorXd plain_difference(std::int64_t s);

// mtotdev, htotdev: the differences in a piece of 3s values freed of its line and continued evenly, over half a period.
[[nodiscard]] Eigen::MatrixXd piece_terms(std::int64_t s);

}  // namespace zlg::deviations
