#include <zlg/numeric/minimum.hpp>

#include "test.hpp"

namespace zlg::numeric::minimum_test {

TEST(ScannedMinimum, parabola_between_two_points_of_the_scan) {
    const Minimum m = scanned_minimum([](double x) { return 3.0 + (x - 0.1234) * (x - 0.1234); }, -1.0, 1.0, 10);
    EXPECT_NEAR(m.at, 0.1234, 1e-6);
    EXPECT_NEAR(m.value, 3.0, 1e-12);
}

// cos(5 x) + x/10 has minima near pi/5 + 2 pi k/5; its derivative is zero where sin(5 x) = 1/50.
TEST(ScannedMinimum, deepest_of_several_minima) {
    const Minimum m = scanned_minimum([](double x) { return std::cos(5.0 * x) + 0.1 * x; }, 0.0, 6.0, 40);
    EXPECT_NEAR(m.at, (std::numbers::pi - std::asin(0.02)) / 5.0, 1e-6);
}

TEST(ScannedMinimum, at_either_end) {
    EXPECT_NEAR(scanned_minimum([](double x) { return x; }, 2.0, 3.0, 5).at, 2.0, 1e-6);
    EXPECT_NEAR(scanned_minimum([](double x) { return -x; }, 2.0, 3.0, 5).at, 3.0, 1e-6);
}

TEST(ScannedMinimum, passes_over_what_is_not_a_number) {
    const auto f = [](double x) { return x < 0.0 ? std::numeric_limits<double>::quiet_NaN() : std::abs(x - 0.52); };
    EXPECT_NEAR(scanned_minimum(f, -1.0, 1.0, 20).at, 0.52, 1e-5);
}

}  // namespace zlg::numeric::minimum_test
