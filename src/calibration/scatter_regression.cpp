#include "scatter_regression.hpp"

#include <cmath>

#include <Eigen/Dense>

#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

ScatterRegression::ScatterRegression(const Eigen::MatrixXd& laws, const Eigen::VectorXd& values,
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

double ScatterRegression::sigma(const Eigen::VectorXd& weights) const {
    const Eigen::ArrayXd share = (influence_.transpose() * weights).array().square();
    const double variance = (share * variance_.array()).sum();
    const Eigen::ArrayXd part = share * expected_.array();
    const double deciding = part.sum() * part.sum() / part.square().sum();
    return numeric::widened(std::sqrt(variance), deciding - static_cast<double>(weights.size()));
}

}  // namespace zlg::calibration
