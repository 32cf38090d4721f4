#pragma once
// The least value of a function of one variable.

#include <cmath>

namespace zlg::analysis {

struct Least {
    double at = 0.0;
    double value = 0.0;
};

// Scan [low, high] in n steps, then a golden section about the best.
template <class Function>
Least least(Function f, double low, double high, int n) {
    const double step = (high - low) / n;
    Least best{low, f(low)};
    for (int k = 1; k <= n; ++k) {
        const double x = low + k * step;
        const double value = f(x);
        if (value < best.value) best = {x, value};
    }
    constexpr double golden = 0.6180339887498949;
    double a = std::fmax(low, best.at - step);
    double b = std::fmin(high, best.at + step);
    double left = b - golden * (b - a);
    double right = a + golden * (b - a);
    double f_left = f(left);
    double f_right = f(right);
    // 0.618^24 is 1e-5 of a step.
    for (int k = 0; k < 24; ++k) {
        if (f_left < f_right) {
            b = right;
            right = left;
            f_right = f_left;
            left = b - golden * (b - a);
            f_left = f(left);
        } else {
            a = left;
            left = right;
            f_left = f_right;
            right = a + golden * (b - a);
            f_right = f(right);
        }
    }
    if (f_left < best.value) best = {left, f_left};
    if (f_right < best.value) best = {right, f_right};
    return best;
}

}  // namespace zlg::analysis
