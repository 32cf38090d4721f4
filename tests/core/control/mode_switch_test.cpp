// The start, what a switch starts from and what it measures.
#include "mode_switch_support.hpp"

namespace zlg::core::test::mode_switch_test {

static_assert(is_allowed(config));
static_assert(is_allowed(ModeSwitchConfig{}));
static_assert(!is_allowed(ModeSwitchConfig{.gap_ticks = 0}));
static_assert(!is_allowed(ModeSwitchConfig{.dark_ticks = 1 << 25}));
static_assert(!is_allowed(ModeSwitchConfig{.settle_ticks = 60}));
static_assert(!is_allowed(ModeSwitchConfig{.lock_tolerance = Wavelengths{not_a_number}}));
static_assert(!is_allowed(ModeSwitchConfig{.start_set_point = Volts{301.0}}));
static_assert(!is_allowed(ModeSwitchConfig{.start_polarity = 0}));
static_assert(!is_allowed(ModeSwitchConfig{.range = {.max = Volts{not_a_number}}}));

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
    const ModeSwitchState& first = q.half(locked);
    EXPECT_TRUE(first.loop_closed);
    EXPECT_EQ(first.polarity, 1);
    EXPECT_EQ(first.set_point_v, 150.0);
    q.halves(6, locked);
    EXPECT_EQ(q.state.phase, SwitchPhase::settling);
    (void)q.half(locked);  // the eighth: four ticks
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
    EXPECT_EQ(q.n_events, 0);
}

TEST(ModeSwitch, UPlusIsTheMeanOfTheLastReadingsInLock) {
    Sequence q;
    q.track();
    const auto read = [&q](double piezo_v, const Half& seen) {
        q.piezo_v = piezo_v;
        (void)q.half(seen);
    };
    for (const double v : {100.0, 151.0, 152.0, 153.0, 154.0, 155.0, 156.0}) read(v, locked);
    read(290.0, dark);  // not in lock: does not count
    read(157.0, locked);
    read(1e9, locked);  // not of this stage: does not count either
    read(158.0, locked);
    (void)q.half(missed, true);
    EXPECT_NEAR(q.state.good_v, 154.5, 1e-12);
    EXPECT_NEAR(q.state.set_point_v, 114.5, 1e-12);
}

struct Unmeasured {
    const char* claim;
    Halves before;
    Half last;  // of the tick at whose end the loop opens
    double set_point_v;
    Halves after;
};

TEST(ModeSwitch, WithoutFreshReadingsOfBothSidesNothingIsMeasured) {
    for (const Unmeasured& row : std::vector<Unmeasured>{
             {"without readings the command stands in", {{8, unread}}, unread, 170.0, {{8, locked}}},
             {"stale ones are good enough to steer", {{8, locked}, {100, missed}}, missed, 120.0, {{8, locked}}},
             {"those from before the switch are none from after it", {{8, locked}}, locked, 120.0, {{8, unread}}},
             {"nor are stale ones", {{8, locked}}, locked, 120.0, {{1, locked}, {10, missed}, {7, unread}}}}) {
        SCOPED_TRACE(row.claim);
        Sequence q;
        q.set_point_v = 130.0;
        q.halves(row.before);
        q.open(row.last);
        EXPECT_EQ(q.state.set_point_v, row.set_point_v);
        q.pass_gap(row.last.missed ? missed : dark);
        q.piezo_v = row.set_point_v;
        q.halves(row.after);
        EXPECT_EQ(q.event.outcome, SwitchOutcome::switched);
        EXPECT_EQ(q.n_events, 1);
        EXPECT_FALSE(q.event.has_half_wave);
    }
}

TEST(ModeSwitch, AReadingIsFreshForFourTicksAndNoLonger) {
    // 8 halves after the last reading, the one before the opening included; and 9, of which one was locked but unread.
    for (const int age : {8, 9, 10}) {
        Sequence s;
        s.track();
        s.halves({{1, locked}, {1, age == 9 ? unread : locked}, {age == 9 ? 6 : age - 2, missed}});
        s.open(missed);
        EXPECT_EQ(s.state.good_measured, age == 8) << age;
    }
}

