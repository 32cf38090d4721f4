// The counters and borders of the sequencer, each at the half where it decides.
#include <gtest/gtest.h>
#include <zlg/core/common/maths.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>
#include <zlg/core/control/mode_switch.hpp>

namespace zlg::core::mode_switch_edges_test {

// What one half shows. Light is in both directions unless it is dark or missed.
struct Half {
    double detuning_lambda = 0.0;
    double piezo_v = 160.0;
    bool dark = false;
    bool missed = false;
    bool usable = true;
};

constexpr Half locked{};
constexpr Half dark{.dark = true};
constexpr Half missed{.piezo_v = not_a_number, .missed = true};
constexpr Half unread{.piezo_v = not_a_number};  // locked, but the voltage was not read
constexpr Half detuned{.detuning_lambda = 1.0};

// Ticks of 2 halves: a gap of 3, a lock of 4, a timeout of 12, darkness of 2.
class Sequence {
public:
    Sequence()
        : Sequence{ModeSwitchConfig{.gap_ticks = 3, .settle_ticks = 4, .lock_timeout_ticks = 12, .dark_ticks = 2}} {}
    explicit Sequence(const ModeSwitchConfig& c) : config{c}, state{initial_state(c)} {}

    ModeSwitchOutput feed(const Half& half, bool due = false) {
        const ModeSwitchInput in{.due = due,
                                 .tick_border = n_ % 2 == 1,
                                 .next_tick = (n_ + 1) / 2,
                                 .light_known = !half.missed,
                                 .two_way = !half.dark && !half.missed,
                                 .usable = half.usable && !half.dark && !half.missed,
                                 .detuning = Wavelengths{half.detuning_lambda},
                                 .piezo = Volts{half.piezo_v},
                                 .set_point = Volts{150.0},
                                 .half_wave = Volts{half_wave_v}};
        ++n_;
        const ModeSwitchOutput out = step(config, state, in);
        if (out.event) event = *out.event;
        return out;
    }

    void feed(int n, const Half& half) {
        for (int k = 0; k < n; ++k) (void)feed(half);
    }

    // From `tracking`, at the start of a tick: one tick of `last`, at whose end the loop opens.
    void open(const Half& last = locked) {
        (void)feed(last);
        (void)feed(last, true);
        ASSERT_EQ(state.phase, SwitchPhase::open);
    }

    // The gap; then the first half of the closed loop is the next.
    void pass_gap() {
        feed(6, dark);
        ASSERT_TRUE(state.loop_closed);
    }

    void track() {
        feed(8, locked);
        ASSERT_EQ(state.phase, SwitchPhase::tracking);
    }

