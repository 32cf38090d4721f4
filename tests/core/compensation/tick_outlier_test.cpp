#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>
#include <zlg/core/compensation/tick_outlier.hpp>

namespace zlg::core {
namespace tick_outlier_test {

constexpr double rounding = 1.0 / 6.0;  // variance of a tick, counts^2

// What each tick gains, of whole counts of this motion and these errors of the readings, counts.
std::vector<double> gained(const std::vector<double>& border, const std::vector<double>& error, double start = 0.37) {
    std::vector<double> ticks;
    double before = std::floor(border[0] + start) + error[0];
    for (std::size_t k = 1; k < border.size(); ++k) {
        const double now = std::floor(border[k] + start) + error[k];
        ticks.push_back(now - before);
        before = now;
    }
    std::vector<double> found(ticks.size());
    TickOutlierState state;
    for (std::size_t j = 2; j + 2 < ticks.size(); ++j) {
        const double others = ticks[j - 2] + ticks[j - 1] + ticks[j + 1] + ticks[j + 2];
        found[j] = step(state, ticks[j] - 0.25 * others, rounding, true);
    }
    return found;
}

std::vector<double> even(std::size_t n, double rate) {
    std::vector<double> border(n);
    for (std::size_t k = 0; k < n; ++k) border[k] = rate * static_cast<double>(k);
    return border;
}

TEST(TickOutlier, RoundingOfEvenRotationNeverStandsApart) {
    for (double rate = -3.0; rate < 3.0; rate += 0.01) {
        for (const double gain : gained(even(500, rate), std::vector<double>(500))) ASSERT_EQ(gain, 0.0) << rate;
    }
}

// The variance gained is d^2/4, and |d| is beyond 1.5 counts: five sigma are 2.5 d, more than the error and its rounding.
TEST(TickOutlier, AStepOfTwoCountsAndMoreIsHeldWhereItIsWrongByMoreThanFiveSigma) {
    for (const double size : {2.0, 4.0, 64.0, -2.0, -8.0}) {
        for (double rate = -2.0; rate < 2.0; rate += 0.013) {
            const std::vector<double> border = even(400, rate);
            std::vector<double> error(400);
            for (std::size_t k = 300; k < 400; ++k) error[k] = size;
            const std::vector<double> gain = gained(border, error);
            const double read = std::floor(border[300] + 0.37) - std::floor(border[299] + 0.37);
            const double wrong = std::abs(read + size - rate);
            const double sigma = std::sqrt(rounding + gain[299]);
            ASSERT_LE(wrong, 5.0 * sigma) << size << ", rate " << rate;
        }
    }
}

TEST(TickOutlier, ErrorsInFewerThanOneTickOfSixteenAreNeverLearnt) {
    std::vector<double> error(4000);
    for (std::size_t k = 500; k < 4000; ++k) error[k] = (k / 20) % 2 == 0 ? 16.0 : 0.0;
    const std::vector<double> gain = gained(even(4000, 0.21), error);
    for (std::size_t j = 500; j + 3 < gain.size(); ++j) {
        if (error[j + 1] != error[j]) ASSERT_GE(gain[j], 0.25 * 14.0 * 14.0) << j;
    }
}

TEST(TickOutlier, AVibrationIsTheUsualMotionAfterHundredTicks) {
    std::vector<double> border(2000);
    for (std::size_t k = 500; k < 2000; ++k)
        border[k] = 29.0 * std::sin(2.0 * 3.14159265 * 0.0731 * static_cast<double>(k));
    const std::vector<double> gain = gained(border, std::vector<double>(2000));
    for (std::size_t j = 600; j < 1990; ++j) ASSERT_EQ(gain[j], 0.0) << j;
}

// At four standard deviations: 6e-5 of the ticks.
TEST(TickOutlier, RandomMotionSeldomStandsApart) {
    std::mt19937 random{3};
    std::normal_distribution<double> gauss{0.0, 20.0};
    std::vector<double> border(100'000);
    for (std::size_t k = 1; k < border.size(); ++k) border[k] = border[k - 1] + gauss(random);
    int n = 0;
    for (const double gain : gained(border, std::vector<double>(border.size()))) n += gain > 0.0;
    EXPECT_LE(n, 50);
}

TEST(TickOutlier, WhatIsNotLearntLeavesTheState) {
    TickOutlierState state;
    EXPECT_EQ(step(state, 10.0, rounding, false), 25.0);
    EXPECT_EQ(state, TickOutlierState{});
}

}  // namespace tick_outlier_test
}  // namespace zlg::core
