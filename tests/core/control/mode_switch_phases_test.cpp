// The rows of the table in mode_switch.hpp, one test each.
#include "mode_switch_support.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace zlg::core::test::mode_switch_phases_test {

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

}  // namespace zlg::core::test::mode_switch_phases_test
