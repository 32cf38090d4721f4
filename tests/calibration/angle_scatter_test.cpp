#include <zlg/calibration/angle_scatter.hpp>

#include "test.hpp"

using namespace zlg::calibration;

namespace {

// Counts of a phase that walks by `walk` counts a tick, drifts, and is read rounded down.
AngleScatter scatter_of(double drift, double walk, double sway, int n, bool dithered = true) {
    std::mt19937_64 random{5};
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    AngleScatter s;
    double phase = 0.2;
    double read = 0.0;
    for (int k = 0; k < n; ++k) {
        phase += drift + walk * normal(random) + sway * std::sin(0.05 * k);
        const double now = std::floor(phase + (dithered ? uniform(random) : 0.0));
        s.take(static_cast<std::int64_t>(now - read));
        read = now;
    }
    return s;
}

}  // namespace

TEST(AngleScatter, a_whole_rate_does_not_scatter) {
    AngleScatter s;
    for (int k = 0; k < 64; ++k) s.take(7);
    for (int scale = 0; scale < 5; ++scale) EXPECT_EQ(s.variance(scale), 0.0);
    EXPECT_EQ(s.pairs(0), 63);
    EXPECT_EQ(s.pairs(1), 31);
    EXPECT_EQ(s.pairs(5), 1);
    EXPECT_EQ(s.pairs(6), 0);
}

TEST(AngleScatter, a_pair_counts_half_its_squared_difference) {
    AngleScatter s;
    for (const int counts : {1, 4, 2, 8}) s.take(counts);
    EXPECT_DOUBLE_EQ(s.variance(0), (9.0 + 4.0 + 36.0) / 6.0);
    EXPECT_DOUBLE_EQ(s.variance(1), 25.0 / 2.0);
}

TEST(AngleScatter, an_interruption_leaves_no_pair_across) {
    AngleScatter s;
    s.take(0);
    s.interrupt();
    s.take(100);
    EXPECT_EQ(s.pairs(0), 0);
    s.take(100);
    EXPECT_EQ(s.pairs(0), 1);
    EXPECT_EQ(s.variance(0), 0.0);
}

TEST(AngleScatter, sums_of_two_are_those_of_all_pairs) {
    AngleScatter a = scatter_of(0.3, 0.1, 0.0, 500);
    const AngleScatter b = scatter_of(0.1, 0.5, 0.0, 300);
    const double expected = (a.variance(0) * 499.0 + b.variance(0) * 299.0) / 798.0;
    a.add(b);
    EXPECT_EQ(a.pairs(0), 798);
    EXPECT_NEAR(a.variance(0), expected, 1e-12);
}

// Each reading enters three terms with weights 1, -2, 1, and their half is taken: 3 times its variance, which for
// rounding with a dither of a whole count is 1/6.
TEST(AngleScatter, rounding_is_the_same_at_every_scale_and_a_walk_grows) {
    const AngleScatter s = scatter_of(0.37, 0.0, 0.0, 200'000);
    for (const int scale : {0, 3, 6}) EXPECT_NEAR(s.variance(scale), 0.5, 0.05) << scale;
    const AngleScatter walk = scatter_of(0.37, 1.0, 0.0, 200'000);
    EXPECT_NEAR(walk.variance(6) - walk.variance(5), 32.0, 3.0);
}

TEST(AngleScatter, rounding_and_its_own_walk_are_rest) {
    EXPECT_TRUE(check_rest(scatter_of(0.37, 0.0, 0.0, 50'000, false), 0.0).at_rest);
    EXPECT_TRUE(check_rest(scatter_of(0.001, 0.0, 0.0, 50'000, false), 0.0).at_rest) << "a counter that stands";
    EXPECT_TRUE(check_rest(scatter_of(0.37, 0.3, 0.0, 50'000), 0.09).at_rest);
}

TEST(AngleScatter, motion_is_not_rest_at_its_own_scale) {
    const RestCheck swayed = check_rest(scatter_of(0.37, 0.0, 0.5, 50'000), 0.0);
    EXPECT_FALSE(swayed.at_rest);
    EXPECT_GT(swayed.worst_ratio, 4.0);
    EXPECT_GE(swayed.worst_ticks, 16);
    // A walk that was found in slow motion is missing at short times.
    const RestCheck slow = check_rest(scatter_of(0.37, 0.01, 0.0, 50'000), 1.0);
    EXPECT_FALSE(slow.at_rest);
    EXPECT_LT(slow.worst_ratio, 0.25);
}
