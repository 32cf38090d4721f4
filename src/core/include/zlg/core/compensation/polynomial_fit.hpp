#pragma once
// Least-squares polynomial through a few ticks, as exact weights.
//
//   P(j) = sum_k w_k(j) P_k,   w_k(j) = v(j)^T G^-1 v(x_k),   v(x) = (1, x, x^2)^T,   G = sum_k v(x_k) v(x_k)^T
//
// The positions are small integers, so G, its adjugate and every numerator are whole numbers below 2^53: exact as
// doubles, which every processor multiplies faster than 64-bit integers. A weight is rounded once, by its division.
// With it eqs (14) and (15) of the paper are sums of at most 16 products.

#include <array>
#include <cstdint>

namespace zlg::core {

inline constexpr int max_fit_points = 16;
inline constexpr int max_fit_order = 2;
using FitWeights = std::array<double, max_fit_points>;

class PolynomialFit {
public:
    PolynomialFit() = default;

    // position  n distinct ticks of magnitude <= 64, 1 <= n <= 16.
    // order     0, 1 or 2; lowered to n - 1 where there are too few points.
    PolynomialFit(const std::array<std::int32_t, max_fit_points>& position, int n, int order) noexcept;

    [[nodiscard]] int n() const noexcept { return n_; }
    [[nodiscard]] int order() const noexcept { return order_; }
    [[nodiscard]] std::int32_t position(int k) const noexcept { return position_[static_cast<unsigned>(k)]; }

    // The n weights with which the points give the value at tick j, |j| <= 64; the rest are 0.
    [[nodiscard]] FitWeights weights(std::int32_t j) const noexcept;

    // That of point k < n, at a whole number j.
    [[nodiscard]] double weight(unsigned k, double j) const noexcept {
        return ((numerator_[2][k] * j + numerator_[1][k]) * j + numerator_[0][k]) / determinant_;
    }

private:
    int n_ = 0;
    int order_ = 0;
    double determinant_ = 1.0;
    std::array<std::int32_t, max_fit_points> position_{};
    std::array<std::array<double, max_fit_points>, max_fit_order + 1> numerator_{};  // adj(G) v(x_k), by power of j
};

}  // namespace zlg::core
