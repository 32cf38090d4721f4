#pragma once
// Generalised least squares whose errors are white noise and a random walk, for each of their ratios, with its
// restricted likelihood at the best scale (Patterson and Thompson, 1971): a walk that does not show may be there, and
// makes the error larger (Box and Tiao, Bayesian Inference in Statistical Analysis, 1973).

#include <vector>

#include <Eigen/Core>

namespace zlg::noise {

struct WalkedFit {
    Eigen::MatrixXd covariance;  // of the errors, over that of the white noise
    double weight = 0.0;         // probability; over all ratios 1
    Eigen::VectorXd value, variance;
};

// White noise alone first, then ratios three apart. Those whose likelihood is no number are left out: none may be left.
[[nodiscard]] std::vector<WalkedFit> walked_fits(const Eigen::MatrixXd& laws, const Eigen::VectorXd& measured);

}  // namespace zlg::noise
