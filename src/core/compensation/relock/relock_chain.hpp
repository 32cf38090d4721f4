#pragma once
// The detuning as a chain of cubics, half after half; u = 0..1 is the time within a half.
//
//   dl(u) = z_0 + z_1 u + z_2 u^2 + a u^3;    z at the next half: (1 1 1 1; 0 1 2 3; 0 0 1 3) (z, a)
//
// Backwards, the cubic term of each half is eliminated; forwards, the estimate runs along it with its covariance.

#include <array>
#include <cstddef>

#include <zlg/core/compensation/relock_profile.hpp>

namespace zlg::core {

template <std::size_t n>
using Vector = std::array<double, n>;
template <std::size_t n>
using Matrix = std::array<std::array<double, n>, n>;

// Information on a cubic term without any sample: it is not much larger than ten times the detuning.
[[nodiscard]] double cubic_ridge(const RelockProfileState& state) noexcept;

// Put the half in front of what is known of the later ones.
//
// powers  sums of u^p over its samples.
// return  how its cubic term follows from its start.
RelockGain absorb(const RelockHalf& half, const Vector<7>& powers, double ridge, RelockInformation& later) noexcept;

// The sum of squares that the best state explains, besides what is explained already.
[[nodiscard]] double explained(const RelockInformation& information) noexcept;

// The link at a half before which nothing was seen.
[[nodiscard]] RelockLink start_of(const RelockInformation& information, double noise_sq_lambda2) noexcept;

// What one half adds.
struct PassedHalf {
    double mean_sq_lambda2 = 0.0;
    double variance_lambda4 = 0.0;
    Vector<3> slope{};      // of the mean square by the state at the start
    Vector<3> with_next{};  // covariance of the mean square with the state at the end
};

// Pass a half: its mean square, and the link to its end.
//
// accuracy  the square of the noise, far below the rest, enters the variance as its upper bound, and no covariance.
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

// Inverse of a positive definite matrix; what cannot be told by it gets no variance.
template <std::size_t n>
[[nodiscard]] Matrix<n> inverse(const Matrix<n>& a) noexcept;

}  // namespace zlg::core
