#include <zlg/core/compensation/polynomial_fit.hpp>

#include <cstddef>

namespace zlg::core {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Sums of powers 0..4 of the positions. With |x| <= 64 and 16 points the largest number made of them, the determinant,
// stays under 2^51, so that nothing is rounded and the order of addition does not matter.
std::array<double, 5> power_sums(const std::array<double, max_fit_points>& x, std::size_t n) noexcept {
    std::array<double, 5> sums{static_cast<double>(n)};
    for (std::size_t k = 0; k < n; ++k) {
        const double square = x[k] * x[k];
        sums[1] += x[k];
        sums[2] += square;
        sums[3] += square * x[k];
        sums[4] += square * square;
    }
    return sums;
}

// Adjugate of the matrix of normal equations of the given order, zero beyond it.
Matrix adjugate(const std::array<double, 5>& s, int order) noexcept {
    if (order == 0) return {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    if (order == 1) return {{{s[2], -s[1], 0}, {-s[1], s[0], 0}, {0, 0, 0}}};
    const double a01 = s[2] * s[3] - s[1] * s[4];
    const double a02 = s[1] * s[3] - s[2] * s[2];
    const double a12 = s[1] * s[2] - s[0] * s[3];
    return {{{s[2] * s[4] - s[3] * s[3], a01, a02},
             {a01, s[0] * s[4] - s[2] * s[2], a12},
             {a02, a12, s[0] * s[2] - s[1] * s[1]}}};
}

}  // namespace

PolynomialFit::PolynomialFit(const std::array<std::int32_t, max_fit_points>& position, int n, int order) noexcept
    : n_{n}, order_{order < n ? order : n - 1}, position_{position} {
    const auto n_points = static_cast<std::size_t>(n_);
    std::array<double, max_fit_points> x;
    for (std::size_t k = 0; k < n_points; ++k) x[k] = position_[k];
    const auto s = power_sums(x, n_points);
    const Matrix adj = adjugate(s, order_);
    // First row of G times first column of its adjugate.
    determinant_ = s[0] * adj[0][0] + s[1] * adj[0][1] + s[2] * adj[0][2];
    for (std::size_t k = 0; k < n_points; ++k) {
        for (unsigned row = 0; row < 3; ++row)
            numerator_[row][k] = (adj[row][2] * x[k] + adj[row][1]) * x[k] + adj[row][0];
    }
}

FitWeights PolynomialFit::weights(std::int32_t j) const noexcept {
    FitWeights w{};
    for (unsigned k = 0; k < static_cast<unsigned>(n_); ++k) w[k] = weight(k, j);
    return w;
}

}  // namespace zlg::core
