#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <zlg/core/control/mode_switch.hpp>

namespace zlg::core {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr ModeSwitchConfig config{.gap_ticks = 3, .settle_ticks = 4, .lock_timeout_ticks = 12, .dark_ticks = 2};

static_assert(check(config) == ModeSwitchFault::none);
static_assert(check(ModeSwitchConfig{}) == ModeSwitchFault::none);
static_assert(check(ModeSwitchConfig{.gap_ticks = 0}) == ModeSwitchFault::ticks);
static_assert(check(ModeSwitchConfig{.dark_ticks = 1 << 25}) == ModeSwitchFault::ticks);
static_assert(check(ModeSwitchConfig{.settle_ticks = 60}) == ModeSwitchFault::lock_timeout);
static_assert(check(ModeSwitchConfig{.lock_tolerance = Wavelengths{nan_value}}) == ModeSwitchFault::lock_tolerance);
static_assert(check(ModeSwitchConfig{.start_set_point = Volts{301.0}}) == ModeSwitchFault::start);
static_assert(check(ModeSwitchConfig{.start_polarity = 0}) == ModeSwitchFault::start);
static_assert(check(ModeSwitchConfig{.range = {.max = Volts{nan_value}}}) == ModeSwitchFault::range);

enum class Seen { locked, detuned, dark, missed };

// Feeds the sequencer half by half, on the clock of the ticks.
class Sequence {
public:
    ModeSwitchOutput half(Seen seen, bool due = false) {
        ModeSwitchInput in;
        in.tick_border = half_ % 2 == 1;
        in.next_tick = (half_ + 1) / 2;
        in.due = due;
        in.light_known = seen != Seen::missed;
        in.two_way = seen == Seen::locked || seen == Seen::detuned;
        in.usable = in.two_way;
        in.detuning = Wavelengths{seen == Seen::locked ? 0.001 : 0.2};
        in.piezo = Volts{seen == Seen::missed ? nan_value : piezo_v};
        in.set_point = Volts{set_point_v};
        in.half_wave = Volts{40.0};
        ++half_;
        last_ = step(config, state, in);
        if (last_.has_event) {
            event = last_.event;
            ++n_events;
        }
        return last_;
    }

    void halves(int n, Seen seen) {
        for (int k = 0; k < n; ++k) (void)half(seen);
    }

    // To the state of the name, by the shortest way, ending before the first half of a tick.
    void to_tracking() {
        halves(8, Seen::locked);
        ASSERT_EQ(state.phase, SwitchPhase::tracking);
    }
    void to_open() {
        to_tracking();
        (void)half(Seen::locked);
        (void)half(Seen::locked, true);
        ASSERT_EQ(state.phase, SwitchPhase::open);
    }
    void to_settling() {
        to_open();
        halves(6, Seen::dark);
        ASSERT_EQ(state.phase, SwitchPhase::settling);
    }
    void to_returning() {
        to_settling();
        halves(4, Seen::dark);
        ASSERT_EQ(state.phase, SwitchPhase::returning);
    }
    void to_searching() {
        to_returning();
        halves(6 + 4, Seen::dark);
        ASSERT_EQ(state.phase, SwitchPhase::searching);
    }