    ModeSwitchConfig config;
    ModeSwitchState state;
    SwitchEvent event;
    double half_wave_v = 40.0;

private:
    std::int64_t n_ = 0;
};

TEST(ModeSwitchEdges, AReadingIsFreshForFourTicksAndNoLonger) {
    // 8 halves after the last reading, the one before the opening included; and 9, of which one was locked but unread.
    for (const int age : {8, 9, 10}) {
        Sequence s;
        s.track();
        (void)s.feed(locked);
        (void)s.feed(age == 9 ? unread : locked);
        s.feed(age == 9 ? 6 : age - 2, missed);
        s.open(missed);
        EXPECT_EQ(s.state.good_measured, age == 8) << age;
    }
}

TEST(ModeSwitchEdges, OneReadingIsEnough) {
    Sequence s;
    s.feed(8, unread);
    ASSERT_EQ(s.state.phase, SwitchPhase::tracking);
    (void)s.feed({.piezo_v = 163.0});
    (void)s.feed(unread);
    s.open(unread);
    EXPECT_TRUE(s.state.good_measured);
    EXPECT_EQ(s.state.good_v, 163.0);
}

TEST(ModeSwitchEdges, TheToleranceItselfIsWithinIt) {
    for (const double detuning_lambda : {0.02, -0.02}) {
        Sequence s;
        s.feed(8, {.detuning_lambda = detuning_lambda});
        EXPECT_EQ(s.state.phase, SwitchPhase::tracking);
    }
    for (const double detuning_lambda : {0.0201, -0.0201}) {
        Sequence s;
        s.feed(8, {.detuning_lambda = detuning_lambda});
        EXPECT_EQ(s.state.phase, SwitchPhase::settling);
    }
}

// One detuned half of 0.2 lifts the smoothed detuning to 0.025 for one half: then 8 in a row are wanted again.
TEST(ModeSwitchEdges, ALockIsOfHalvesInARow) {
    for (const int n_before : {1, 7}) {
        Sequence s;
        s.feed(n_before, locked);
        (void)s.feed({.detuning_lambda = 0.2});
        // 0.875 * 0.025 is outside as well, 0.875^2 * 0.025 is not.
        s.feed(1 + 7, locked);
        EXPECT_EQ(s.state.phase, SwitchPhase::settling) << n_before;
        (void)s.feed(locked);
        EXPECT_EQ(s.state.phase, SwitchPhase::tracking) << n_before;
    }
}

TEST(ModeSwitchEdges, ALossIsOfHalvesInARow) {
    Sequence s;
    s.track();
    (void)s.feed(locked);
    s.feed(23, dark);
    (void)s.feed(locked);
    s.feed(23, dark);  // the last one ends a tick
    EXPECT_EQ(s.state.phase, SwitchPhase::tracking);
    (void)s.feed(dark);
    (void)s.feed(dark);
    EXPECT_EQ(s.state.phase, SwitchPhase::returning);
}

TEST(ModeSwitchEdges, DarknessIsCountedFromTheLastLight) {
    Sequence s;
    s.track();
    s.open();
    s.pass_gap();
    s.feed(2, detuned);
    s.feed(3, dark);
    EXPECT_EQ(s.state.phase, SwitchPhase::settling);
    (void)s.feed(dark);
    EXPECT_EQ(s.state.phase, SwitchPhase::returning);
}

TEST(ModeSwitchEdges, DarknessOfTheGapDoesNotCount) {
    Sequence s;
    s.track();
    s.open();
    s.pass_gap();
    (void)s.feed(missed);
    s.feed(3, dark);
    EXPECT_EQ(s.state.phase, SwitchPhase::settling);
    s.feed(2, dark);
    EXPECT_EQ(s.state.phase, SwitchPhase::returning);
}

TEST(ModeSwitchEdges, ADetuningThatWasNotMeasuredIsNoLock) {
    for (const Half& half : {Half{.usable = false}, Half{.detuning_lambda = not_a_number},
                             Half{.detuning_lambda = std::numeric_limits<double>::infinity()}}) {
        Sequence s;
        s.feed(20, half);
        EXPECT_EQ(s.state.n_locked, 0);
        EXPECT_EQ(s.state.n_lost, 0);
        EXPECT_FALSE(s.state.smoothing);
        EXPECT_EQ(s.state.detuning_lambda, 0.0);
    }
}

TEST(ModeSwitchEdges, AMissBelongsToItsOwnSwitch) {
    Sequence s;
    s.track();
    s.open();
    s.pass_gap();
    (void)s.feed({.detuning_lambda = 0.01});
    s.feed(7, locked);
    ASSERT_EQ(s.state.phase, SwitchPhase::tracking);
    EXPECT_TRUE(s.event.has_miss);
    EXPECT_EQ(s.event.miss_lambda, 0.01);
    s.open();
    s.pass_gap();
    (void)s.feed(missed);
    s.feed(8, locked);
    ASSERT_EQ(s.state.phase, SwitchPhase::tracking);
    EXPECT_FALSE(s.event.has_miss);
    EXPECT_EQ(s.event.miss_lambda, 0.0);
}

// A half-wave voltage of 200 V leads out of the range from 160 V on both sides.
TEST(ModeSwitchEdges, OutOfRangeBelongsToItsOwnSwitch) {
    Sequence s;
    s.half_wave_v = 200.0;
    s.track();
    s.open();
    s.pass_gap();
    s.track();
    EXPECT_EQ(s.event.outcome, SwitchOutcome::switched);
    EXPECT_TRUE(s.event.out_of_range);
    s.feed(24, dark);
    ASSERT_EQ(s.state.phase, SwitchPhase::returning);
    s.pass_gap();
    s.track();
    EXPECT_EQ(s.event.outcome, SwitchOutcome::returned);
    EXPECT_FALSE(s.event.out_of_range);
}

TEST(ModeSwitchEdges, AReturnLeadsToTheHelicityBeforeTheLastSwitch) {
    Sequence s;
    s.track();
    s.open();
    s.pass_gap();
    s.track();
    ASSERT_EQ(s.state.polarity, -1);
    s.open();
    EXPECT_EQ(s.state.polarity, 1);
    s.pass_gap();
    s.feed(4, dark);
    ASSERT_EQ(s.state.phase, SwitchPhase::returning);
    EXPECT_EQ(s.state.polarity, -1);
}

TEST(ModeSwitchEdges, WhatIsNoSwitchMeasuresNoHalfWaveVoltage) {
    Sequence s;
    s.track();
    s.feed(24, dark);
    s.pass_gap();
    s.feed(8, unread);
    ASSERT_EQ(s.event.outcome, SwitchOutcome::returned);
    EXPECT_FALSE(s.event.has_half_wave);
    EXPECT_EQ(s.event.half_wave_v, 0.0);
}

TEST(ModeSwitchEdges, TheHalfWaveVoltageIsAMagnitudeHoweverSmall) {
    for (const double step_v : {40.0, 0.5, 0.0, -0.5, -40.0}) {
        Sequence s;
        s.track();
        s.open();
        s.pass_gap();
        s.feed(8, {.piezo_v = 160.0 + step_v});
        ASSERT_EQ(s.event.outcome, SwitchOutcome::switched);
        ASSERT_TRUE(s.event.has_half_wave);
        EXPECT_EQ(s.event.half_wave_v, std::fabs(step_v));
        EXPECT_EQ(s.event.direction, step_v < 0.0 ? -1 : 1);
        EXPECT_FALSE(std::signbit(s.event.half_wave_v));
    }
}

TEST(ModeSwitchEdges, ALockInTheLastHalfOfTheTimeoutIsALock) {
    Sequence s;
    s.track();
    s.open();
    s.pass_gap();
    s.feed(24 - 8, missed);
    s.feed(8, locked);
    EXPECT_EQ(s.state.phase, SwitchPhase::tracking);
    EXPECT_TRUE(s.state.loop_closed);
    EXPECT_EQ(s.event.outcome, SwitchOutcome::switched);
}

TEST(ModeSwitchEdges, TheStartIsThePlaceToReturnTo) {
    Sequence s{ModeSwitchConfig{.gap_ticks = 3,
                                .settle_ticks = 4,
                                .lock_timeout_ticks = 12,
                                .start_set_point = Volts{100.0},
                                .start_polarity = -1}};
    EXPECT_EQ(s.state.polarity, -1);
    EXPECT_EQ(s.state.set_point_v, 100.0);
    s.feed(4, dark);
    ASSERT_EQ(s.state.phase, SwitchPhase::returning);
    EXPECT_EQ(s.state.polarity, -1);
    EXPECT_EQ(s.state.set_point_v, 100.0);
}

// From the start, dark: back to the start, then place after place. Gives the command of the first n places.
std::vector<ModeSwitchState> places(double half_wave_v, int n) {
    Sequence s{ModeSwitchConfig{.range = {.min = Volts{100.0}, .max = Volts{400.0}},
                                .gap_ticks = 3,
                                .settle_ticks = 4,
                                .lock_timeout_ticks = 12,
                                .dark_ticks = 2,
                                .start_polarity = -1}};
    s.half_wave_v = half_wave_v;
    s.feed(4 + 6, dark);
    std::vector<ModeSwitchState> found;
    for (int k = 0; k < n; ++k) {
        s.feed(4, dark);
        EXPECT_EQ(s.state.phase, SwitchPhase::searching);
        found.push_back(s.state);
        s.feed(6, dark);
    }
    return found;
}

TEST(ModeSwitchEdges, ASearchTriesEachPlaceFirstWithTheHelicityThatWasHeldLast) {
    // 2 * 300/40 = 15 places.
    const auto found = places(40.0, 2 * 15 + 1);
    for (unsigned k = 0; k < 30; ++k) {
        EXPECT_DOUBLE_EQ(found[k].set_point_v, 100.0 + 300.0 * (k / 2 + 0.5) / 15.0);
        EXPECT_EQ(found[k].polarity, k % 2 == 0 ? -1 : 1);
    }
    EXPECT_EQ(found[30].set_point_v, found[0].set_point_v);
}

TEST(ModeSwitchEdges, AWideModeHasOnePlaceAndANarrowOneAThousand) {
    // 0.6, 1.5 and 6000 places wanted.
    EXPECT_EQ(places(1000.0, 3)[2].set_point_v, 250.0);
    EXPECT_EQ(places(400.0, 3)[2].set_point_v, 250.0);
    EXPECT_DOUBLE_EQ(places(0.1, 1)[0].set_point_v, 100.0 + 300.0 * 0.5 / 1000.0);
    EXPECT_DOUBLE_EQ(places(1e-9, 3)[2].set_point_v, 100.0 + 300.0 * 1.5 / 1000.0);
}

}  // namespace zlg::core::mode_switch_edges_test
