// The start, what a switch starts from and what it measures.
#include "mode_switch_support.hpp"

#include <gtest/gtest.h>
#include <zlg/core/common/maths.hpp>

#include <cmath>
#include <utility>

namespace zlg::core::test::mode_switch_test {

static_assert(check(config) == ModeSwitchFault::none);
static_assert(check(ModeSwitchConfig{}) == ModeSwitchFault::none);
static_assert(check(ModeSwitchConfig{.gap_ticks = 0}) == ModeSwitchFault::ticks);
static_assert(check(ModeSwitchConfig{.dark_ticks = 1 << 25}) == ModeSwitchFault::ticks);
static_assert(check(ModeSwitchConfig{.settle_ticks = 60}) == ModeSwitchFault::lock_timeout);
static_assert(check(ModeSwitchConfig{.lock_tolerance = Wavelengths{not_a_number}}) == ModeSwitchFault::tolerance);
static_assert(check(ModeSwitchConfig{.start_set_point = Volts{301.0}}) == ModeSwitchFault::start);
static_assert(check(ModeSwitchConfig{.start_polarity = 0}) == ModeSwitchFault::start);
static_assert(check(ModeSwitchConfig{.range = {.max = Volts{not_a_number}}}) == ModeSwitchFault::range);

// 160 V lead down to 120 V and 120 V up to 160 V, either with the same hysteresis.
TEST(ModeSwitch, TheOffsetIsAddedToAMoveInEitherDirection) {
    for (const auto& [piezo_v, target_v] : {std::pair{160.0, 123.0}, {120.0, 163.0}}) {
        Sequence s;
        s.piezo_v = s.set_point_v = piezo_v;
        s.offset_v = 3.0;
        s.to_open();
        EXPECT_NEAR(s.state.set_point_v, target_v, 1e-9);
    }
}

TEST(ModeSwitch, StartsClosedAtTheStartPointAndTracksAfterTheFirstLock) {
    Sequence q;
    const ModeSwitchOutput first = q.half(Seen::locked);
    EXPECT_TRUE(first.loop_closed);
    EXPECT_EQ(first.polarity, 1);
    EXPECT_EQ(first.set_point, Volts{150.0});
    q.halves(6, Seen::locked);
    EXPECT_EQ(q.state.phase, SwitchPhase::settling);
    (void)q.half(Seen::locked);  // the eighth: four ticks
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
    EXPECT_EQ(q.n_events, 0);
}

TEST(ModeSwitch, HelicityAlternatesAndSoDoesTheStep) {
    Sequence q;
    q.to_tracking();
    int polarity = 1;
    for (int n = 0; n < 6; ++n) {
        (void)q.half(Seen::locked);
        (void)q.half(Seen::locked, true);
        EXPECT_EQ(q.state.polarity, -polarity);
        polarity = -polarity;
        EXPECT_EQ(q.state.set_point_v, n % 2 == 0 ? 120.0 : 160.0);
        q.halves(6, Seen::dark);
        q.piezo_v = q.state.set_point_v;
        q.halves(8, Seen::locked);
    }
    EXPECT_EQ(q.n_events, 6);
}

TEST(ModeSwitch, UPlusIsTheMeanOfTheLastReadingsInLock) {
    Sequence q;
    q.to_tracking();
    for (const double v : {100.0, 151.0, 152.0, 153.0, 154.0, 155.0, 156.0}) {
        q.piezo_v = v;
        (void)q.half(Seen::locked);
    }
    q.piezo_v = 290.0;
    (void)q.half(Seen::dark);  // not in lock: does not count
    q.piezo_v = 157.0;
    (void)q.half(Seen::locked);
    q.piezo_v = 1e9;  // not of this stage: does not count either
    (void)q.half(Seen::locked);
    q.piezo_v = 158.0;
    (void)q.half(Seen::locked);
    (void)q.half(Seen::missed, true);
    EXPECT_NEAR(q.state.good_v, 154.5, 1e-12);
    EXPECT_NEAR(q.state.set_point_v, 114.5, 1e-12);
}

TEST(ModeSwitch, WithoutReadingsTheCommandStandsInAndNothingIsMeasured) {
    Sequence q;
    q.piezo_v = not_a_number;
    q.set_point_v = 130.0;
    q.to_open();
    EXPECT_EQ(q.state.set_point_v, 170.0);
    q.halves(6, Seen::dark);
    q.piezo_v = 170.0;
    q.halves(8, Seen::locked);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::switched);
    EXPECT_FALSE(q.event.has_half_wave);
}

TEST(ModeSwitch, StaleReadingsAreGoodEnoughToSteerNotToMeasure) {
    Sequence q;
    q.to_tracking();
    q.halves(100, Seen::missed);
    (void)q.half(Seen::missed);
    (void)q.half(Seen::missed, true);
    EXPECT_EQ(q.state.set_point_v, 120.0);
    q.halves(6, Seen::missed);
    q.halves(8, Seen::locked);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::switched);
    EXPECT_FALSE(q.event.has_half_wave);
}

TEST(ModeSwitch, ReadingsFromBeforeTheSwitchAreNotOnesFromAfterIt) {
    Sequence q;
    q.to_settling();
    q.piezo_v = not_a_number;
    q.halves(8, Seen::locked);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::switched);
    EXPECT_FALSE(q.event.has_half_wave);
}

TEST(ModeSwitch, AStaleReadingAfterTheSwitchMeasuresNothing) {
    Sequence q;
    q.to_settling();
    q.piezo_v = 120.0;
    (void)q.half(Seen::locked);
    q.halves(10, Seen::missed);
    q.piezo_v = not_a_number;
    q.halves(7, Seen::locked);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::switched);
    EXPECT_FALSE(q.event.has_half_wave);
}

TEST(ModeSwitch, AMissedFirstHalfHasNoMiss) {
    Sequence q;
    q.to_settling();
    (void)q.half(Seen::missed);
    q.halves(8, Seen::locked);
    EXPECT_FALSE(q.event.has_miss);
    EXPECT_EQ(q.event.miss_lambda, 0.0);
}

TEST(ModeSwitch, NoiseOfSingleHalvesDoesNotPreventALock) {
    Sequence q;
    q.to_settling();
    ModeSwitchInput in;
    in.light_known = in.two_way = in.usable = true;
    in.half_wave = Volts{40.0};
    in.piezo = Volts{120.0};
    // Every half is outside the tolerance of 0.02 by itself, their mean is not.
    in.detuning = Wavelengths{0.03};
    for (int half = 0; half < 24 && q.state.phase == SwitchPhase::settling; ++half) {
        in.tick_border = half % 2 == 1;
        (void)step(config, q.state, in);
        in.detuning = -1.0 * in.detuning;
    }
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
}

TEST(ModeSwitch, OutOfRangeIsSaidAndTheSetPointStaysInside) {
    constexpr ModeSwitchConfig narrow{.range = {.min = Volts{0.0}, .max = Volts{60.0}, .margin = Volts{5.0}},
                                      .start_set_point = Volts{30.0}};
    static_assert(check(narrow) == ModeSwitchFault::none);
    ModeSwitchState s = initial_state(narrow);
    ModeSwitchInput in;
    in.light_known = in.two_way = in.usable = true;
    in.half_wave = Volts{40.0};
    in.piezo = Volts{29.0};
    for (int half = 0; half < 40; ++half) (void)step(narrow, s, in);
    in.due = in.tick_border = true;
    (void)step(narrow, s, in);
    EXPECT_EQ(s.set_point_v, 60.0);
    EXPECT_TRUE(s.out_of_range);
}

}  // namespace zlg::core::test::mode_switch_test
