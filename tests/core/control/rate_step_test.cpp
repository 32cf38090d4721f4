#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>

#include <zlg/core/control/rate_step.hpp>

namespace zlg::core {
namespace rate_step_test {

static_assert(check(RateStepConfig{}) == RateStepFault::none);
static_assert(check(RateStepConfig{.block_halves = 200}) == RateStepFault::none);
static_assert(check(RateStepConfig{.block_halves = 3}) == RateStepFault::block_halves);
static_assert(check(RateStepConfig{.block_halves = -2}) == RateStepFault::block_halves);
static_assert(check(RateStepConfig{.min_counts = 0.5}) == RateStepFault::min_counts);
static_assert(check(RateStepConfig{.min_counts = std::numeric_limits<double>::quiet_NaN()}) ==
              RateStepFault::min_counts);

// Halves of 2.5 ms, blocks of half a second, a bias of 150 counts.
constexpr RateStepConfig config{.block_halves = 200};
constexpr double half_s = 0.0025;

// First time at which the rate, in counts a second, has stepped; and the last; -1 for never.
struct Seen {
    double from_s = -1.0, to_s = -1.0;
};

Seen seen(
    const std::function<double(double)>& rate, double length_s, RateStepState s = {},
    const std::function<bool(double)>& is_open = [](double) { return false; }) {
    Seen result;
    double place = 0.3;
    double counted = 0.0;
    for (std::int64_t half = 0; static_cast<double>(half) * half_s < length_s; ++half) {
        const double t_s = (static_cast<double>(half) + 0.5) * half_s;
        place += rate(t_s) * half_s;
        const double read = std::floor(place);
        const std::int64_t counts = static_cast<std::int64_t>(read - counted) + (half % 2 == 0 ? 150 : -150);
        counted = read;
        if (!step(config, s, {.is_second = half % 2 != 0, .closed = !is_open(t_s), .counts = counts})) continue;
        if (result.from_s < 0.0) result.from_s = t_s;
        result.to_s = t_s;
    }
    return result;
}

TEST(RateStep, AStepFromRestIsSeenWithinOneAndAHalfSeconds) {
    for (const double size : {8.0, -8.0, 30.0, 1e4})
        for (const double at_s : {5.0, 5.2, 5.49, 12.3}) {
            const Seen got = seen([=](double t) { return t > at_s ? size : 0.0; }, 20.0);
            EXPECT_GT(got.from_s, at_s) << size;
            EXPECT_LT(got.from_s, at_s + 1.51) << size;
            EXPECT_GT(got.to_s, 19.9) << size;
        }
}

TEST(RateStep, SteadyTurnsAndRestMakeNone) {
    for (const double rate : {0.0, 0.37, 4.6, 1000.123, 3e4})
        EXPECT_LT(seen([=](double) { return rate; }, 100.0).from_s, 0.0);
}

TEST(RateStep, AStepOfFewerCountsThanTheLimitIsNone) {
    EXPECT_LT(seen([](double t) { return t > 5.2 ? 1.9 : 0.0; }, 20.0).from_s, 0.0);
}

TEST(RateStep, WhatIsOverAgainWithinABlockIsNone) {
    EXPECT_LT(seen([](double t) { return t > 5.1 && t < 5.5 ? 30.0 : 0.0; }, 20.0).from_s, 0.0);
}

TEST(RateStep, IsOverWhenTheRateIsBack) {
    const Seen got = seen([](double t) { return t > 5.2 && t < 9.2 ? 30.0 : 0.0; }, 20.0);
    EXPECT_GT(got.from_s, 5.2);
    EXPECT_LT(got.to_s, 10.1);
}

// A base that moves is known as such after its first motions; one that swings slowly looks like a step once a swing.
TEST(RateStep, AMovingBaseSoonMakesNoSteps) {
    for (const double hz : {0.02, 0.05, 0.2, 1.1, 7.03, 20.06}) {
        int n = 0;
        RateStepState s;
        for (std::int64_t half = 0; half < 400 * 600; ++half) {
            const double t_s = static_cast<double>(half) * half_s;
            const auto turned = [&](double t) { return 100.0 / hz * std::sin(2.0 * std::numbers::pi * hz * t); };
            const auto counts = static_cast<std::int64_t>(turned(t_s + half_s) - turned(t_s));
            const bool before = s.stepped;
            n += step(config, s, {.is_second = half % 2 != 0, .counts = counts}) && !before;
        }
        EXPECT_LE(n, hz < 0.03 ? 600.0 * hz : 3.0) << hz;
    }
}

TEST(RateStep, AnOpenLoopBeginsAnew) {
    // The rate changes in the gap alone.
    const auto open = [](double t) { return t > 6.0 && t < 6.015; };
    EXPECT_LT(seen([](double t) { return t > 6.0 ? 30.0 : 0.0; }, 20.0, {}, open).from_s, 0.0);
    const Seen got =
        seen([](double t) { return t > 5.0 ? 30.0 : 0.0; }, 20.0, {}, [](double t) { return t > 6.8 && t < 6.815; });
    EXPECT_GT(got.from_s, 0.0);
    EXPECT_LT(got.to_s, 6.8);
}

TEST(RateStep, AnyCountsAreSurvivedAndOffNothingIsSeen) {
    RateStepState s;
    for (int k = 0; k < 5000; ++k) {
        const std::int64_t counts = k % 3 == 0 ? INT64_MAX : (k % 3 == 1 ? INT64_MIN : std::int64_t{1} << 32);
        (void)step({.block_halves = 2}, s, {.is_second = k % 2 != 0, .good = k % 7 != 0, .counts = counts});
        EXPECT_TRUE(std::isfinite(s.level_counts) && std::isfinite(s.scatter_counts));
    }
    const RateStepState before = s;
    EXPECT_FALSE(step(RateStepConfig{}, s, {.counts = 10}));
    EXPECT_EQ(s, before);
}

}  // namespace rate_step_test
}  // namespace zlg::core
