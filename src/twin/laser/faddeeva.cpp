#include "faddeeva.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {
namespace {

constexpr std::size_t n_nodes = 12;

struct Rule {
    double step;
    std::array<double, n_nodes> midpoint_sq, midpoint_weight;    // (k + 1/2) h
    std::array<double, n_nodes> trapezoid_sq, trapezoid_weight;  // k h, the node at zero with half its weight
};

Rule make_rule() {
    Rule rule{};
    rule.step = std::sqrt(std::numbers::pi / static_cast<double>(n_nodes));
    for (std::size_t k = 0; k < n_nodes; ++k) {
        const double at = static_cast<double>(k) * rule.step;
        const double half_on = at + 0.5 * rule.step;
        rule.trapezoid_sq[k] = at * at;
        rule.midpoint_sq[k] = half_on * half_on;
        rule.trapezoid_weight[k] = (k == 0 ? 0.5 : 1.0) * core::maths::exp(-at * at);
        rule.midpoint_weight[k] = core::maths::exp(-half_on * half_on);
    }
    return rule;
}

// Complex arithmetic is written out here: the operators of std::complex look for infinities at every product.
struct Parts {
    double re;
    double im;
};

Parts quotient(Parts a, Parts b) {
    const double inverse = 1.0 / (b.re * b.re + b.im * b.im);
    return {(a.re * b.re + a.im * b.im) * inverse, (a.im * b.re - a.re * b.im) * inverse};
}

// (2 i h z / pi) sum_k weight_k / (z^2 - node_k^2)
Parts sum(double x, double y, double step, const std::array<double, n_nodes>& node_sq,
          const std::array<double, n_nodes>& weight) {
    const double im = 2.0 * x * y;
    const double z_sq = (x - y) * (x + y);
    double sum_re = 0.0;
    double sum_im = 0.0;
    for (std::size_t k = 0; k < n_nodes; ++k) {
        const double re = z_sq - node_sq[k];
        const double scaled = weight[k] / (re * re + im * im);
        sum_re += scaled * re;
        sum_im -= scaled * im;
    }
    const double factor = 2.0 * step / std::numbers::pi;
    return {-factor * (x * sum_im + y * sum_re), factor * (x * sum_re - y * sum_im)};
}

// 2 exp(-z^2) / (1 + sign exp(-2 i pi z / h)): what the rule misses of the pole at t = z.
Parts residue(double x, double y, double step, double sign) {
    const double growth = core::maths::exp(2.0 * std::numbers::pi * y / step);
    const double turn = 2.0 * std::numbers::pi * x / step;
    const double size = 2.0 * core::maths::exp((y - x) * (y + x));
    const double phase = 2.0 * x * y;
    return quotient({size * core::maths::cos(phase), -size * core::maths::sin(phase)},
                    {1.0 + sign * growth * core::maths::cos(turn), -sign * growth * core::maths::sin(turn)});
}

Parts first_quadrant(double x, double y) {
    static const Rule rule = make_rule();
    const double cells = x / rule.step;
    const double fraction = cells - std::floor(cells);
    const bool near_midpoint = y < x && fraction >= 0.25 && fraction <= 0.75;
    Parts w = near_midpoint ? sum(x, y, rule.step, rule.trapezoid_sq, rule.trapezoid_weight)
                            : sum(x, y, rule.step, rule.midpoint_sq, rule.midpoint_weight);
    // Higher up the residue is below 1e-32 for y < x, and for y >= x the rule is exact enough without it.
    if (y < std::numbers::pi / rule.step) {
        const Parts missing = residue(x, y, rule.step, near_midpoint ? -1.0 : 1.0);
        w = {w.re + missing.re, w.im + missing.im};
    }
    return w;
}

std::complex<double> product(std::complex<double> a, std::complex<double> b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

std::complex<double> faddeeva(std::complex<double> z) {
    const Parts w = first_quadrant(std::abs(z.real()), z.imag());
    return {w.re, z.real() < 0.0 ? -w.im : w.im};
}

// Where the difference would cancel, the Taylor series about a, from w' = -2 z w + 2 i / sqrt(pi) and
// w^(n+1) = -2 z w^(n) - 2 n w^(n-1). The function is entire, so ten terms leave 1e-14 for steps below 0.03.
std::complex<double> faddeeva_slope(std::complex<double> a, std::complex<double> w_a, std::complex<double> b,
                                    std::complex<double> w_b) {
    const double step = b.real() - a.real();
    if (std::abs(step) * (1.0 + core::maths::hypot(a.real(), a.imag())) >= 0.03) return (w_b - w_a) / step;
    constexpr double two_over_root_pi = 2.0 * std::numbers::inv_sqrtpi;
    std::complex<double> previous = w_a;
    std::complex<double> derivative = -2.0 * product(a, w_a) + std::complex<double>{0.0, two_over_root_pi};
    std::complex<double> slope = 0.0;
    double factor = 1.0;  // step^(n-1) / n!
    for (int n = 1; n <= 10; ++n) {
        slope += factor * derivative;
        const std::complex<double> next = -2.0 * product(a, derivative) - 2.0 * n * previous;
        previous = derivative;
        derivative = next;
        factor *= step / (n + 1);
    }
    return slope;
}

}  // namespace zlg::twin
