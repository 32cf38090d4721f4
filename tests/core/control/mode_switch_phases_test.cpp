// The rows of the table in mode_switch.hpp, each at the half where it decides.
#include "mode_switch_support.hpp"

namespace zlg::core::test::mode_switch_phases_test {

using enum SwitchPhase;

struct Row {
    const char* claim;
    void (Sequence::*from)();
    Halves halves;
    SwitchPhase then;
    Halves more;
    SwitchPhase at_last;
};

TEST(ModeSwitchPhases, EachChangesAtTheHalfThatDecidesIt) {
    const auto start = &Sequence::start, track = &Sequence::track, settle = &Sequence::to_settling,
               come_back = &Sequence::to_returning;
    for (const Row& row : std::vector<Row>{
             {"missed frames lose no lock", track, {{1000, missed}}, tracking, {}, tracking},
             {"a loss is of halves in a row, and ends on a border",
              track,
              {{1, locked}, {23, dark}, {1, locked}, {23, dark}},
              tracking,
              {{2, dark}},
              returning},
             {"the tolerance itself", start, {{7, {0.02}}}, settling, {{1, {0.02}}}, tracking},
             {"the negative tolerance", start, {{7, {-0.02}}}, settling, {{1, {-0.02}}}, tracking},
             {"beyond it", start, {{7, {0.0201}}}, settling, {{1, {0.0201}}}, settling},
             {"beyond the negative one", start, {{7, {-0.0201}}}, settling, {{1, {-0.0201}}}, settling},
             // A half of 0.2 lifts the smoothed detuning to 0.025; 0.875 * 0.025 is outside too, 0.875^2 * 0.025 is
             // not.
             {"a lock is of 8 in a row",
              start,
              {{1, locked}, {1, detuned}, {8, locked}},
              settling,
              {{1, locked}},
              tracking},
             {"of 8 all within it", start, {{7, locked}, {1, detuned}, {8, locked}}, settling, {{1, locked}}, tracking},
             {"darkness of the gap does not count", settle, {{1, missed}, {3, dark}}, settling, {{2, dark}}, returning},
             {"darkness begins at the last light", settle, {{2, detuned}, {3, dark}}, settling, {{1, dark}}, returning},
             {"darkness counts on a border", settle, {{1, locked}, {4, dark}}, settling, {{1, dark}}, returning},
             {"dark halves are of a row",
              settle,
              {{3, dark}, {1, locked}, {3, dark}},
              settling,
              {{2, dark}},
              returning},
             {"a missed frame spares a lock", settle, {{4, locked}, {1, missed}}, settling, {{4, locked}}, tracking},
             {"no dark half does", settle, {{4, locked}, {1, dark}, {7, locked}}, settling, {{1, locked}}, tracking},
             {"a lock in time's last half", settle, {{16, missed}, {7, locked}}, settling, {{1, locked}}, tracking},
             {"a closing begins a lock afresh", settle, {{24 + 6, detuned}}, returning, {{8, locked}}, tracking},
             {"a failed return", come_back, {{6 + 23, detuned}}, returning, {{1, detuned}}, searching}}) {
        SCOPED_TRACE(row.claim);
        Sequence q;
        (q.*row.from)();
        q.halves(row.halves);
        EXPECT_EQ(q.state.phase, row.then);
        q.halves(row.more);
        EXPECT_EQ(q.state.phase, row.at_last);
    }
}

TEST(ModeSwitchTracking, DueOpensOnATickBorderOnly) {
    Sequence q;
    q.track();
    EXPECT_TRUE(q.half(locked, true).loop_closed);  // the second half of the tick is still to come
    const ModeSwitchState& out = q.half(locked, true);
    EXPECT_FALSE(out.loop_closed);
    EXPECT_EQ(out.polarity, -1);
    EXPECT_EQ(out.set_point_v, 120.0);  // 160 V is above the middle of 0..300 V: down by 40 V
    EXPECT_EQ(q.state.phase, open);
    EXPECT_EQ(q.state.tick_opened, 5);
}

TEST(ModeSwitchTracking, DueOpensWhateverIsSeen) {
    for (const Half& seen : {detuned, dark, missed}) {
        Sequence q;
        q.track();
        q.open(seen);
        EXPECT_FALSE(q.state.loop_closed);
    }
}

TEST(ModeSwitchTracking, ALockLostForTheTimeoutLeadsBack) {
    for (const Half& seen : {detuned, dark}) {
        Sequence q;
        q.track();
        q.halves(22, seen);
        EXPECT_EQ(q.state.phase, tracking);
        q.halves(6, seen);
        EXPECT_EQ(q.state.phase, returning);
        EXPECT_FALSE(q.state.loop_closed);
        EXPECT_EQ(q.state.polarity, 1);
        EXPECT_EQ(q.state.set_point_v, 160.0);
    }
}

TEST(ModeSwitchOpen, LastsExactlyTheGapWhateverIsSeenOrDue) {
    for (const Half& seen : {locked, detuned, dark, missed}) {
        Sequence q;
        q.to_open();
        int n_open = 1;  // the half that the opening command is for
        while (!q.half(seen, true).loop_closed) ++n_open;
        EXPECT_EQ(n_open, 6);
        EXPECT_EQ(q.state.phase, settling);
        EXPECT_EQ(q.state.polarity, -1);
        EXPECT_EQ(q.state.set_point_v, 120.0);
    }
}

TEST(ModeSwitchSettling, ALockCompletesTheSwitchAndMeasures) {
    Sequence q;
    q.to_settling();
    q.piezo_v = 120.9;
    q.halves(7, {.detuning_lambda = 0.001});
    EXPECT_EQ(q.n_events, 0);
    (void)q.half(locked, true);  // due is ignored
    EXPECT_EQ(q.state.phase, tracking);
    ASSERT_EQ(q.n_events, 1);
    EXPECT_EQ(q.event.outcome, SwitchOutcome::switched);
    EXPECT_EQ(q.event.tick_opened, 5);
    EXPECT_TRUE(q.event.has_half_wave);
    EXPECT_NEAR(q.event.half_wave_v, 39.1, 1e-12);
}

TEST(ModeSwitchSettling, NoLockByTheTimeoutLeadsBackToTheLastGoodMode) {
    for (const Half& seen : {detuned, missed}) {
        Sequence q;
        q.to_settling();
        q.halves(23, seen);
        EXPECT_EQ(q.state.phase, settling);
        const ModeSwitchState& out = q.half(seen, true);
        EXPECT_EQ(q.state.phase, returning);
        EXPECT_FALSE(out.loop_closed);
        EXPECT_EQ(out.polarity, 1);
        EXPECT_EQ(out.set_point_v, 160.0);
    }
}

TEST(ModeSwitchReturning, ALockEndsAReturnOrASearchWithoutAMeasurement) {
    for (const bool returns : {true, false}) {
        Sequence q;
        if (returns) {
            q.to_returning();
            q.pass_gap(missed);
            q.expect(returning);
        } else {
            q.to_searching();
            q.halves(6 + 4 + 6, dark);  // the second place
            ASSERT_TRUE(q.state.loop_closed);
        }
        for (int k = 0; k < 8; ++k) (void)q.half(locked, true);
        EXPECT_EQ(q.state.phase, tracking);
        ASSERT_EQ(q.n_events, 1);
        EXPECT_EQ(q.event.outcome, returns ? SwitchOutcome::returned : SwitchOutcome::found);
        EXPECT_EQ(q.event.tick_opened, 5);  // of the switch that failed
        EXPECT_FALSE(q.event.has_half_wave);
        EXPECT_EQ(q.event.half_wave_v, 0.0);
        if (returns) EXPECT_EQ(q.state.polarity, 1);
    }
}

TEST(ModeSwitchReturning, LeadsToTheHelicityBeforeTheLastSwitch) {
    Sequence q;
    q.to_settling();
    q.track();
    ASSERT_EQ(q.state.polarity, -1);
    q.open();
    EXPECT_EQ(q.state.polarity, 1);
    q.pass_gap();
    q.halves(4, dark);
    q.expect(returning);
    EXPECT_EQ(q.state.polarity, -1);
}

TEST(ModeSwitchReturning, TheStartIsThePlaceToReturnTo) {
    ModeSwitchConfig c = config;
    c.start_set_point = Volts{100.0};
    c.start_polarity = -1;
    Sequence q{c};
    for (const SwitchPhase phase : {settling, returning}) {
        q.expect(phase);
        EXPECT_EQ(q.state.polarity, -1);
        EXPECT_EQ(q.state.set_point_v, 100.0);
        q.halves(4, dark);
    }
}

// From the start, dark: back to the start, then place after place. Gives the command of the first n places.
std::vector<ModeSwitchState> places(double half_wave_v, int n) {
    ModeSwitchConfig c = config;
    c.range = {.min = Volts{100.0}, .max = Volts{400.0}};
    c.start_polarity = -1;
    Sequence q{c};
    q.half_wave_v = half_wave_v;
    q.halves(4 + 6, dark);
    std::vector<ModeSwitchState> found;
    for (int k = 0; k < n; ++k) {
        q.halves(4, dark);
        EXPECT_EQ(q.state.phase, searching);
        found.push_back(q.state);
        q.halves(6, dark);
    }
    return found;
}

TEST(ModeSwitchSearching, TriesEachPlaceFirstWithTheHelicityThatWasHeldLastRoundAndRound) {
    // 2 * 300/40 = 15 places.
    const auto found = places(40.0, 2 * 15 + 1);
    for (unsigned k = 0; k < 30; ++k) {
        EXPECT_DOUBLE_EQ(found[k].set_point_v, 100.0 + 300.0 * (k / 2 + 0.5) / 15.0);
        EXPECT_EQ(found[k].polarity, k % 2 == 0 ? -1 : 1);
    }
    EXPECT_EQ(found[30].set_point_v, found[0].set_point_v);
}

TEST(ModeSwitchSearching, AWideModeHasOnePlaceAndANarrowOneAThousand) {
    // 0.6, 1.5 and 6000 places wanted.
    EXPECT_EQ(places(1000.0, 3)[2].set_point_v, 250.0);
    EXPECT_EQ(places(400.0, 3)[2].set_point_v, 250.0);
    EXPECT_DOUBLE_EQ(places(0.1, 1)[0].set_point_v, 100.0 + 300.0 * 0.5 / 1000.0);
    EXPECT_DOUBLE_EQ(places(1e-9, 3)[2].set_point_v, 100.0 + 300.0 * 1.5 / 1000.0);
}

TEST(ModeSwitchSearching, ADetunedPlaceIsLeftAfterTheTimeout) {
    Sequence q;
    q.to_searching();
    const ModeSwitchState first = q.state;
    q.halves(6 + 24, detuned);
    EXPECT_EQ(q.state.set_point_v, first.set_point_v);
    EXPECT_EQ(q.state.polarity, -first.polarity);
}

TEST(ModeSwitchSearching, ASecondSearchBeginsAnew) {
    Sequence q;
    q.to_searching();
    const double first_v = q.state.set_point_v;
    q.halves(30, dark);
    ASSERT_NE(q.state.set_point_v, first_v);
    q.halves(6, dark);
    q.track();
    q.halves(24 + 10, dark);  // lost, back, and searching again
    q.expect(searching);
    EXPECT_EQ(q.state.set_point_v, first_v);
}

}  // namespace zlg::core::test::mode_switch_phases_test
