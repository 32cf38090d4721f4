#pragma once
// The linear algebra of the core: a lower triangle by rows, its Cholesky factor, and rows that border it.
//
//   A = L L^T        row b of a border becomes L^-1 b: appended rows of right-hand sides are eliminated as rows of the
//   factor are
//
// A symmetric matrix and its factor have the same form, so that a factor takes the place of its matrix.
// The sums run in one order, so that every processor gives the same bits; four columns at a time keep its adder busy.
//
// cost  of a factor of n rows n^3/6 products, of a border row n^2/2

#include <cstddef>

namespace zlg::core {

// Where row i of a triangle begins, behind the i rows before it.
[[nodiscard]] constexpr std::size_t row_start(int i) noexcept {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(i + 1) / 2;
}

[[nodiscard]] constexpr std::size_t triangle_size(int rows) noexcept { return row_start(rows); }

// A matrix of someone else's numbers, by rows from the first column to the diagonal.
class Triangle {
public:
    constexpr explicit Triangle(double* numbers) noexcept : numbers_{numbers} {}

    [[nodiscard]] double* row(int i) const noexcept { return numbers_ + row_start(i); }
    // Of a symmetric matrix.
    [[nodiscard]] double& at(int i, int j) const noexcept { return i >= j ? row(i)[j] : row(j)[i]; }

private:
    double* numbers_;
};

// L^-1 x in place of x, by the first n rows of a factor.
//
// reciprocal  of the factor's diagonal.
void eliminate(Triangle factor, const double* reciprocal, int n, double* x) noexcept;

// L^-T x in place of x.
void substitute_back(Triangle factor, const double* reciprocal, int n, double* x) noexcept;

// L in place of the first n rows of A.
//
// reciprocal  receives those of the diagonal of L.
// return      false where A is not positive definite or holds what is not a number; the rows are then of no use.
[[nodiscard]] bool factorise(Triangle a, double* reciprocal, int n) noexcept;

// A^-1 in place of the factor of A.
void invert(Triangle factor, const double* reciprocal, int n) noexcept;

// Logarithm of the product of n positive numbers, very small or large ones too, by few logarithms.
[[nodiscard]] double log_of_product(const double* x, int n) noexcept;

// Sum of products of n numbers.
[[nodiscard]] double dot(const double* a, const double* b, int n) noexcept;

}  // namespace zlg::core
