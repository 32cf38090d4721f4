#pragma once
// Factor of a covariance matrix that grows by one row at a time, and the two triangular systems.
//
//   C = L L^T
//
// A row costs i^2/2 products.

#include <array>
#include <cstddef>

namespace zlg::core {

// Eight ticks on each side of a gap as halves, and four more for lit halves; with more of them the earliest ticks give way
// (take_lit_halves).
inline constexpr std::size_t max_unknowns = 36;
inline constexpr std::size_t few_unknowns = 8;  // of a small problem, which has room on a small stack

template <std::size_t capacity>
using ColumnOf = std::array<double, capacity>;
using Column = ColumnOf<max_unknowns>;

template <std::size_t capacity>
struct CholeskyFactorOf {
    int n = 0;
    std::array<double, capacity*(capacity + 1) / 2> lower{};  // by rows; on the diagonal the reciprocal

    friend bool operator==(const CholeskyFactorOf&, const CholeskyFactorOf&) = default;
};
using CholeskyFactor = CholeskyFactorOf<max_unknowns>;

// Add a row, n < capacity. There are functions for the capacities 8, 16 and 36.
//
// covariance  of the new unknown with the n earlier ones and, at index n, with itself.
// return      false, and nothing added, where the matrix would not be positive definite (within 1e-12 of the
//             diagonal) or holds what is not a number.
template <std::size_t capacity>
[[nodiscard]] bool add_row(CholeskyFactorOf<capacity>& factor, const ColumnOf<capacity>& covariance) noexcept;

// L^-1 x, of the first n numbers; the others are 0.
template <std::size_t capacity>
[[nodiscard]] ColumnOf<capacity> forward(const CholeskyFactorOf<capacity>& factor,
                                         const ColumnOf<capacity>& x) noexcept;

// L^-T x.
template <std::size_t capacity>
[[nodiscard]] ColumnOf<capacity> backward(const CholeskyFactorOf<capacity>& factor,
                                          const ColumnOf<capacity>& x) noexcept;

// Sum of the first n products.
template <std::size_t capacity>
[[nodiscard]] double product(const ColumnOf<capacity>& a, const ColumnOf<capacity>& b, int n) noexcept;

}  // namespace zlg::core
