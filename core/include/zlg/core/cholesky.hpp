#pragma once
// Factor of a covariance matrix that grows by one row at a time, and the two triangular systems.
//
//   C = L L^T
//
// A row costs i^2/2 products, so that a system of 32 unknowns can be spread over as many half-periods as are at hand.

#include <array>

namespace zlg::core {

inline constexpr int max_unknowns = 32;
using Column = std::array<double, max_unknowns>;

struct CholeskyFactor {
    int n = 0;
    std::array<double, max_unknowns*(max_unknowns + 1) / 2> lower{};  // by rows; on the diagonal the reciprocal

    friend bool operator==(const CholeskyFactor&, const CholeskyFactor&) = default;
};

// Add a row, n < 32.
//
// covariance  of the new unknown with the n earlier ones and, at index n, with itself.
// return      false, and nothing added, where the matrix would not be positive definite (within 1e-12 of the
//             diagonal) or holds what is not a number.
[[nodiscard]] bool add_row(CholeskyFactor& factor, const Column& covariance) noexcept;

// L^-1 x, of the first n numbers; the others are 0.
[[nodiscard]] Column forward(const CholeskyFactor& factor, const Column& x) noexcept;

// L^-T x.
[[nodiscard]] Column backward(const CholeskyFactor& factor, const Column& x) noexcept;

// Sum of the first n products.
[[nodiscard]] double product(const Column& a, const Column& b, int n) noexcept;

}  // namespace zlg::core