    ModeSwitchState state = initial_state(config);
    SwitchEvent event;
    int n_events = 0;
    double piezo_v = 160.0;
    double set_point_v = 150.0;

private:
    std::int64_t half_ = 0;
    ModeSwitchOutput last_;
};

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

// The rows of the table, one test each.

TEST(ModeSwitchTracking, DueOpensOnATickBorderOnly) {
    Sequence q;
    q.to_tracking();
    EXPECT_TRUE(q.half(Seen::locked, true).loop_closed);  // the second half of the tick is still to come
    const ModeSwitchOutput out = q.half(Seen::locked, true);
    EXPECT_FALSE(out.loop_closed);
    EXPECT_EQ(out.polarity, -1);
    EXPECT_EQ(out.set_point, Volts{120.0});  // 160 V is above the middle of 0..300 V: down by 40 V
    EXPECT_EQ(q.state.phase, SwitchPhase::open);
    EXPECT_EQ(q.state.tick_opened, 5);
}

TEST(ModeSwitchTracking, DueOpensWhateverIsSeen) {
    for (const Seen seen : {Seen::detuned, Seen::dark, Seen::missed}) {
        Sequence q;
        q.to_tracking();
        (void)q.half(seen);
        EXPECT_FALSE(q.half(seen, true).loop_closed);
    }
}

TEST(ModeSwitchTracking, ALockLostForTheTimeoutLeadsBack) {
    for (const Seen seen : {Seen::detuned, Seen::dark}) {
        Sequence q;
        q.to_tracking();
        q.halves(22, seen);
        EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
        q.halves(6, seen);
        EXPECT_EQ(q.state.phase, SwitchPhase::returning);
        EXPECT_FALSE(q.state.loop_closed);
        EXPECT_EQ(q.state.polarity, 1);
        EXPECT_EQ(q.state.set_point_v, 160.0);
    }
}

TEST(ModeSwitchTracking, MissedFramesLoseNoLock) {
    Sequence q;
    q.to_tracking();
    q.halves(1000, Seen::missed);
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
}

TEST(ModeSwitchTracking, AShortLossIsForgotten) {
    Sequence q;
    q.to_tracking();
    for (int k = 0; k < 10; ++k) {
        q.halves(20, Seen::dark);
        q.halves(1, Seen::locked);
    }
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
}

TEST(ModeSwitchOpen, LastsExactlyTheGapWhateverIsSeenOrDue) {
    for (const Seen seen : {Seen::locked, Seen::detuned, Seen::dark, Seen::missed}) {
        Sequence q;
        q.to_open();
        int n_open = 1;  // the half that the opening command is for
        while (!q.half(seen, true).loop_closed) ++n_open;
        EXPECT_EQ(n_open, 6);
        EXPECT_EQ(q.state.phase, SwitchPhase::settling);
        EXPECT_EQ(q.state.polarity, -1);
        EXPECT_EQ(q.state.set_point_v, 120.0);
    }
}

TEST(ModeSwitchSettling, ALockCompletesTheSwitchAndMeasures) {
    Sequence q;
    q.to_settling();
    q.piezo_v = 120.9;
    q.halves(7, Seen::locked);
    EXPECT_EQ(q.n_events, 0);
    (void)q.half(Seen::locked, true);  // due is ignored
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
    ASSERT_EQ(q.n_events, 1);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::switched);
    EXPECT_EQ(q.event.tick_opened, 5);
    EXPECT_TRUE(q.event.has_miss);
    EXPECT_EQ(q.event.miss_lambda, 0.001);
    EXPECT_TRUE(q.event.has_half_wave);
    EXPECT_NEAR(q.event.half_wave_v, 39.1, 1e-12);
    EXPECT_FALSE(q.event.out_of_range);
}

TEST(ModeSwitchSettling, NoLockByTheTimeoutLeadsBackToTheLastGoodMode) {
    for (const Seen seen : {Seen::detuned, Seen::missed}) {
        Sequence q;
        q.to_settling();
        q.halves(23, seen);
        EXPECT_EQ(q.state.phase, SwitchPhase::settling);
        const ModeSwitchOutput out = q.half(seen, true);
        EXPECT_EQ(q.state.phase, SwitchPhase::returning);
        EXPECT_FALSE(out.loop_closed);
        EXPECT_EQ(out.polarity, 1);
        EXPECT_EQ(out.set_point, Volts{160.0});
    }
}

TEST(ModeSwitchSettling, DarknessLeadsBackOnTheNextBorder) {
    Sequence q;
    q.to_settling();
    (void)q.half(Seen::locked);
    q.halves(4, Seen::dark);  // four dark halves end in mid-tick
    EXPECT_EQ(q.state.phase, SwitchPhase::settling);
    (void)q.half(Seen::dark);
    EXPECT_EQ(q.state.phase, SwitchPhase::returning);
}

TEST(ModeSwitchSettling, ALockSurvivesAMissedFrameNotADarkHalf) {
    Sequence missed;
    missed.to_settling();
    missed.halves(4, Seen::locked);
    (void)missed.half(Seen::missed);
    missed.halves(4, Seen::locked);
    EXPECT_EQ(missed.state.phase, SwitchPhase::tracking);

    Sequence dark;
    dark.to_settling();
    dark.halves(4, Seen::locked);
    (void)dark.half(Seen::dark);
    dark.halves(7, Seen::locked);
    EXPECT_EQ(dark.state.phase, SwitchPhase::settling);
    (void)dark.half(Seen::locked);
    EXPECT_EQ(dark.state.phase, SwitchPhase::tracking);
}

