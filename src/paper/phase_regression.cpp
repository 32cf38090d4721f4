#include "phase_regression.hpp"

#include <cmath>
#include <vector>

#include <zlg/numeric/cluster_fit.hpp>

namespace zlg::paper {

PhaseRegression regress(std::span<const double> errors, std::span<const Quadratures> at) {
    std::vector<numeric::Cluster> each;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const Eigen::Vector3d x{1.0, at[k].sine, at[k].cosine};
        each.push_back({x * x.transpose(), errors[k] * x});
    }
    const numeric::ClusterFit fit = numeric::fit_clusters(each, numeric::Laws::alike);
    double left = 0.0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const double residual = errors[k] - fit.coefficient.dot(Eigen::Vector3d{1.0, at[k].sine, at[k].cosine});
        left += residual * residual;
    }
    const auto estimate = [&fit](Eigen::Index i) {
        return Estimate{fit.coefficient[i], std::sqrt(fit.covariance(i, i))};
    };
    return {estimate(0), estimate(1), estimate(2), std::sqrt(left / (static_cast<double>(errors.size()) - 3.0))};
}

// Variance of the root: that of the mean square over 4 rms^2.
Estimate root_mean_square(std::span<const double> errors) {
    double square = 0.0;
    double fourth = 0.0;
    for (const double e : errors) {
        square += e * e;
        fourth += e * e * e * e;
    }
    const auto n = static_cast<double>(errors.size());
    square /= n;
    fourth /= n;
    if (square == 0.0) return {};
    return {std::sqrt(square), std::sqrt(std::fmax(0.0, fourth - square * square) / (4.0 * square * (n - 1.0)))};
}

}  // namespace zlg::paper
