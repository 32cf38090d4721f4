#pragma once
// Least squares in exact rationals and ticks by exact integrals: what the substitution is held against.

#include <rapidcheck.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <zlg/design/substitution.hpp>

#include "test.hpp"

namespace zlg::design::substitution_test {

using Rational = boost::multiprecision::cpp_rational;

inline std::vector<int> points_of(const Substitution& s) {
    std::vector<int> x;
    if (s.fit == Fit::extrapolation) {
        for (int k = s.points.extrapolation - 1; k >= 0; --k) x.push_back(-k);
        return x;
    }
    for (int k = s.points.before - 1; k >= 0; --k) x.push_back(-k);
    for (int k = 1; k <= s.points.after; ++k) x.push_back(s.n + k);
    return x;
}

inline Rational power(int x, int m) {
    Rational p = 1;
    for (int k = 0; k < m; ++k) p *= x;
    return p;
}

// Coefficients c of G c = v, G_rc = sum_k x_k^(r+c), by elimination.
inline std::vector<Rational> solve_normal(const std::vector<int>& x, std::vector<Rational> v) {
    const std::size_t size = v.size();
    std::vector<std::vector<Rational>> g(size, std::vector<Rational>(size, 0));
    for (std::size_t r = 0; r < size; ++r)
        for (std::size_t c = 0; c < size; ++c)
            for (const int p : x) g[r][c] += power(p, static_cast<int>(r + c));
    for (std::size_t pivot = 0; pivot < size; ++pivot) {  // G is positive definite: no pivot is 0
        for (std::size_t r = 0; r < size; ++r) {
            if (r == pivot) continue;
            const Rational factor = g[r][pivot] / g[pivot][pivot];
            for (std::size_t c = 0; c < size; ++c) g[r][c] -= factor * g[pivot][c];
            v[r] -= factor * v[pivot];
        }
    }
    for (std::size_t r = 0; r < size; ++r) v[r] /= g[r][r];
    return v;
}

// Weights of the sum over the ticks first..last.
inline std::vector<Rational> exact_weights(const Substitution& s, int first, int last) {
    const auto x = points_of(s);
    std::vector<Rational> target(static_cast<std::size_t>(s.order + 1), 0);
    for (std::size_t m = 0; m < target.size(); ++m)
        for (int j = first; j <= last; ++j) target[m] += power(j, static_cast<int>(m));
    const auto c = solve_normal(x, target);
    std::vector<Rational> weights;
    for (const int p : x) {
        Rational w = 0;
        for (std::size_t m = 0; m < c.size(); ++m) w += c[m] * power(p, static_cast<int>(m));
        weights.push_back(w);
    }
    return weights;
}

// Tick j of A sin(2 pi nu t + phase), t = 0 in the middle of a gap of n ticks.
inline double tick_of(double amplitude, double nu, double phase, int j, int n, double tick_s) {
    const long double w = 2.0L * std::numbers::pi_v<long double> * nu;
    const long double start = (j - 0.5L * (n + 2)) * tick_s;
    const long double a = w * start + phase;
    const long double b = a + w * tick_s;
    return static_cast<double>(amplitude / w * 2.0L * std::sin(0.5L * (a + b)) * std::sin(0.5L * (b - a)));
}

// What (18) leaves of the sum over the ticks first..last, tick by tick.
inline double simulated_error(const Substitution& s, int first, int last, double amplitude, double nu, double phase) {
    const auto x = points_of(s);
    const auto w = exact_weights(s, first, last);
    double error = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        error += w[k].convert_to<double>() * tick_of(amplitude, nu, phase, x[k], s.n, s.tick_s);
    }
    for (int j = first; j <= last; ++j) error -= tick_of(amplitude, nu, phase, j, s.n, s.tick_s);
    return error;
}

// Uniform at once, not growing with the size of the case.
inline int integer_between(int low, int high) {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

inline Substitution any_substitution(int max_n, int max_points) {
    Substitution s;
    s.fit = *rc::gen::element(Fit::extrapolation, Fit::interpolation);
    s.order = integer_between(0, 4);
    s.n = integer_between(1, max_n);
    s.points.extrapolation = integer_between(s.order + 1, max_points);
    s.points.before = integer_between(0, max_points);
    const int min_after = std::max(0, s.order + 1 - s.points.before);
    s.points.after = integer_between(min_after, std::max(min_after, max_points));
    return s;
}

inline double real_between(double low, double high) {
    return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1000001)) / 1e6;
}

}  // namespace zlg::design::substitution_test
