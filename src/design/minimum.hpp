#pragma once
// The least value of a function of one positive variable, from the sign of its slope.

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/tools/roots.hpp>

namespace zlg::design {

// Budgets are sums of powers of L and of functions of L/tau, whose features are as wide as L itself: a step of 2 % passes
// over none.
inline constexpr double scan_step_ratio = 0.02;

// Where slope changes from negative to not negative between low and high, to the last bits of x. A jump there is a
// kink.
template <class Slope>
double rising_zero(const Slope& slope, double low, double high) {
    std::uintmax_t iterations = 200;
    const auto bracket =
        boost::math::tools::toms748_solve(slope, low, high, boost::math::tools::eps_tolerance<double>(), iterations);
    return bracket.first + (bracket.second - bracket.first) / 2.0;
}

// Point of least value among the minima inside (low, high) and high itself; the smallest of equal ones.
//
// A search on values alone ends at the root of the rounding error, 1e-8 at best; the slope gives the point to full
// precision. value, slope  of x; slope has the sign of the derivative.
template <class Value, class Slope>
double min_point(const Value& value, const Slope& slope, double low, double high) {
    double best = high;
    double best_value = std::numeric_limits<double>::infinity();
    const auto consider = [&](double x) {
        const double at_x = value(x);
        if (at_x < best_value) best = x, best_value = at_x;
    };
    const double cells = std::ceil(std::max(1.0, std::log(high / low) / scan_step_ratio));
    double left = low;
    double left_slope = slope(left);
    for (double cell = 1.0; cell <= cells; ++cell) {
        const double right = cell < cells ? low * std::pow(high / low, cell / cells) : high;
        const double right_slope = slope(right);
        if (left_slope < 0.0 && right_slope >= 0.0) consider(rising_zero(slope, left, right));
        left = right;
        left_slope = right_slope;
    }
    consider(high);
    return best;
}

}  // namespace zlg::design
