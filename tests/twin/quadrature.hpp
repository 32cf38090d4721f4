#pragma once
// Adaptive Simpson quadrature, to judge closed forms by.

#include "test.hpp"

namespace zlg::twin {

template <class F>
double simpson_piece(const F& f, double a, double fa, double b, double fb, double m, double fm, double whole,
                     double tolerance, int depth) {
    const double lm = 0.5 * (a + m);
    const double rm = 0.5 * (m + b);
    const double flm = f(lm);
    const double frm = f(rm);
    const double left = (m - a) / 6.0 * (fa + 4.0 * flm + fm);
    const double right = (b - m) / 6.0 * (fm + 4.0 * frm + fb);
    const double miss = left + right - whole;
    if (depth == 0 || std::abs(miss) <= 15.0 * tolerance) return left + right + miss / 15.0;
    return simpson_piece(f, a, fa, m, fm, lm, flm, left, 0.5 * tolerance, depth - 1) +
           simpson_piece(f, m, fm, b, fb, rm, frm, right, 0.5 * tolerance, depth - 1);
}

// int_a^b f, to about `tolerance`; cut into 64 pieces first, so that no narrow peak is overlooked.
template <class F> double integral(const F& f, double a, double b, double tolerance) {
    double sum = 0.0;
    for (int k = 0; k < 64; ++k) {
        const double from = a + (b - a) * k / 64.0;
        const double to = a + (b - a) * (k + 1) / 64.0;
        const double m = 0.5 * (from + to);
        const double f_from = f(from);
        const double f_to = f(to);
        const double f_m = f(m);
        sum += simpson_piece(f, from, f_from, to, f_to, m, f_m, (to - from) / 6.0 * (f_from + 4.0 * f_m + f_to),
                             tolerance / 64.0, 40);
    }
    return sum;
}

}  // namespace zlg::twin
