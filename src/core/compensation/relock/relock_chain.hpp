#pragma once
// The detuning as a chain of cubics, half after half: state-space form of a cubic spline, with a backward information
// filter and a forward smoother. u = 0..1 is the time within a half.
//
//   dl(u) = q^T (1, u, u^2, u^3),  q = (z, a),  z' = G q at the next half,  G = (1 1 1 1; 0 1 2 3; 0 0 1 3)  (1)
//
// Backward. M, v: information matrix and vector of the later samples on z'. In front of them comes a half with the sums
// W_ij = sum u^(i+j) and g_i = sum y u^i over its samples, of weight h:
//
//   predict    A = G^T M G + h W,  b = G^T v + h g                      on q                                (2)
//   eliminate  a = (b_3 - A_3z z)/A_33,  variance sigma^2/A_33          the gain of the half                (3)
//   update     M <- A_zz - A_z3 A_3z/A_33,  v <- b_z - A_z3 b_3/A_33    Schur complement                    (4)
//
// Forward. The smoothed z with covariance C gives q by (3), the mean square of the half and its slope, and z' by G:
//
//   m = q^T N q - tr(N cov q),  N_ij = 1/(i+j+1),  cov(m, .) = 2 (N q)^T cov(q, .),  z' = G q               (5)
//
// C is kept in two parts (RelockLink): `within`, by the noise, and `between`, of the estimates over the onsets. The
// noise inflates q^T N q; q itself is a mean over the onsets, whose square lacks the second part. So the code has m =
// q^T N q - tr(N within) + tr(N between), and both parts together in every variance.
//
// Names below: `absorb` is (2)-(4), `pass` is (5), `onward` takes a covariance with z to one with z'.
// Source: Anderson and Moore, Optimal Filtering, 1979, ch. 6-7.

#include <array>
#include <cstddef>

#include <zlg/core/compensation/relock_profile_state.hpp>

namespace zlg::core {

template <std::size_t n>
using Vector = std::array<double, n>;
template <std::size_t n>
using Matrix = std::array<std::array<double, n>, n>;

// Information on a cubic term without any sample: its prior standard deviation is ten times the detuning. Keeps (3)
// regular; weak enough to leave no bias in the loops of docs/compensation.md.
[[nodiscard]] double cubic_ridge(const RelockProfileState& state) noexcept;

// (2)-(4): put a half in front of the later ones, whose information becomes that of this half's start.
//
// powers  sums of u^p over its samples: W.
// return  (3), the cubic term by the state at the start.
RelockGain absorb(const RelockHalf& half, const Vector<7>& powers, double ridge, RelockInformation& later) noexcept;

// v^T M^-1 v: the sum of squares that the best state explains, besides that of the eliminated cubic terms.
[[nodiscard]] double explained(const RelockInformation& information) noexcept;

// The smoothed state at a half before which there are no samples: z = M^-1 v, C = sigma^2 M^-1.
[[nodiscard]] RelockLink start_of(const RelockInformation& information, double noise_sq_lambda2) noexcept;

// (5) of one half.
struct PassedHalf {
    double mean_sq_lambda2 = 0.0;
    double variance_lambda4 = 0.0;
    Vector<3> slope{};      // of the mean square by the state at the start
    Vector<3> with_next{};  // covariance of the mean square with the state at the end
};

// (5): the mean square of a half, and the smoothed state moved to its end.
//
// accuracy  the fourth-order term 2 tr(N cov q N cov q), far below the rest, enters the variance as its upper bound
//           2 tr(N cov q)^2, and no covariance.
[[nodiscard]] PassedHalf pass(const RelockGain& gain, double noise_sq_lambda2, RelockLink& link) noexcept;

// Covariance with the state at the end of a half from that with the state at its start.
[[nodiscard]] Vector<3> onward(const RelockGain& gain, const Vector<3>& with) noexcept;

template <std::size_t n>
[[nodiscard]] double dot(const Vector<n>& a, const Vector<n>& b) noexcept {
    double sum = a[0] * b[0];
    for (std::size_t i = 1; i < n; ++i) sum += a[i] * b[i];
    return sum;
}

template <std::size_t n>
[[nodiscard]] Vector<n> times(const Matrix<n>& a, const Vector<n>& x) noexcept {
    Vector<n> y{};
    for (std::size_t i = 0; i < n; ++i) y[i] = dot(a[i], x);
    return y;
}

// Inverse of a positive definite matrix, by its Cholesky factor; a direction without information gets the variance 0.
template <std::size_t n>
[[nodiscard]] Matrix<n> inverse(const Matrix<n>& a) noexcept;

}  // namespace zlg::core
