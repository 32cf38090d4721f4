#pragma once
// An expansive discriminator, and curves of measured nodes that undo it.

#include <zlg/core/common/discriminator_curve.hpp>

#include "test.hpp"

namespace zlg::core::test {

// 1.05, 1.24, 1.8, 3.3 times its linear law at 0.05, 0.10, 0.15, 0.20 wavelength.
inline double expansive(double dl) {
    const double x2 = dl * dl;
    return dl * (1.0 + 19.0 * x2 + 200.0 * x2 * x2 + 19000.0 * x2 * x2 * x2);
}

// n nodes on the right, reading `right`; on the left none, or as many that read as above.
inline DiscriminatorCurve expansive_curve(int n, double (*right)(double) = expansive, bool both_sides = false) {
    std::vector<double> x;
    std::vector<double> y;
    for (int k = both_sides ? -n : 1; k <= n; ++k) {
        if (k == 0) continue;
        y.push_back(0.24 * k / n);
        x.push_back(k < 0 ? expansive(y.back()) : right(y.back()));
    }
    return discriminator_curve(x, y);
}

}  // namespace zlg::core::test