TEST(ModeSwitchReturning, ALockEndsItWithoutAMeasurement) {
    Sequence q;
    q.to_returning();
    q.halves(6, Seen::missed);
    EXPECT_TRUE(q.state.loop_closed);
    EXPECT_EQ(q.state.phase, SwitchPhase::returning);
    for (int k = 0; k < 8; ++k) (void)q.half(Seen::locked, true);
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
    ASSERT_EQ(q.n_events, 1);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::returned);
    EXPECT_EQ(q.event.tick_opened, 5);  // of the switch that failed
    EXPECT_FALSE(q.event.has_half_wave);
    EXPECT_EQ(q.state.polarity, 1);
}

TEST(ModeSwitchReturning, AFailureLeadsToTheSearch) {
    Sequence by_time;
    by_time.to_returning();
    by_time.halves(6 + 23, Seen::detuned);
    EXPECT_EQ(by_time.state.phase, SwitchPhase::returning);
    (void)by_time.half(Seen::detuned);
    EXPECT_EQ(by_time.state.phase, SwitchPhase::searching);

    Sequence by_dark;
    by_dark.to_returning();
    by_dark.halves(6 + 4, Seen::dark);
    EXPECT_EQ(by_dark.state.phase, SwitchPhase::searching);
}

TEST(ModeSwitchSearching, ALockEndsIt) {
    Sequence q;
    q.to_searching();
    q.halves(6 + 4 + 6, Seen::dark);  // the second place
    ASSERT_TRUE(q.state.loop_closed);
    for (int k = 0; k < 8; ++k) (void)q.half(Seen::locked, true);
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
    ASSERT_EQ(q.n_events, 1);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::found);
    EXPECT_EQ(q.event.tick_opened, 5);
    EXPECT_FALSE(q.event.has_half_wave);
}

TEST(ModeSwitchSearching, GoesThroughTheRangeWithBothHelicitiesRoundAndRound) {
    Sequence q;
    q.to_searching();
    std::set<std::pair<double, int>> places;
    for (int place = 0; place < 30; ++place) {
        places.insert({q.state.set_point_v, q.state.polarity});
        q.halves(6 + 4, Seen::dark);
    }
    // 300 V in steps of half of 40 V, each twice.
    EXPECT_EQ(places.size(), 30u);
    EXPECT_EQ(places.begin()->first, 10.0);
    EXPECT_EQ(places.rbegin()->first, 290.0);
    EXPECT_EQ(places.count({150.0, 1}) + places.count({150.0, -1}), 2u);
    EXPECT_EQ(q.state.set_point_v, 10.0);
    EXPECT_EQ(q.state.phase, SwitchPhase::searching);
}

TEST(ModeSwitchSearching, ADetunedPlaceIsLeftAfterTheTimeout) {
    Sequence q;
    q.to_searching();
    const double first_v = q.state.set_point_v;
    const int first_polarity = q.state.polarity;
    q.halves(6 + 24, Seen::detuned);
    EXPECT_EQ(q.state.set_point_v, first_v);
    EXPECT_EQ(q.state.polarity, -first_polarity);
}

TEST(ModeSwitchSettling, DarkHalvesMustBeInARowToCount) {
    Sequence q;
    q.to_settling();
    for (int k = 0; k < 5; ++k) {
        q.halves(3, Seen::dark);
        q.halves(1, Seen::locked);
    }
    EXPECT_EQ(q.state.phase, SwitchPhase::settling);
}

TEST(ModeSwitchReturning, ALockIsJudgedAfreshAfterEveryClosing) {
    Sequence q;
    q.to_settling();
    q.halves(24 + 6, Seen::detuned);
    ASSERT_EQ(q.state.phase, SwitchPhase::returning);
    q.halves(8, Seen::locked);
    EXPECT_EQ(q.state.phase, SwitchPhase::tracking);
}

TEST(ModeSwitchSearching, ASecondSearchBeginsAnew) {
    Sequence q;
    q.to_searching();
    const double first_v = q.state.set_point_v;
    q.halves(30, Seen::dark);
    ASSERT_NE(q.state.set_point_v, first_v);
    q.halves(6, Seen::dark);
    q.halves(8, Seen::locked);
    ASSERT_EQ(q.state.phase, SwitchPhase::tracking);
    q.halves(24 + 10, Seen::dark);  // lost, back, and searching again
    ASSERT_EQ(q.state.phase, SwitchPhase::searching);
    EXPECT_EQ(q.state.set_point_v, first_v);
}

// What a switch starts from and what it measures.

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
    q.piezo_v = nan_value;
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
    q.piezo_v = nan_value;
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
    q.piezo_v = nan_value;
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

}  // namespace
}  // namespace zlg::core
