#pragma once
// A symmetric matrix reduced to tridiagonal form by reflections, Q^T W Q = T (Golub and Van Loan, Matrix Computations, sec. 8.3).

#include <zlg/core/compensation/gap_mixture.hpp>

namespace zlg::core {

// Element (i, j), i >= j, of W in of[j][i]: by columns. After `reduce` column j holds, below its diagonal, the vector v of the
// reflection I - factor v v^T that cleared it; factor 0: none.
// cost  some 2 n^3/3 products.
void reduce(Reflections& w, unsigned n, Tridiagonal& t) noexcept;

// Q^T x and Q x, in place.
void reflect(const Reflections& w, unsigned n, MixtureColumn& x) noexcept;
void reflect_back(const Reflections& w, unsigned n, MixtureColumn& x) noexcept;

}  // namespace zlg::core
