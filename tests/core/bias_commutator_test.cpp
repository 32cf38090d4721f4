#include <gtest/gtest.h>

#include <limits>
#include <zlg/core/bias_commutator.hpp>

namespace zlg::core {
namespace {

constexpr BiasCommutatorConfig config{.half_ticks = 25000, .tolerance_ticks = 2};
static_assert(check(config) == BiasCommutatorFault::none);
static_assert(check(BiasCommutatorConfig{.half_ticks = 0}) == BiasCommutatorFault::half_ticks);
static_assert(check(BiasCommutatorConfig{.half_ticks = std::uint64_t{1} << 33}) == BiasCommutatorFault::half_ticks);
static_assert(check(BiasCommutatorConfig{.half_ticks = 2, .tolerance_ticks = 2}) == BiasCommutatorFault::tolerance);

constexpr std::int8_t alternating(int half, int first) {
    return static_cast<std::int8_t>(half % 2 == 0 ? first : -first);
}

TEST(BiasCommutator, LearnsWhichSignComesFirstAndPredictsTheNext) {
    for (const int first : {1, -1}) {
        BiasCommutatorState s;
        for (int half = 0; half < 10; ++half) {
            const auto stamp = static_cast<std::uint64_t>(half) * 25000;
            const BiasCommutatorOutput out = step(config, s, {true, alternating(half, first), stamp});
            EXPECT_EQ(out.sign, alternating(half, first));
            EXPECT_EQ(out.next_sign, alternating(half + 1, first));
            EXPECT_EQ(out.edge_offset_ticks, 0);
            EXPECT_FALSE(out.sign_error || out.timer_error);
        }
    }
}

TEST(BiasCommutator, AMissedFirstFrameDoesNotSpoilTheLearning) {
    BiasCommutatorState s;
    (void)step(config, s, {false, 0, 0});
    (void)step(config, s, {false, 0, 0});
    const BiasCommutatorOutput out = step(config, s, {true, -1, 75000});
    EXPECT_EQ(out.sign, -1);
    EXPECT_FALSE(out.sign_error);
}

TEST(BiasCommutator, AWrongEchoIsOverruledByTheAlternation) {
    for (const std::int8_t wrong : {std::int8_t{0}, std::int8_t{1}, std::int8_t{-128}, std::int8_t{127}}) {
        BiasCommutatorState s;
        (void)step(config, s, {true, 1, 0});
        const BiasCommutatorOutput out = step(config, s, {true, wrong, 25000});
        EXPECT_EQ(out.sign, -1);
        EXPECT_TRUE(out.sign_error);
        const BiasCommutatorOutput next = step(config, s, {true, 1, 50000});
        EXPECT_EQ(next.sign, 1);
        EXPECT_FALSE(next.sign_error);
    }
}

TEST(BiasCommutator, AMissedHalfAlternatesToo) {
    BiasCommutatorState s;
    (void)step(config, s, {true, 1, 0});
    EXPECT_EQ(step(config, s, {false, 1, 0}).sign, -1);
    const BiasCommutatorOutput out = step(config, s, {true, 1, 50000});
    EXPECT_FALSE(out.sign_error);
    EXPECT_FALSE(out.timer_error);  // two halves have passed since the last stamp
}

TEST(BiasCommutator, FourContradictionsInARowAreBelieved) {
    BiasCommutatorState s;
    std::uint64_t stamp = 0;
    (void)step(config, s, {true, 1, stamp});
    for (int half = 0; half < 4; ++half) {
        const BiasCommutatorOutput out = step(config, s, {true, alternating(half, 1), stamp += 25000});
        EXPECT_TRUE(out.sign_error);
        EXPECT_EQ(out.sign, half < 3 ? -alternating(half, 1) : alternating(half, 1));
    }
    EXPECT_FALSE(step(config, s, {true, 1, stamp += 25000}).sign_error);
}

TEST(BiasCommutator, AStuckEchoIsNeverBelieved) {
    BiasCommutatorState s;
    for (int half = 0; half < 100; ++half) {
        const auto stamp = static_cast<std::uint64_t>(half) * 25000;
        EXPECT_EQ(step(config, s, {true, 1, stamp}).sign, alternating(half, 1));
    }
}

TEST(BiasCommutator, TheStampMustAdvanceByTheNominalHalfWithinTheTolerance) {
    for (const int deviation : {-3, -2, 0, 2, 3}) {
        BiasCommutatorState s;
        (void)step(config, s, {true, 1, 1000000});
        const auto stamp = static_cast<std::uint64_t>(1025000 + deviation);
        EXPECT_EQ(step(config, s, {true, -1, stamp}).timer_error, deviation == 3 || deviation == -3) << deviation;
        EXPECT_FALSE(step(config, s, {true, 1, stamp + 25000}).timer_error);  // goes on from the stamp received
    }
}

TEST(BiasCommutator, TheTimerMayWrap) {
    BiasCommutatorState s;
    const std::uint64_t before = std::numeric_limits<std::uint64_t>::max() - 9999;
    (void)step(config, s, {true, 1, before});
    EXPECT_FALSE(step(config, s, {true, -1, 15000}).timer_error);
    EXPECT_TRUE(step(config, s, {true, 1, 0}).timer_error);
}

}  // namespace
}  // namespace zlg::core
