#pragma once
// The detuning after the loop is closed, free-form from the light samples: a cubic smoothing spline, and the false
// angles that follow from it, with the covariance of their errors.
//
//   dl(t) = sum of c_i B_i(t),   (A^T A + g P) c = A^T x,   cov c = s^2 (A^T A + g P)^-1                     (1)
//   d_h = k (c^T Q_h c - tr(Q_h cov c)),   Q_h = integral of B B^T over half h,   k = chi f0 K T/2           (2)
//   cov(d_h, d_g) = 4 k^2 (Q_h c)^T cov c (Q_g c) + 2 k^2 tr(Q_h cov c Q_g cov c)                            (3)
//
// By the loss L = dl^2 + ... (LossBend) the integral of L(dl) stands for c^T Q_h c, that of L'(dl) B/2 for Q_h c and
// that of L''(dl) B B^T/2 for Q_h: to second order in the error of c.
//
// x are the samples, A the basis at their times, s^2 their variance: that of the residuals of the knots alone (g = 0)
// where it is larger than the configured one. c^T P c is the integral of (1 + t)^3 times the square of the third
// derivative, t in half-periods: the longer a loop has been closed the slower it moves. It is taken as white noise: g
// is a hundredth of the one that the samples make likeliest (Wahba, Spline Models for Observational Data, 1990,
// ch. 4.8). So a slow loop is smoothed over many halves, and a fast one by its knots. The trace of (2) takes off what
// the noise of the light adds to a mean square. (3) is the covariance of two quadratic forms of a Gaussian vector
// (Searle, Linear Models, 1971, ch. 2.5). Basis: de Boor, A Practical Guide to Splines, ch. X.
//
// The knots are a half-period apart for eight ticks, in which a loop closes, and then wider and wider: a knot at every
// half to the end lets the noise of late halves through.

#include <array>
#include <cstdint>
#include <span>

#include <zlg/core/common/triangle.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>

namespace zlg::core {

inline constexpr int most_light_terms = 31;

// The basis: its knots, three of them at either end, in half-periods.
struct LightBasis {
    int halves = 0;
    int n_terms = 0;
    std::array<std::uint8_t, most_light_terms + 4> knot{};

    friend bool operator==(const LightBasis&, const LightBasis&) = default;
};

// halves  1..160
[[nodiscard]] LightBasis light_basis(int halves) noexcept;

// Between two knots four terms are not 0, those from `first` on; they follow from six knots, the third of which is at
// or before.
struct BasisSpan {
    int first = 0;
    std::array<double, 6> knot{};
};

// Within half h.
[[nodiscard]] BasisSpan span_of(const LightBasis& basis, int h) noexcept;

// The four terms at a time within the half.
[[nodiscard]] std::array<double, 4> values_at(const BasisSpan& span, double time) noexcept;

// What the samples of a switch leave behind: the normal equations (1), as they grow from half to half.
struct LightSums {
    LightBasis basis{};
    int n_samples = 0;
    std::array<double, 4 * most_light_terms> normal{};  // A^T A: of term i with i - 3 .. i
    std::array<double, most_light_terms> moment{};      // A^T x
    double sum_sq = 0.0;

    friend bool operator==(const LightSums&, const LightSums&) = default;
};

// The samples of half h, wavelengths, equally spaced over it.
void add(LightSums& sums, int h, std::span<const double> detuning_lambda) noexcept;

// A half, as (2) and (3) need it: Q_h of the four terms from `first` on, Q_h c and c^T Q_h c.
struct LightHalf {
    int first;
    std::array<double, 10> product;  // lower triangle
    std::array<double, 4> slope;
    double value;
};

// The fit (1), in units of k: false angles over k.
class LightFit {
public:
    // light_sd_lambda  configured noise of one sample.
    LightFit(const LightSums& sums, double light_sd_lambda, const LossBend& bend = {}) noexcept;

    // False where there is no sample.
    [[nodiscard]] bool is_known() const noexcept { return known_; }
    [[nodiscard]] LightHalf half(int h) const noexcept;
    // (2), with the sign of the half.
    [[nodiscard]] double angle(const LightHalf& half) const noexcept;
    // (3).
    [[nodiscard]] double covariance(const LightHalf& one, const LightHalf& other) const noexcept;

private:
    // A^T A + g P in its factor, L^-1 A^T x in `term_`; false where it has none.
    bool solve(const LightSums& sums, double smoothing, double* reciprocal) noexcept;

    bool known_ = false;
    LossBend bend_{};
    LightBasis basis_{};
    std::array<double, most_light_terms> term_{};                       // c
    std::array<double, triangle_size(most_light_terms)> covariance_{};  // cov c
};

}  // namespace zlg::core
