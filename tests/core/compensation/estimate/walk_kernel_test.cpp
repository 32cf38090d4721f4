#include <zlg/core/compensation/walk_kernel.hpp>

#include "support.hpp"

namespace zlg::core::walk_kernel_test {

double influence(int kind, const Stretch& s, double q) {
    const auto part = [&](double from) { return from > q ? std::pow(from - q, kind) : 0.0; };
    return (part(s.last) - part(s.first)) / kind;
}

// Boole's rule in pieces that end where the polynomials do: exact to the fifth order, and of the sixth by its fine
// step.
double direct(const Walk& walk, const Stretch& a, const Stretch& b) {
    constexpr int steps = 64;
    double sum = 0.0;
    for (int half = walk.first; half < walk.last; ++half)
        for (int k = 0; k < steps; ++k) {
            constexpr double weight[5] = {7.0, 32.0, 12.0, 32.0, 7.0};
            for (int i = 0; i < 5; ++i) {
                const double q = half + (k + 0.25 * i) / steps;
                sum += weight[i] / 90.0 / steps * influence(walk.kind, a, q) * influence(walk.kind, b, q);
            }
        }
    return sum;
}

TEST(WalkKernel, CovariancesOfStretchesAreTheIntegralsOfTheirProducts) {
    const Stretch stretches[] = {{0, 1}, {1, 2}, {2, 4}, {4, 10}, {10, 11}, {15, 17}, {20, 21}};
    for (const int kind : {2, 3})
        for (const Walk& walk : {Walk{kind, 0, 21}, Walk{kind, 1, 12}, Walk{kind, 12, 16}, Walk{kind, 3, 21}})
            for (const Stretch& a : stretches)
                for (const Stretch& b : stretches) {
                    if (a.first > b.first) continue;
                    const auto first = walked(walk, a);
                    const auto second = walked(walk, b);
                    double got = a == b ? first.variance : 0.0;
                    for (int m = 0; m < kind && !(a == b); ++m) got += first.moment[m] * second.coefficient[m];
                    const double want = direct(walk, a, b);
                    EXPECT_NEAR(got, want, 1e-10 * (std::abs(want) + direct(walk, b, b) + 1e-3));
                }
}

}  // namespace zlg::core::walk_kernel_test
