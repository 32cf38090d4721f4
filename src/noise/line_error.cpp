#include <zlg/noise/line_error.hpp>

#include <cmath>

#include <Eigen/Dense>

#include "walked_fit.hpp"

namespace zlg::noise {

LineError line_error(std::span<const double> input, std::span<const double> output) {
    const Eigen::Map<const Eigen::VectorXd> x(input.data(), std::ssize(input)), y(output.data(), std::ssize(output));
    const double largest = x.cwiseAbs().maxCoeff();
    Eigen::MatrixXd laws(x.size(), 2);
    laws << Eigen::VectorXd::Ones(x.size()), x / largest;
    const Eigen::LDLT<Eigen::Matrix2d> normal(laws.transpose() * laws);
    const auto about_line = [&](const Eigen::MatrixXd& m) -> Eigen::MatrixXd {
        return m - laws * normal.solve(laws.transpose() * m);
    };
    const std::vector<WalkedFit> fits = walked_fits(laws, y);
    double variance = 0.0, parts = 0.0;
    for (const WalkedFit& fit : fits) {
        const Eigen::MatrixXd c = about_line(about_line(fit.covariance).transpose());
        variance += fit.weight * (fit.variance[1] + std::pow(fit.value[1] - fits.front().value[1], 2));
        parts += fit.weight * c.squaredNorm() / std::pow(c.trace(), 2);
    }
    return {.slope_sigma = std::sqrt(variance) / largest, .degrees = 1.0 / parts};
}

}  // namespace zlg::noise
