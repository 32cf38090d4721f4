#include <zlg/core/compensation/learnt_motion.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::learnt_motion_test {

using compensation_test::Random;

constexpr double forget_ticks = 3000.0;

// A walk about a large rate: neighbouring halves go together.
std::vector<double> some_motion(std::size_t n, std::uint32_t seed) {
    Random random{seed};
    std::vector<double> x(n);
    double walk = 0.0;
    for (double& value : x) value = 900.0 + (walk = 0.95 * walk + random.normal()) + 0.1 * random.normal();
    return x;
}

// All windows of the halves from..to, less the mean of these, as sums of products; alike in both directions of time.
std::vector<std::vector<double>> direct(const std::vector<double>& x, std::size_t from, std::size_t to,
                                        std::size_t length) {
    double mean = 0.0;
    for (std::size_t s = from; s < to; ++s) mean += x[s] / static_cast<double>(to - from);
    std::vector<std::vector<double>> sum(length, std::vector<double>(length));
    for (std::size_t t = from; t + length <= to; ++t)
        for (std::size_t i = 0; i < length; ++i)
            for (std::size_t j = 0; j < length; ++j) {
                sum[i][j] += 0.5 * (x[t + i] - mean) * (x[t + j] - mean);
                sum[length - 1 - i][length - 1 - j] += 0.5 * (x[t + i] - mean) * (x[t + j] - mean);
            }
    return sum;
}

void expect_equal(const LearntMotion& memory, const std::vector<std::vector<double>>& sum) {
    const int length = memory.moments.length;
    for (int i = 0; i < length; ++i)
        for (int j = 0; j < length; ++j)
            ASSERT_NEAR(memory.moments.sum[moment_place(length, i, j)],
                        sum[static_cast<unsigned>(i)][static_cast<unsigned>(j)], 1e-9 * sum[0][0])
                << i << ' ' << j;
}

// What halves from `first_half` on have taught; the run ends with them, or goes on.
LearntMotion learnt(int length, const std::vector<double>& x, std::int64_t first_half = 0, bool ends = true) {
    LearntMotion memory;
    start(memory, length, 1);
    for (std::size_t s = 0; s < x.size(); ++s)
        add(memory, first_half + static_cast<std::int64_t>(s), true, x[s], forget_ticks);
    if (ends) add(memory, first_half + static_cast<std::int64_t>(x.size()), false, 0.0, forget_ticks);
    return memory;
}

TEST(LearntMotion, HoldsTheProductsOfAllWindowsOfARun) {
    for (const int length : {8, 20, 62}) {
        const auto x = some_motion(10 * part_halves, 3);
        const LearntMotion memory = learnt(length, x);
        EXPECT_EQ(memory.moments.n_windows, 10 * part_halves - length + 1);
        expect_equal(memory, direct(x, 0, x.size(), static_cast<unsigned>(length)));
    }
}

TEST(LearntMotion, HalvesThatBeginAPartWithoutEndingItAreNotIn) {
    const auto x = some_motion(4 * part_halves + 9, 5);
    EXPECT_EQ(learnt(20, {x.begin(), x.begin() + 4 * part_halves}).moments, learnt(20, x).moments);
}

TEST(LearntMotion, ARunThatBeginsWithinAPartLosesNothingOfIt) {
    const auto x = some_motion(part_halves + 5, 6);
    expect_equal(learnt(8, x, 3 * part_halves - 5), direct(x, 0, x.size(), 8));
}

TEST(LearntMotion, WindowsThatStraddleBlocksCount) {
    const auto x = some_motion(2 * block_halves, 7);
    const LearntMotion memory = learnt(20, x, 0, false);
    const double first = block_halves - 19, second = block_halves;
    const double keep = std::exp(-0.5 * second / forget_ticks);
    EXPECT_NEAR(memory.moments.n_windows, keep * first + second, 1e-9);
    auto sum = direct(x, 0, block_halves, 20);
    const auto other = direct(x, block_halves - 19, 2 * block_halves, 20);
    for (std::size_t i = 0; i < 20; ++i)
        for (std::size_t j = 0; j < 20; ++j) sum[i][j] = keep * sum[i][j] + other[i][j];
    expect_equal(memory, sum);
}

TEST(LearntMotion, AShortRunTeachesNothing) {
    EXPECT_EQ(learnt(62, some_motion(3 * part_halves, 8)).moments, learnt(62, {}).moments);
}

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

}  // namespace zlg::core::learnt_motion_test