TEST(ModeSwitch, OneReadingIsEnough) {
    Sequence s;
    s.halves(8, unread);
    s.expect(SwitchPhase::tracking);
    s.piezo_v = 163.0;
    s.halves({{1, locked}, {1, unread}});
    s.open(unread);
    EXPECT_TRUE(s.state.good_measured);
    EXPECT_EQ(s.state.good_v, 163.0);
}

TEST(ModeSwitch, TheHalfWaveVoltageIsAMagnitudeHoweverSmall) {
    for (const double step_v : {40.0, 0.5, 0.0, -0.5, -40.0}) {
        Sequence s;
        s.to_settling();
        s.piezo_v = 160.0 + step_v;
        s.track();
        ASSERT_EQ(s.event.outcome, SwitchOutcome::switched);
        ASSERT_TRUE(s.event.has_half_wave);
        EXPECT_EQ(s.event.half_wave_v, std::fabs(step_v));
        EXPECT_FALSE(std::signbit(s.event.half_wave_v));
    }
}

TEST(ModeSwitch, ADetuningThatWasNotMeasuredIsNoLock) {
    for (const Half& half : {Half{.usable = false}, Half{.detuning_lambda = not_a_number},
                             Half{.detuning_lambda = std::numeric_limits<double>::infinity()}}) {
        Sequence s;
        s.halves(20, half);
        EXPECT_EQ(s.state.n_locked, 0);
        EXPECT_EQ(s.state.n_lost, 0);
        EXPECT_FALSE(s.state.smoothing);
        EXPECT_EQ(s.state.detuning_lambda, 0.0);
    }
}

// Every half is outside the tolerance of 0.02 by itself, their mean is not.
TEST(ModeSwitch, NoiseOfSingleHalvesDoesNotPreventALock) {
    Sequence q;
    q.to_settling();
    for (int half = 0; half < 24 && q.state.phase == SwitchPhase::settling; ++half)
        (void)q.half({.detuning_lambda = half % 2 == 0 ? 0.03 : -0.03});
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
}

TEST(ModeSwitch, WithoutRoomTheSetPointStaysInside) {
    constexpr ModeSwitchConfig narrow{.range = {.min = Volts{0.0}, .max = Volts{60.0}, .margin = Volts{5.0}},
                                      .start_set_point = Volts{30.0}};
    static_assert(is_allowed(narrow));
    Sequence s{narrow};
    s.piezo_v = 29.0;
    s.halves(40, locked);
    s.open();
    EXPECT_EQ(s.state.set_point_v, 60.0);
}

struct Place {
    PiezoRange range;
    double piezo_v;
    int sign;  // 0: either
    bool out_of_range = false;
};

// The room is what lies between the neighbour, 40 V away, and the end of the range, wherever that begins. Where neither
// keeps the margin the roomier one is taken, and said.
TEST(ModeSwitch, DirectionLeadsTowardsTheMiddleOfTheRange) {
    constexpr PiezoRange whole{};
    constexpr PiezoRange raised{.min = Volts{100.0}, .max = Volts{300.0}, .margin = Volts{5.0}};
    constexpr PiezoRange narrow{.min = Volts{0.0}, .max = Volts{80.0}, .margin = Volts{5.0}};
    for (const Place& place :
         {Place{whole, 120.0, 1}, Place{whole, 180.0, -1}, Place{whole, 5.0, 1}, Place{whole, 295.0, -1},
          Place{whole, 150.0, 0}, Place{raised, 180.0, 1}, Place{raised, 220.0, -1}, Place{narrow, 38.0, 1, true},
          Place{narrow, 42.0, -1, true}, Place{narrow, 35.0, 0}}) {  // the last one lands on the margin itself
        const SwitchDirection direction = choose_direction(place.range, Volts{place.piezo_v}, Volts{40.0});
        if (place.sign != 0) EXPECT_EQ(direction.sign, place.sign) << place.piezo_v;
        EXPECT_EQ(direction.out_of_range, place.out_of_range) << place.piezo_v;
    }
}

}  // namespace zlg::core::test::mode_switch_test
