#include <zlg/core/polynomial_fit.hpp>

namespace zlg::core {
namespace {

using Matrix = std::array<std::array<std::int64_t, 3>, 3>;

// Sums of powers 0..4 of the positions. With |x| <= 64 and 16 points every product below stays under 2^61.
std::array<std::int64_t, 5> power_sums(const std::array<std::int32_t, max_fit_points>& position, int n) noexcept {
    std::array<std::int64_t, 5> s{};
    for (unsigned k = 0; k < static_cast<unsigned>(n); ++k) {
        std::int64_t power = 1;
        for (std::int64_t& sum : s) {
            sum += power;
            power *= position[k];
        }
    }
    return s;
}

// Adjugate of the matrix of normal equations of the given order, zero beyond it.
Matrix adjugate(const std::array<std::int64_t, 5>& s, int order) noexcept {
    if (order == 0) return {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    if (order == 1) return {{{s[2], -s[1], 0}, {-s[1], s[0], 0}, {0, 0, 0}}};
    const std::int64_t a01 = s[2] * s[3] - s[1] * s[4];
    const std::int64_t a02 = s[1] * s[3] - s[2] * s[2];
    const std::int64_t a12 = s[1] * s[2] - s[0] * s[3];
    return {{{s[2] * s[4] - s[3] * s[3], a01, a02},
             {a01, s[0] * s[4] - s[2] * s[2], a12},
             {a02, a12, s[0] * s[2] - s[1] * s[1]}}};
}

}  // namespace

PolynomialFit::PolynomialFit(const std::array<std::int32_t, max_fit_points>& position, int n, int order) noexcept
    : n_{n}, order_{order < n ? order : n - 1}, position_{position} {
    const auto s = power_sums(position_, n_);
    const Matrix adj = adjugate(s, order_);
    // First row of G times first column of its adjugate.
    determinant_ = s[0] * adj[0][0] + s[1] * adj[0][1] + s[2] * adj[0][2];
    for (unsigned k = 0; k < static_cast<unsigned>(n_); ++k) {
        const std::int64_t x = position_[k];
        for (unsigned row = 0; row < 3; ++row) numerator_[k][row] = adj[row][0] + adj[row][1] * x + adj[row][2] * x * x;
    }
}

FitWeights PolynomialFit::weights(std::int32_t j) const noexcept {
    FitWeights w{};
    const std::int64_t x = j;
    for (unsigned k = 0; k < static_cast<unsigned>(n_); ++k) {
        const Row& u = numerator_[k];
        w[k] = static_cast<double>(u[0] + u[1] * x + u[2] * x * x) / static_cast<double>(determinant_);
    }
    return w;
}

}  // namespace zlg::core
