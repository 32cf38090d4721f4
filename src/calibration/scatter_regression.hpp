#pragma once
// Weighted least squares whose standard errors come from the scatter of the observations, each for itself.
//
// The expected variances set the weights and need be right only roughly: the covariance is that of White
// (Econometrica 48, 1980), each squared residual divided by 1 - leverage (HC2 of MacKinnon and White, J. Econometrics 29,
// 1985). Where few observations decide, the standard error is
// widened by as many degrees of freedom as they are (Satterthwaite).

#include <Eigen/Core>

namespace zlg::calibration {

class ScatterRegression {
public:
    // One row of laws and one expected variance for each value.
    ScatterRegression(const Eigen::MatrixXd& laws, const Eigen::VectorXd& values, const Eigen::VectorXd& expected);

    [[nodiscard]] const Eigen::VectorXd& coefficient() const { return coefficient_; }
    // Of the sum of the coefficients with these weights.
    [[nodiscard]] double sigma(const Eigen::VectorXd& weights) const;

private:
    Eigen::VectorXd coefficient_;
    Eigen::MatrixXd influence_;  // of each value on each coefficient
    Eigen::VectorXd variance_;   // of each value, from its residual
    Eigen::VectorXd expected_;
};

}  // namespace zlg::calibration
