#include <zlg/core/compensation/motion_spread.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::motion_spread_test {

using compensation_test::Random;

// Halves of independent noise about a rate: a tick has the variance of two, a second difference that of 1 + 4 + 1.
TEST(MotionSpread, TellsTheVariancesOfTicksAndOfSecondDifferences) {
    Random random{5};
    MotionSpread spread;
    for (int t = 0; t < 20000; ++t) {
        const double first = 900.0 + 0.5 * random.normal();
        add(spread, t % 50 != 49, first, 900.0 + 0.5 * random.normal(), 3000.0);
    }
    // A mean over some 3000 ticks, forgotten exponentially: four of its standard deviations.
    EXPECT_NEAR(spread.mean_half_arcsec, 900.0, 0.02);
    EXPECT_NEAR(spread.tick_arcsec2, 0.5, 0.04);
    EXPECT_NEAR(spread.second_difference_arcsec2, 1.5, 0.15);
}

TEST(MotionSpread, ATickThatIsNotSettledTeachesNothing) {
    MotionSpread spread;
    add(spread, true, 1.0, 2.0, 100.0);
    const MotionSpread before = spread;
    add(spread, false, 1e9, -1e9, 100.0);
    EXPECT_FALSE(spread.goes_on);
    EXPECT_EQ(spread.n_ticks, before.n_ticks);
    EXPECT_EQ(spread.tick_arcsec2, before.tick_arcsec2);
}

}  // namespace zlg::core::motion_spread_test
