#include <zlg/core/control/switch_schedule.hpp>

#include "support.hpp"

namespace zlg::core::switch_schedule_test {

using Limits = std::numeric_limits<std::int64_t>;

static_assert(is_allowed(SwitchScheduleConfig{}));
static_assert(!is_allowed(SwitchScheduleConfig{.interval_ticks = 0}));
static_assert(!is_allowed(SwitchScheduleConfig{.interval_ticks = -5}));
static_assert(!is_allowed(SwitchScheduleConfig{.interval_ticks = std::numeric_limits<std::int64_t>::max()}));

static_assert(!is_allowed(SwitchScheduleConfig{.min_ticks = 0}));
static_assert(!is_allowed(SwitchScheduleConfig{.min_ticks = 20, .max_ticks = 19}));
static_assert(!is_allowed(SwitchScheduleConfig{.max_ticks = Limits::max()}));
static_assert(!is_allowed(SwitchScheduleConfig{.tick_s = 0.0}));
static_assert(!is_allowed(SwitchScheduleConfig{.presumed = {.switch_error_arcsec = 0.0}}));
static_assert(!is_allowed(SwitchScheduleConfig{.presumed = {1.0, not_a_number}}));
static_assert(!is_allowed(SwitchScheduleConfig{.end_tick = -1}));

using Ticks = std::vector<std::int64_t>;

// Ticks from `from` on at which the loop opens, when the gyro is ready at all of them but those of [busy_from,
// busy_to).
Ticks openings(const SwitchScheduleConfig& c, SwitchScheduleState& s, std::int64_t from, std::int64_t to,
               std::int64_t busy_from = 0, std::int64_t busy_to = 0) {
    Ticks result;
    for (std::int64_t tick = from; tick < to; ++tick) {
        if (step(c, s, {.tick = tick, .ready = !(tick >= busy_from && tick < busy_to)})) result.push_back(tick);
    }
    return result;
}
Ticks openings(const SwitchScheduleConfig& c, std::int64_t n_ticks, std::int64_t busy_from = 0,
               std::int64_t busy_to = 0) {
    SwitchScheduleState s = initial_state(c);
    return openings(c, s, 1, n_ticks, busy_from, busy_to);
}

TEST(SwitchSchedule, OpensOnTheGridFromAFullOrAHalfFirstSegmentRoundedDown) {
    EXPECT_EQ(openings({.interval_ticks = 7}, 30), (Ticks{7, 14, 21, 28}));
    EXPECT_EQ(openings({.interval_ticks = 7, .first_segment = FirstSegment::half}, 25), (Ticks{3, 10, 17, 24}));
}

TEST(SwitchSchedule, AnOpeningThatHadToWaitDoesNotMoveTheGridAndSeveralThatWaitAreOne) {
    EXPECT_EQ(openings({.interval_ticks = 10}, 41, 18, 23), (Ticks{10, 23, 30, 40}));
    EXPECT_EQ(openings({.interval_ticks = 10}, 51, 18, 43), (Ticks{10, 43, 50}));
}

TEST(SwitchSchedule, AnyTickNumberIsSurvived) {
    for (const std::int64_t interval : {std::int64_t{1}, std::int64_t{1} << 53}) {
        const SwitchScheduleConfig c{.interval_ticks = interval};
        SwitchScheduleState s = initial_state(c);
        EXPECT_FALSE(step(c, s, {.tick = Limits::min(), .ready = true}));
        EXPECT_FALSE(step(c, s, {.tick = Limits::max(), .ready = true}));
        EXPECT_TRUE(step(c, s, {.tick = (std::int64_t{1} << 62) - 1, .ready = true}));
        EXPECT_FALSE(step(c, s, {.tick = 0, .ready = true}));
    }
}

// A gyro whose mode changes at every opening; the time in mode + over that in mode -, in ticks, after each tick.
struct Course {
    Ticks openings;
    Ticks intervals;  // the first one, and after each opening
    Ticks imbalance;
};

template <class Advice>
Course course(const SwitchScheduleConfig& c, std::int64_t n_ticks, const Advice& advice, std::int8_t mode = 1) {
    SwitchScheduleState s = initial_state(c);
    Course result{.intervals = {s.interval_ticks}};
    std::int64_t sum = 0;
    for (std::int64_t tick = 0; tick < n_ticks; ++tick) {
        if (tick > 0 && step(c, s, {.tick = tick, .mode = mode, .advice = advice(tick)})) {
            result.openings.push_back(tick);
            result.intervals.push_back(s.interval_ticks);
            mode = static_cast<std::int8_t>(-mode);
        }
        sum += mode;
        result.imbalance.push_back(sum);
    }
    return result;
}

Course course(const SwitchScheduleConfig& c, std::int64_t n_ticks, std::int8_t mode = 1) {
    return course(
        c, n_ticks, [](std::int64_t) { return SwitchAdvice{}; }, mode);
}

auto jumping_advice(std::int64_t period_ticks, double low_arcsec, double high_arcsec) {
    return [=](std::int64_t tick) {
        return SwitchAdvice{.switch_error_arcsec = tick / period_ticks % 2 == 0 ? low_arcsec : high_arcsec,
                            .magnetic_arcsec_s = 0.5};
    };
}

SwitchScheduleConfig growing(FirstSegment first = FirstSegment::half) {
    return {.first_segment = first,
            .kind = ScheduleKind::measured,
            .min_ticks = 100,
            .max_ticks = 100000,
            .tick_s = 0.1,
            .presumed = {.switch_error_arcsec = 3.0, .magnetic_arcsec_s = 0.5}};
}

TEST(SwitchSchedule, TheBalancedIntervalIsWhereTheVarianceIsLeast) {
    const SwitchScheduleConfig c = growing();
    for (const std::int64_t tick : {20000, 300000}) {
        const double t = 0.1 * static_cast<double>(tick);
        const auto variance = [&](double l) { return 9.0 * t / l + 0.25 * l * l / 12.0; };
        const double best = 0.1 * static_cast<double>(balanced_interval(c, {}, tick));
        EXPECT_LT(variance(best), variance(1.01 * best));
        EXPECT_LT(variance(best), variance(0.99 * best));
    }
}

TEST(SwitchSchedule, TheBalancedIntervalKeepsItsLimitsAndTakesOnlyAdviceThatIsOne) {
    const SwitchScheduleConfig c = growing();
    EXPECT_EQ(balanced_interval(c, {1e-6, 1e6}, 1000), 100);
    EXPECT_EQ(balanced_interval(c, {1e6, 1e-6}, 1000), 100000);
    EXPECT_EQ(balanced_interval(c, {0.0, -1.0}, 50000), balanced_interval(c, {}, 50000));
    EXPECT_EQ(balanced_interval(c, {not_a_number, not_a_number}, 50000), balanced_interval(c, {}, 50000));
    EXPECT_EQ(balanced_interval(c, {}, Limits::min()), 100);
    // Eight times the time, twice the interval; eight times the error, four times.
    EXPECT_NEAR(static_cast<double>(balanced_interval(c, {3.0, 0.5}, 400000)),
                2.0 * static_cast<double>(balanced_interval(c, {3.0, 0.5}, 50000)), 2.0);
    EXPECT_NEAR(static_cast<double>(balanced_interval(c, {24.0, 0.5}, 50000)),
                4.0 * static_cast<double>(balanced_interval(c, {3.0, 0.5}, 50000)), 4.0);
}

TEST(SwitchSchedule, AGrowingIntervalKeepsTheSawtoothCentred) {
    for (const std::int8_t mode : {std::int8_t{1}, std::int8_t{-1}}) {
        const SwitchScheduleConfig c = growing();
        const Course got = course(c, 200000, mode);
        ASSERT_GT(got.openings.size(), 20u);
        EXPECT_EQ(got.openings[0], balanced_interval(c, {}, 1) / 2);
        for (std::size_t k = 1; k < got.openings.size(); ++k) {
            const std::int64_t interval = balanced_interval(c, {}, got.openings[k - 1]);
            const auto peak = static_cast<double>(got.imbalance[static_cast<std::size_t>(got.openings[k] - 1)]);
            EXPECT_LE(std::abs(peak), static_cast<double>(interval / 2) + 1.0) << k;
            EXPECT_GE(std::abs(peak), static_cast<double>(interval) * 15.0 / 32.0 - 1.0) << k;
        }
    }
}

// Of either mode, and of intervals so long that a sixteenth of them has more than sixteen bits.
TEST(SwitchSchedule, AnOpeningShortensTheIntervalByASixteenthAtMostAndForgetsALeadBeyondTheLongest) {
    for (const std::int64_t interval : {std::int64_t{3000}, std::int64_t{1} << 25}) {
        for (const std::int8_t mode : {std::int8_t{1}, std::int8_t{-1}}) {
            SwitchScheduleConfig c = growing();
            c.min_ticks = c.max_ticks = interval;
            SwitchScheduleState s = initial_state(c);
            s.imbalance_ticks = mode * 5 * interval;
            ASSERT_TRUE(step(c, s, {.tick = 7 * interval, .ready = true, .mode = mode}));
            EXPECT_LE(s.interval_ticks, interval);
            EXPECT_GE(s.interval_ticks, interval - interval / 16);
            EXPECT_EQ(s.imbalance_ticks, mode * interval);
        }
    }
}

TEST(SwitchSchedule, NoVibrationKeepsStepWithIntervalsThatAreNotFixed) {
    SwitchScheduleConfig c = growing();
    c.min_ticks = c.max_ticks = 1600;
    const Course got = course(c, 400000);
    for (const double period_ticks : {10.0, 20.0, 50.0, 100.0}) {
        double re = 0.0, im = 0.0;
        for (const std::int64_t tick : got.openings) {
            re += std::cos(2.0 * std::numbers::pi * static_cast<double>(tick) / period_ticks);
            im += std::sin(2.0 * std::numbers::pi * static_cast<double>(tick) / period_ticks);
        }
        // Of random phases the root of their number is left.
        const auto n = static_cast<double>(got.openings.size());
        EXPECT_LT(std::hypot(re, im), 3.0 * std::sqrt(n)) << period_ticks;
    }
}

TEST(SwitchSchedule, AFullFirstSegmentPutsTheCentreAtHalfOfIt) {
    for (const std::int8_t mode : {std::int8_t{1}, std::int8_t{-1}}) {
        const Course got = course(growing(FirstSegment::full), 200000, mode);
        EXPECT_EQ(got.openings[0], 100);
        const auto last = static_cast<std::size_t>(got.openings.back() - 1);
        const auto before = static_cast<std::size_t>(got.openings[got.openings.size() - 2] - 1);
        EXPECT_NEAR(static_cast<double>(got.imbalance[last] + got.imbalance[before]) / 2.0, 50.0 * mode, 30.0);
    }
}

TEST(SwitchSchedule, AdviceIsTakenWhereTheIntervalIsMeasured) {
    const SwitchScheduleConfig c = growing();
    // A tenth of the error: 10^(2/3) = 4.6 times as many switches.
    const auto more = static_cast<double>(course(c, 400000, jumping_advice(1, 0.3, 0.3)).openings.size());
    const auto fewer = static_cast<double>(course(c, 400000).openings.size());
    EXPECT_NEAR(more / fewer, 4.64, 0.4);
}

TEST(SwitchSchedule, AdviceThatJumpsDoesNotCarryTheSawtoothAway) {
    const SwitchScheduleConfig c = growing();
    // Alternating segments of the same lengths would add their differences up.
    const std::int64_t longest = balanced_interval(c, {8.0, 0.5}, 400000);
    std::int64_t farthest = 0;
    for (const std::int64_t x : course(c, 400000, jumping_advice(7919, 0.5, 8.0)).imbalance)
        farthest = std::max(farthest, std::abs(x));
    EXPECT_LE(farthest, longest / 2 + 1);
}

TEST(SwitchSchedule, AFailureIsNotPaidBackByMoreThanTheLongestInterval) {
    SwitchScheduleConfig c = growing();
    c.max_ticks = 3000;
    SwitchScheduleState s = initial_state(c);
    std::int64_t tick = 1;
    // A gyro that cannot leave its mode tries again and again, but not faster than allowed.
    std::int64_t openings = 0;
    for (; tick < 30000; ++tick) openings += step(c, s, {.tick = tick, .mode = 1});
    EXPECT_LE(openings, 30000 / 94);
    EXPECT_GE(openings, 200);
    std::int64_t waited = 0;
    for (; !step(c, s, {.tick = tick, .mode = -1}); ++tick) ++waited;
    EXPECT_LE(waited, c.max_ticks + balanced_interval(c, {}, tick));
}

TEST(SwitchSchedule, TheEndIsBalancedWhereItIsKnown) {
    for (const FirstSegment first : {FirstSegment::full, FirstSegment::half})
        for (const ScheduleKind kind : {ScheduleKind::fixed, ScheduleKind::measured})
            for (const std::int64_t end : {37, 150, 999, 1000, 1001, 1049, 1050, 1951, 20000})
                for (const std::int8_t mode : {std::int8_t{1}, std::int8_t{-1}}) {
                    SwitchScheduleConfig c = growing(first);
                    c.kind = kind;
                    c.interval_ticks = 100;
                    const std::size_t without = course(c, end, mode).openings.size();
                    c.end_tick = end;
                    const Course got = course(c, end, mode);
                    EXPECT_LE(std::abs(got.imbalance.back()), 1) << end;
                    EXPECT_LE(got.openings.size(), without + 1) << end;
                }
}

// Whatever is advised.
TEST(SwitchSchedule, FromSwitchToSwitchTheIntervalChangesByAFactorOfTwoAtMost) {
    const SwitchScheduleConfig c = growing();
    const Ticks intervals = course(c, 400000, jumping_advice(20011, 0.01, 500.0)).intervals;
    for (std::size_t k = 1; k < intervals.size(); ++k) {
        EXPECT_LE(intervals[k], 2 * intervals[k - 1]) << k;
        EXPECT_GE(2 * intervals[k], intervals[k - 1]) << k;
    }
    const auto [shortest, longest] = std::minmax_element(intervals.begin(), intervals.end());
    // It gets everywhere all the same.
    EXPECT_LT(*shortest, c.min_ticks);
    EXPECT_GT(*longest, 20 * c.min_ticks);
}

// What is set from outside.
TEST(SwitchSchedule, HeldNothingIsDueAndTheGridGoesOn) {
    const SwitchScheduleConfig c{.interval_ticks = 10};
    SwitchScheduleState s = initial_state(c);
    s.held = true;
    EXPECT_EQ(openings(c, s, 1, 25, 1, 13), Ticks{});
    s.held = false;
    EXPECT_EQ(openings(c, s, 25, 31), Ticks{30});
}

TEST(SwitchSchedule, HeldByBalanceItIsDueWhenReleased) {
    const SwitchScheduleConfig c{.kind = ScheduleKind::measured, .min_ticks = 10, .max_ticks = 20};
    SwitchScheduleState s = initial_state(c);
    s.held = true;
    EXPECT_EQ(openings(c, s, 1, 100), Ticks{});
    s.held = false;
    EXPECT_EQ(openings(c, s, 100, 101), Ticks{100});
}

TEST(SwitchSchedule, AskedItOpensOnceWhenReadyHeldOrNotAndDoesNotMoveTheGrid) {
    for (const bool held : {false, true}) {
        const SwitchScheduleConfig c{.interval_ticks = 10};
        SwitchScheduleState s = initial_state(c);
        s.held = held;
        s.asked = true;
        EXPECT_EQ(openings(c, s, 1, 4, 1, 2), Ticks{2});
        EXPECT_FALSE(s.asked);
        EXPECT_EQ(s.opened_tick, 2);
        EXPECT_EQ(openings(c, s, 4, 11), held ? Ticks{} : Ticks{10});
    }
}

}  // namespace zlg::core::switch_schedule_test
