#include "noise_means.hpp"
#include "test.hpp"

namespace zlg::deviations::lag_one_test {

// Lag-1 autocorrelation of 1, 2, ..., 40 with 0 between is known: alternating numbers have r1 near -1/2 or beyond.
TEST(LagOne, has_the_exponent_of_a_short_known_sequence) {
    LagOne lag;
    for (int k = 0; k < 40; ++k) lag.add(k % 4 < 2 ? 1.0 : -1.0);
    // Products of neighbours: +1, -1, +1, -1, ... 20 of the first, 19 of the second; 40 squares: r1 = 1/40.
    const double r1 = 1.0 / 40.0;
    EXPECT_NEAR(*lag.exponent(), -2.0 * r1 / (1.0 + r1), 1e-12);
    LagOne constant;
    for (int k = 0; k < 40; ++k) constant.add(3.0);
    EXPECT_FALSE(constant.exponent().has_value());
}

}  // namespace zlg::deviations::lag_one_test
