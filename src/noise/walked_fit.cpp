#include "walked_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace zlg::noise {

std::vector<WalkedFit> walked_fits(const Eigen::MatrixXd& laws, const Eigen::VectorXd& measured) {
    const Eigen::Index n = measured.size();
    Eigen::MatrixXd walk(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) walk(i, j) = static_cast<double>(std::min(i, j));
    const auto dof = static_cast<double>(n - laws.cols());
    std::vector<WalkedFit> fits;
    for (double ratio = 0.0; ratio < 200.0; ratio = ratio == 0.0 ? 1e-4 : 3.0 * ratio) {
        const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n) + ratio * walk;
        const Eigen::LLT<Eigen::MatrixXd> root(covariance);
        const Eigen::MatrixXd a = root.matrixL().solve(laws);
        const Eigen::VectorXd y = root.matrixL().solve(measured);
        const Eigen::LLT<Eigen::MatrixXd> normal(a.transpose() * a);
        const Eigen::VectorXd value = normal.solve(a.transpose() * y);
        const double squares = (y - a * value).squaredNorm();
        const Eigen::MatrixXd l = root.matrixL(), m = normal.matrixL();
        const double objective = 2.0 * (l.diagonal().array().log().sum() + m.diagonal().array().log().sum()) +
                                 dof * std::log(std::max(squares, 1e-300));  // -2 log of the likelihood
        // Laws that are nearly the same leave a pivot of rounding.
        if (!std::isfinite(objective)) continue;
        const Eigen::MatrixXd inverse = normal.solve(Eigen::MatrixXd::Identity(laws.cols(), laws.cols()));
        fits.push_back({covariance, objective, value, inverse.diagonal() * (squares / dof)});
    }
    if (fits.empty()) return fits;
    const double least = std::ranges::min_element(fits, {}, &WalkedFit::weight)->weight;
    double all = 0.0;
    for (WalkedFit& fit : fits) all += fit.weight = std::exp(0.5 * (least - fit.weight));
    for (WalkedFit& fit : fits) fit.weight /= all;
    return fits;
}

}  // namespace zlg::noise
