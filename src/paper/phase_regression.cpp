#include "phase_regression.hpp"

#include <array>
#include <cmath>

namespace zlg::paper {
namespace {

using Row = std::array<double, 3>;
using Matrix = std::array<Row, 3>;

Row regressors(const Quadratures& q) { return {1.0, q.sine, q.cosine}; }

double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Row times(const Matrix& m, const Row& x) { return {dot(m[0], x), dot(m[1], x), dot(m[2], x)}; }

Row cross(const Row& a, const Row& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Of a symmetric matrix, by its cofactors.
Matrix inverse(const Matrix& m) {
    Matrix inverted{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
    const double determinant = dot(m[0], inverted[0]);
    for (Row& row : inverted)
        for (double& x : row) x /= determinant;
    return inverted;
}

Matrix gram_matrix(std::span<const Quadratures> at) {
    Matrix gram{};
    for (const Quadratures& q : at) {
        const Row x = regressors(q);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) gram[i][j] += x[i] * x[j];
    }
    // A regressor that is always zero gets no part.
    if (gram[2][2] == 0.0) gram[2][2] = 1.0;
    return gram;
}

}  // namespace

PhaseRegression regress(std::span<const double> errors, std::span<const Quadratures> at) {
    const Matrix inverted = inverse(gram_matrix(at));
    Row coefficient{};
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const Row part = times(inverted, regressors(at[k]));
        for (std::size_t i = 0; i < 3; ++i) coefficient[i] += part[i] * errors[k];
    }
    double square = 0.0;
    Row variance{};
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const Row x = regressors(at[k]);
        const double residual = errors[k] - dot(coefficient, x);
        square += residual * residual;
        const Row part = times(inverted, x);
        for (std::size_t i = 0; i < 3; ++i) variance[i] += part[i] * part[i] * residual * residual;
    }
    const auto n = static_cast<double>(errors.size());
    const auto estimate = [&](std::size_t i) {
        return Estimate{coefficient[i], std::sqrt(variance[i] * n / (n - 3.0))};
    };
    return {estimate(0), estimate(1), estimate(2), std::sqrt(square / (n - 3.0))};
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
