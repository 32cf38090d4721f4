#pragma once
// A linear law through increments of a quantity that is read with an error and walks at random.
//
//   y_p = x_p b + (e_{p+1} - e_p) + w_p        var e = border variance,  var w = walk variance * length
//
// Increments of one chain follow each other without a hole: the reading e between two of them stands in both, with
// opposite signs, so their covariance is minus the border variance. The walk is found by restricted maximum
// likelihood (Patterson and Thompson, Biometrika 58, 1971), b by generalised least squares; the covariance is
// tridiagonal, so that its Cholesky factor has two diagonals and a fit costs the number of increments. Angles of a
// counter are of this kind: rounding and random walk.

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace zlg::calibration {

struct Increment {
    double value = 0.0;
    double length_s = 0.0;   // > 0
    std::int64_t chain = 0;  // equal for neighbours that share a border
};

struct IncrementFit {
    Eigen::VectorXd coefficient;
    Eigen::MatrixXd covariance;
    double border_variance = 0.0;
    double walk_variance_per_s = 0.0;
    double walk_variance_sigma = 0.0;  // infinite where the likelihood is flat; 0 where the walk is given
    double residual = 0.0;             // sum of squares in units of the noise
    std::int64_t dof = 0;
};

// The border variance is known; the walk is found, 0 or more.
//
// laws    one row per increment: what each coefficient contributes to it.
// errors  std::invalid_argument: not more increments than coefficients.
[[nodiscard]] IncrementFit fit_walk(const std::vector<Increment>& increments, const Eigen::MatrixXd& laws,
                                    double border_variance);

// Both are known.
[[nodiscard]] IncrementFit fit_known(const std::vector<Increment>& increments, const Eigen::MatrixXd& laws,
                                     double border_variance, double walk_variance_per_s);

}  // namespace zlg::calibration
