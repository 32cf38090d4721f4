#include <zlg/calibration/increment_fit.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include <zlg/numeric/minimum.hpp>

namespace zlg::calibration {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Noise {
    double border = 0.0;
    double walk_per_s = 0.0;
};

// Laws and values multiplied by the inverse of the Cholesky factor of their covariance, which has two diagonals.
struct White {
    Eigen::MatrixXd laws;
    Eigen::VectorXd values;
    double log_determinant = 0.0;
};

White whitened(const std::vector<Increment>& increments, const Eigen::MatrixXd& laws, Noise noise) {
    White white{laws, Eigen::VectorXd(std::ssize(increments))};
    double pivot = 0.0;
    for (Eigen::Index p = 0; p < std::ssize(increments); ++p) {
        const Increment& now = increments[static_cast<std::size_t>(p)];
        white.values[p] = now.value;
        double variance = 2.0 * noise.border + noise.walk_per_s * now.length_s;
        if (p > 0 && increments[static_cast<std::size_t>(p - 1)].chain == now.chain) {
            const double below = -noise.border / pivot;
            variance -= below * below;
            white.values[p] -= below * white.values[p - 1];
            white.laws.row(p) -= below * white.laws.row(p - 1);
        }
        pivot = std::sqrt(variance);
        white.values[p] /= pivot;
        white.laws.row(p) /= pivot;
        white.log_determinant += 2.0 * std::log(pivot);
    }
    return white;
}

struct Solution {
    Eigen::VectorXd coefficient;
    Eigen::MatrixXd covariance;
    double residual = 0.0;
    double log_determinants = 0.0;  // of the noise and of the information
};

// Columns are scaled to unit length, so that coefficients of any unit are solved alike.
Solution solve(const White& white) {
    const Eigen::VectorXd length = white.laws.colwise().norm().cwiseMax(1e-300);
    const Eigen::MatrixXd laws = white.laws * length.cwiseInverse().asDiagonal();
    const Eigen::LDLT<Eigen::MatrixXd> information(laws.transpose() * laws);
    const Eigen::VectorXd scaled = information.solve(laws.transpose() * white.values);
    const Eigen::Index n = laws.cols();
    const Eigen::MatrixXd inverse = information.solve(Eigen::MatrixXd::Identity(n, n));
    Solution s;
    s.coefficient = scaled.cwiseQuotient(length);
    s.covariance = length.cwiseInverse().asDiagonal() * inverse * length.cwiseInverse().asDiagonal();
    s.residual = (white.values - laws * scaled).squaredNorm();
    s.log_determinants = white.log_determinant + information.vectorD().cwiseMax(1e-300).array().log().sum() +
                         2.0 * length.array().log().sum();
    return s;
}

Solution solve(const std::vector<Increment>& increments, const Eigen::MatrixXd& laws, Noise noise) {
    return solve(whitened(increments, laws, noise));
}

std::int64_t degrees(const std::vector<Increment>& increments, const Eigen::MatrixXd& laws) {
    const std::int64_t dof = std::ssize(increments) - laws.cols();
    if (dof < 1 || laws.rows() != std::ssize(increments))
        throw std::invalid_argument(
            fmt::format("fit of increments: {} of them, {} rows and {} columns of laws; allowed is a row for each, and "
                        "more rows than columns",
                        increments.size(), laws.rows(), laws.cols()));
    return dof;
}

double mean_length_s(const std::vector<Increment>& increments) {
    double sum = 0.0;
    for (const Increment& i : increments) sum += i.length_s;
    return sum / static_cast<double>(increments.size());
}

IncrementFit fit_of(const Solution& s, Noise noise, std::int64_t dof) {
    return {.coefficient = s.coefficient,
            .covariance = s.covariance,
            .border_variance = noise.border,
            .walk_variance_per_s = noise.walk_per_s,
            .residual = s.residual,
            .dof = dof};
}

// From the curvature of the likelihood: -2 log L changes by 1 within one standard deviation.
template <class Function> double sigma_by_curvature(Function minus_2_log_likelihood, double at) {
    const double step = 0.05 * at;
    const double curvature =
        (minus_2_log_likelihood(at - step) - 2.0 * minus_2_log_likelihood(at) + minus_2_log_likelihood(at + step)) /
        (step * step);
    return curvature > 0.0 ? std::sqrt(2.0 / curvature) : infinity;
}

}  // namespace

IncrementFit fit_known(const std::vector<Increment>& increments, const Eigen::MatrixXd& laws, double border_variance,
                       double walk_variance_per_s) {
    const std::int64_t dof = degrees(increments, laws);
    const Noise noise{border_variance, walk_variance_per_s};
    return fit_of(solve(increments, laws, noise), noise, dof);
}

IncrementFit fit_walk(const std::vector<Increment>& increments, const Eigen::MatrixXd& laws, double border_variance) {
    const std::int64_t dof = degrees(increments, laws);
    const auto minus_2_log_likelihood = [&](double walk) {
        const Solution s = solve(increments, laws, {border_variance, walk});
        return s.log_determinants + s.residual;
    };
    // From where nobody could see the walk to where it explains all that is left by itself.
    const double length_s = mean_length_s(increments);
    const double alone = solve(increments, laws, {0.0, 1.0}).residual / static_cast<double>(dof);
    const double low = std::log(1e-4 * border_variance / length_s);
    const double high = std::log(10.0 * (alone + border_variance / length_s));
    const numeric::Minimum best =
        numeric::scanned_minimum([&](double x) { return minus_2_log_likelihood(std::exp(x)); }, low, high, 40);
    const bool walks = best.value < minus_2_log_likelihood(0.0);
    const Noise noise{border_variance, walks ? std::exp(best.at) : 0.0};
    IncrementFit fit = fit_of(solve(increments, laws, noise), noise, dof);
    fit.walk_variance_sigma = walks ? sigma_by_curvature(minus_2_log_likelihood, noise.walk_per_s) : infinity;
    return fit;
}

}  // namespace zlg::calibration
