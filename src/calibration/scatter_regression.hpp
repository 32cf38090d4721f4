#pragma once
// Weighted least squares whose standard errors come from the scatter of the observations, each for itself.
//
// The expected variances set the weights and need be right only roughly: the covariance is that of White
// (Econometrica 48, 1980), each squared residual divided by 1 - leverage (HC2 of MacKinnon and White, J. Econometrics
// 29, 1985). Where few observations decide, the standard error is widened by as many degrees of freedom as they are
// (Satterthwaite).

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Dense>

#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

class ScatterRegression {
public:
    // One row of laws and one expected variance for each value.
    ScatterRegression(const Eigen::MatrixXd& laws, const Eigen::VectorXd& values, const Eigen::VectorXd& expected);

    [[nodiscard]] const Eigen::VectorXd& coefficient() const { return coefficient_; }
    // Of the sum of the coefficients with these weights; the readings that decide lose so many degrees of freedom.
    [[nodiscard]] double sigma(const Eigen::VectorXd& weights, double lost) const;
    [[nodiscard]] double sigma(const Eigen::VectorXd& w) const { return sigma(w, static_cast<double>(w.size())); }

private:
    Eigen::VectorXd coefficient_;
    Eigen::MatrixXd influence_;  // of each value on each coefficient
    Eigen::VectorXd variance_;   // of each value, from its residual
    Eigen::VectorXd expected_;
};

inline ScatterRegression::ScatterRegression(const Eigen::MatrixXd& laws, const Eigen::VectorXd& values,
                                            const Eigen::VectorXd& expected)
    : expected_{expected} {
    const Eigen::MatrixXd weighted = expected.cwiseInverse().asDiagonal() * laws;
    influence_ = (laws.transpose() * weighted).ldlt().solve(weighted.transpose());
    coefficient_ = influence_ * values;
    const Eigen::VectorXd residual = values - laws * coefficient_;
    variance_.resize(values.size());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        const double leverage = laws.row(k).dot(influence_.col(k));
        variance_[k] = residual[k] * residual[k] / std::fmax(1.0 - leverage, 1e-6);
    }
}

inline double ScatterRegression::sigma(const Eigen::VectorXd& weights, double lost) const {
    const Eigen::ArrayXd share = (influence_.transpose() * weights).array().square();
    const double variance = (share * variance_.array()).sum();
    const Eigen::ArrayXd part = share * expected_.array();
    const double deciding = part.sum() * part.sum() / part.square().sum();
    return numeric::widened(std::sqrt(variance), deciding - lost);
}

}  // namespace zlg::calibration
