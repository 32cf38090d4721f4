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

void add_all(LearntMotion& memory, const std::vector<double>& x, std::int64_t first_half) {
    for (std::size_t s = 0; s < x.size(); ++s)
        add(memory, first_half + static_cast<std::int64_t>(s), true, x[s], forget_ticks);
}

TEST(LearntMotion, HoldsTheProductsOfAllWindowsOfARun) {
    for (const int length : {8, 20, 62}) {
        LearntMotion memory;
        start(memory, length, 1);
        const auto x = some_motion(10 * part_halves, 3);
        add_all(memory, x, 0);
        add(memory, 10 * part_halves, false, 0.0, forget_ticks);
        EXPECT_EQ(memory.moments.n_windows, 10 * part_halves - length + 1);
        expect_equal(memory, direct(x, 0, x.size(), static_cast<unsigned>(length)));
    }
}

TEST(LearntMotion, HalvesThatBeginAPartWithoutEndingItAreNotIn) {
    LearntMotion whole;
    LearntMotion more;
    start(whole, 20, 1);
    start(more, 20, 1);
    const auto x = some_motion(4 * part_halves + 9, 5);
    add_all(whole, {x.begin(), x.begin() + 4 * part_halves}, 0);
    add_all(more, x, 0);
    add(whole, 0, false, 0.0, forget_ticks);
    add(more, 0, false, 0.0, forget_ticks);
    EXPECT_EQ(whole.moments, more.moments);
}

TEST(LearntMotion, ARunThatBeginsWithinAPartLosesNothingOfIt) {
    LearntMotion memory;
    start(memory, 8, 1);
    const auto x = some_motion(part_halves + 5, 6);
    add_all(memory, x, 3 * part_halves - 5);
    add(memory, 4 * part_halves, false, 0.0, forget_ticks);
    expect_equal(memory, direct(x, 0, x.size(), 8));
}

TEST(LearntMotion, WindowsThatStraddleBlocksCount) {
    LearntMotion memory;
    start(memory, 20, 1);
    const auto x = some_motion(2 * block_halves, 7);
    add_all(memory, x, 0);
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
    LearntMotion memory;
    start(memory, 62, 1);
    add_all(memory, some_motion(3 * part_halves, 8), 0);
    add(memory, 3 * part_halves, false, 0.0, forget_ticks);
    LearntMotion nothing;
    start(nothing, 62, 1);
    EXPECT_EQ(memory.moments, nothing.moments);
}

}  // namespace zlg::core::learnt_motion_test
