#include <zlg/core/control/bias_commutator.hpp>

#include "support.hpp"

namespace zlg::core::bias_commutator_test {

constexpr BiasCommutatorConfig config{.half_ticks = 25000, .tolerance_ticks = 2};
static_assert(is_allowed(config));
static_assert(!is_allowed(BiasCommutatorConfig{.half_ticks = 0}));
static_assert(!is_allowed(BiasCommutatorConfig{.half_ticks = std::uint64_t{1} << 33}));
static_assert(!is_allowed(BiasCommutatorConfig{.half_ticks = 2, .tolerance_ticks = 2}));

constexpr std::int8_t alternating(int half, int first) {
    return static_cast<std::int8_t>(half % 2 == 0 ? first : -first);
}

TEST(BiasCommutator, LearnsWhichSignComesFirstAndWithoutALawMovesNoEdge) {
    for (const int first : {1, -1}) {
        BiasCommutatorState s;
        for (int half = 0; half < 10; ++half) {
            const auto stamp = static_cast<std::uint64_t>(half) * 25000;
            const BiasCommutatorOutput out = step(config, s, true, alternating(half, first), stamp);
            EXPECT_EQ(out.sign, alternating(half, first));
            EXPECT_FALSE(out.sign_error || out.timer_error);
            EXPECT_EQ(next_edge(config, s, {true, 1000, 1}), 0);
        }
        EXPECT_EQ(s.dither, EdgeDitherState{});
    }
}

TEST(BiasCommutator, AMissedFirstFrameDoesNotSpoilTheLearning) {
    BiasCommutatorState s;
    (void)step(config, s, false, 0, 0);
    (void)step(config, s, false, 0, 0);
    const BiasCommutatorOutput out = step(config, s, true, -1, 75000);
    EXPECT_EQ(out.sign, -1);
    EXPECT_FALSE(out.sign_error);
}

TEST(BiasCommutator, AWrongEchoIsOverruledByTheAlternation) {
    for (const std::int8_t wrong : {std::int8_t{0}, std::int8_t{1}, std::int8_t{-128}, std::int8_t{127}}) {
        BiasCommutatorState s;
        (void)step(config, s, true, 1, 0);
        const BiasCommutatorOutput out = step(config, s, true, wrong, 25000);
        EXPECT_EQ(out.sign, -1);
        EXPECT_TRUE(out.sign_error);
        const BiasCommutatorOutput next = step(config, s, true, 1, 50000);
        EXPECT_EQ(next.sign, 1);
        EXPECT_FALSE(next.sign_error);
    }
}

TEST(BiasCommutator, AMissedHalfAlternatesToo) {
    BiasCommutatorState s;
    (void)step(config, s, true, 1, 0);
    EXPECT_EQ(step(config, s, false, 1, 0).sign, -1);
    const BiasCommutatorOutput out = step(config, s, true, 1, 50000);
    EXPECT_FALSE(out.sign_error);
    EXPECT_FALSE(out.timer_error);  // two halves have passed since the last stamp
}

TEST(BiasCommutator, FourContradictionsInARowAreBelieved) {
    BiasCommutatorState s;
    std::uint64_t stamp = 0;
    (void)step(config, s, true, 1, stamp);
    for (int half = 0; half < 4; ++half) {
        const BiasCommutatorOutput out = step(config, s, true, alternating(half, 1), stamp += 25000);
        EXPECT_TRUE(out.sign_error);
        EXPECT_EQ(out.sign, half < 3 ? -alternating(half, 1) : alternating(half, 1));
    }
    EXPECT_FALSE(step(config, s, true, 1, stamp += 25000).sign_error);
}

TEST(BiasCommutator, AStuckEchoIsNeverBelieved) {
    BiasCommutatorState s;
    for (int half = 0; half < 100; ++half) {
        const auto stamp = static_cast<std::uint64_t>(half) * 25000;
        EXPECT_EQ(step(config, s, true, 1, stamp).sign, alternating(half, 1));
    }
}

TEST(BiasCommutator, TheStampMustAdvanceByTheNominalHalfWithinTheTolerance) {
    for (const int deviation : {-3, -2, 0, 2, 3}) {
        BiasCommutatorState s;
        (void)step(config, s, true, 1, 1000000);
        const auto stamp = static_cast<std::uint64_t>(1025000 + deviation);
        EXPECT_EQ(step(config, s, true, -1, stamp).timer_error, deviation == 3 || deviation == -3) << deviation;
        EXPECT_FALSE(step(config, s, true, 1, stamp + 25000).timer_error);  // goes on from the stamp received
    }
}

TEST(BiasCommutator, TheTimerMayWrap) {
    BiasCommutatorState s;
    const std::uint64_t before = std::numeric_limits<std::uint64_t>::max() - 9999;
    (void)step(config, s, true, 1, before);
    EXPECT_FALSE(step(config, s, true, -1, 15000).timer_error);
    EXPECT_TRUE(step(config, s, true, 1, 0).timer_error);
}

constexpr BiasCommutatorConfig dithered = [] {
    BiasCommutatorConfig c;
    c.dither.method = DitherMethod::random;
    return c;
}();
static_assert(is_allowed(dithered));

constexpr bool allows(auto change) { return test::allows(change, dithered); }
static_assert(!allows([](auto& c) { c.half_ticks = 7; }));
static_assert(!allows([](auto& c) { c.half_ticks = (std::uint64_t{1} << 30) + 1; }));
static_assert(!allows([](auto& c) { c.dither.cycle_ticks = 0.0; }));
static_assert(!allows([](auto& c) { c.dither.cycle_ticks = 3126.0; }));
static_assert(allows([](auto& c) { c.dither = {.method = DitherMethod::none, .cycle_ticks = 0.0}; }));

// A gyro that obeys: what is commanded after half h ends half h + 1, whose stamp says so. One that does not is found.
TEST(BiasCommutator, StampsFollowTheCommandedEdges) {
    for (const bool obeys : {true, false}) {
        BiasCommutatorState s;
        std::int32_t commanded = 0;
        int n_moved = 0, n_errors = 0;
        for (int half = 0; half < 1000; ++half) {
            const auto stamp = static_cast<std::uint64_t>(half * 25000 + (obeys ? commanded : 0));
            const bool received = !obeys || half % 7 != 3;
            const BiasCommutatorOutput out = step(dithered, s, received, alternating(half, 1), stamp);
            EXPECT_EQ(s.dither.end_ticks, commanded);
            n_errors += out.timer_error;
            commanded = next_edge(dithered, s, {});
            n_moved += commanded != 0;
        }
        EXPECT_GT(n_moved, 900);
        EXPECT_TRUE(obeys ? n_errors == 0 : n_errors > 900) << n_errors;
    }
}

// The half to come after a positive one is negative, and its end begins a period of the law.
TEST(BiasCommutator, ThePeriodOfTheLawBeginsWhereANegativeHalfEnds) {
    for (const std::int8_t first : {std::int8_t{1}, std::int8_t{-1}}) {
        BiasCommutatorState s;
        (void)step(dithered, s, true, first, 25000);
        (void)next_edge(dithered, s, {});
        EXPECT_EQ(s.dither.period, first > 0 ? 0 : -1);
    }
}

// Due is the end of the next half, as it was commanded: nearer to it than to its neighbours, early or late, is on time.
TEST(BiasCommutator, OnTimeIsNearerToTheCommandedEndThanToAnyOther) {
    for (const std::int32_t edge_ticks : {0, 9000, -9000}) {
        const BiasCommutatorState s{
            .timer_known = true, .expected_ticks = 1'000'000, .dither = {.end_ticks = edge_ticks}};
        const auto at = [&](std::int64_t off_ticks) {
            return is_on_time(config, s, static_cast<std::uint64_t>(1'025'000 + edge_ticks + off_ticks));
        };
        EXPECT_TRUE(at(0) && at(12'499) && at(-12'499)) << edge_ticks;
        EXPECT_FALSE(at(12'500) || at(-12'500) || at(25'000) || at(-25'000)) << edge_ticks;
    }
    EXPECT_FALSE(is_on_time(config, {.expected_ticks = 1'000'000}, 1'025'000)) << "no stamp is known";
}

TEST(BiasCommutator, AStampThatIsFarOffIsALatchAtAnotherTime) {
    const BiasCommutatorConfig c{.latch_ticks = 167};
    for (const std::uint64_t late : {std::uint64_t{0}, std::uint64_t{167}, std::uint64_t{168}}) {
        BiasCommutatorState s;
        (void)step(c, s, true, 1, 25000);
        const auto out = step(c, s, true, -1, 50000 + late);
        EXPECT_EQ(out.timer_error, late > 0);
        EXPECT_EQ(out.latch_error, late > 167);
    }
}

}  // namespace zlg::core::bias_commutator_test
