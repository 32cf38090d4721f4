#pragma once
// The minimum of a function of one variable that may have several.

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <limits>

namespace zlg::numeric {

struct Minimum {
    double at = 0.0;
    double value = 0.0;
};

// The least of n + 1 equally spaced points of [low, high], then Brent's method between its neighbours: the global
// minimum wherever the function has one minimum at most within two steps. A point where f is not a number is passed
// over.
template <class Function> Minimum scanned_minimum(Function f, double low, double high, int n) {
    const double step = (high - low) / n;
    Minimum best{low, std::numeric_limits<double>::infinity()};
    for (int k = 0; k <= n; ++k) {
        const double x = low + k * step;
        const double value = f(x);
        if (value < best.value) best = {x, value};
    }
    // A parabola knows the place of its minimum to half the digits of its values only; 20 bits of two steps ask for no
    // more.
    constexpr int bits = 20;
    std::uintmax_t max_steps = 60;
    const auto [at, value] = boost::math::tools::brent_find_minima(f, std::max(low, best.at - step),
                                                                   std::min(high, best.at + step), bits, max_steps);
    return value < best.value ? Minimum{at, value} : best;
}

}  // namespace zlg::numeric
