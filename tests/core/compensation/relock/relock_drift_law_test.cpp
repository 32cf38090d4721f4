// When a tick is corrected, when it cannot be, and what `check` refuses.
#include <zlg/core/compensation/relock_drift.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "compensation/compensation_support.hpp"
#include "relock_drift_support.hpp"

namespace relock_drift_law_test {

using namespace zlg::core;
using namespace compensation_test;
using namespace relock_drift_support;

// A tick with a deficit of `deficit_hz` below 60 kHz, and usable detunings.
RelockTick tick_of(double deficit_hz) {
    const std::int64_t counts = std::llround(0.5 * 0.005 * (60e3 - deficit_hz));
    return {.sign = 1,
            .counts_first = counts,
            .counts_second = -counts,
            .detuning_first_lambda = 0.1,
            .detuning_second_lambda = 0.08,
            .detuning_sq_first_lambda2 = 0.01,
            .detuning_sq_second_lambda2 = 0.0064,
            .temperature_c = not_a_number};
}

RelockTick with_detuning(double first, double second) {
    RelockTick tick = tick_of(0.0);
    tick.detuning_first_lambda = first;
    tick.detuning_second_lambda = second;
    return tick;
}

RelockTick with_mean_square(double first, double second) {
    RelockTick tick = tick_of(0.0);
    tick.detuning_sq_first_lambda2 = first;
    tick.detuning_sq_second_lambda2 = second;
    return tick;
}

void expect_unknown(RelockMethod method, const RelockTick& tick) {
    RelockDriftState state{.armed = true};
    const RelockDriftOutput out = step(configured(method), state, tick);
    EXPECT_TRUE(out.due);
    EXPECT_FALSE(out.tick.known);
    EXPECT_EQ(out.tick.value_arcsec, 0.0);
    EXPECT_TRUE(out.tick.variance_arcsec2 >= 0.0 && std::isfinite(out.tick.variance_arcsec2));
}

// chi f0 K (T/2) of a mean square.
constexpr double arcsec_per_lambda2 = 3.6 * 60e3 * 3.263 * 0.0025;

double missing_arcsec(RelockDriftState& state, const RelockTick& tick) {
    const RelockDriftOutput out = step(configured(RelockMethod::mean_square), state, tick);
    EXPECT_TRUE(out.due && !out.tick.known);
    return std::sqrt(out.tick.variance_arcsec2);
}

// A re-lock of which nothing is seen: what is left in tick n is at most 1/(2n - 1) of what the detuning may be.
TEST(RelockDriftLaw, ATickThatIsNotCorrectedClaimsWhatMayBeMissing) {
    const RelockTick blind = with_mean_square(0.0, 0.0);
    RelockTick dark = blind;
    dark.detuning_first_lambda = dark.detuning_second_lambda = 0.0;
    RelockDriftState state;
    enter_gap(state);
    const double most = arcsec_per_lambda2 * 0.5 * 0.25 * 0.25;
    for (int n = 1; n <= 5; ++n) EXPECT_NEAR(missing_arcsec(state, dark), most / (2 * n - 1), 1e-9);

    // The last detuning that was seen limits what comes after it,
    enter_gap(state);
    (void)step(configured(RelockMethod::mean_square), state, with_mean_square(0.02, 0.01));
    for (int n = 1; n <= 3; ++n)
        EXPECT_NEAR(missing_arcsec(state, dark), arcsec_per_lambda2 * 0.01 / (2 * n - 1), 1e-9);
    // also after a gap in which the loop stayed closed, but not after another one.
    enter_gap(state, false);
    EXPECT_NEAR(missing_arcsec(state, dark), arcsec_per_lambda2 * 0.01 / 7.0, 1e-9);
    enter_gap(state, true);
    EXPECT_NEAR(missing_arcsec(state, dark), most, 1e-9);
}

// For every exponential loop and every miss that can be caught, what is missing is within two such sigmas.
TEST(RelockDriftLaw, WhatIsMissingIsWithinWhatIsClaimed) {
    for (const double q : {0.1, 0.5, 0.8, 0.9, 0.99}) {
        for (const double miss : {0.05, 0.22}) {
            RelockTick dark = with_mean_square(0.0, 0.0);
            dark.detuning_first_lambda = dark.detuning_second_lambda = 0.0;
            RelockDriftState state;
            enter_gap(state);
            for (int n = 1; n <= 20; ++n) {
                const double first = miss * miss * std::pow(q, 4 * (n - 1));
                const double left = arcsec_per_lambda2 * first * (1.0 - q * q);
                EXPECT_LT(left, 2.0 * missing_arcsec(state, dark)) << q << ", tick " << n;
            }
        }
    }
}

// The second half of a tick shows what is left after it, not what the tick holds.
TEST(RelockDriftLaw, ATickOfWhichOnlyTheFirstHalfIsBlindClaimsWhatIsMissing) {
    for (const double q : {0.02, 0.1, 0.5, 0.9}) {
        for (const RelockMethod method : {RelockMethod::mean_square, RelockMethod::detuning}) {
            for (int n_blind = 1; n_blind <= 3; ++n_blind) {
                RelockDriftState state;
                enter_gap(state);
                for (int n = 1; n <= 3; ++n) {
                    const double first = 0.22 * 0.22 * std::pow(q, 4 * (n - 1));
                    const double second = first * q * q;
                    RelockTick tick = with_mean_square(first, second);
                    tick.detuning_first_lambda = std::sqrt(first);
                    tick.detuning_second_lambda = std::sqrt(second);
                    if (n == n_blind) tick.detuning_sq_first_lambda2 = tick.detuning_first_lambda = 0.0;
                    if (n == n_blind) tick.detuning_sq_second_lambda2 = 0.0;
                    const RelockDriftOutput out = step(configured(method), state, tick);
                    if (n != n_blind) continue;
                    EXPECT_FALSE(out.tick.known);
                    const double left = arcsec_per_lambda2 * (first - second);
                    EXPECT_LT(left, 2.0 * std::sqrt(out.tick.variance_arcsec2)) << q << ", tick " << n;
                }
            }
        }
    }
}

TEST(RelockDriftLaw, FrequencyClaimsTheDeficitThatItCannotRead) {
    RelockDriftState state;
    enter_gap(state);
    RelockTick tick = tick_of(900.0);
    (void)step(configured(RelockMethod::frequency), state, tick);
    tick = tick_of(1800.0);
    const RelockDriftOutput out = step(configured(RelockMethod::frequency), state, tick);
    EXPECT_FALSE(out.tick.known || out.first.known);
    const double arcsec_per_hz = 3.263 * 0.005;
    EXPECT_NEAR(std::sqrt(out.first.variance_arcsec2), arcsec_per_hz * 900.0, 3.3);
    // The second half of tick 1 was seen: no more than that can fall in tick 2.
    EXPECT_NEAR(std::sqrt(out.tick.variance_arcsec2), arcsec_per_lambda2 * 0.0064, 1e-9);
    // At rest a deficit is rounding.
    enter_gap(state);
    (void)step(configured(RelockMethod::frequency), state, tick_of(0.0));
    const RelockDriftOutput rest = step(configured(RelockMethod::frequency), state, tick_of(0.0));
    EXPECT_EQ(rest.tick.variance_arcsec2, 0.0);
    EXPECT_EQ(rest.first.variance_arcsec2, 0.0);
}

// The rounding of counts has a standard deviation of one count in the difference of two halves: 200 Hz.
TEST(RelockDriftLaw, FrequencyClaimsNoDeficitWithinItsRounding) {
    for (const double counts : {0.95, 0.99999, 1.00001, 1.2}) {
        RelockDriftState state;
        enter_gap(state);
        RelockTick tick = tick_of(0.0);
        tick.known_excess_counts = counts;
        (void)step(configured(RelockMethod::frequency), state, tick);
        tick.known_excess_counts = 3.0 * counts;
        const RelockDriftOutput out = step(configured(RelockMethod::frequency), state, tick);
        EXPECT_FALSE(out.first.known);
        const double expected = counts < 1.0 ? 0.0 : 3.263 * 0.005 * 200.0 * counts;
        EXPECT_NEAR(std::sqrt(out.first.variance_arcsec2), expected, 1e-9) << counts;
    }
}

// A deficit of 1.25 Hz without the variance of its rounding, 1 Hz^2, is the square of 0.75 Hz; so much can be missing at most.
TEST(RelockDriftLaw, FrequencyClaimsNoMoreThanCanBeMissing) {
    Configured config = configured(RelockMethod::frequency);
    config.gyro.tick = Seconds{1.0};
    config.gyro.scale = Arcsec{1.0};
    config.gyro.chi = 2.0;
    config.gyro.bias = Hertz{24.0};
    RelockDriftState state;
    enter_gap(state);
    RelockTick tick{.sign = 1, .counts_first = 12, .counts_second = -12, .temperature_c = not_a_number};
    tick.known_excess_counts = 1.25;
    (void)step(config, state, tick);
    tick.known_excess_counts = 2.5;
    EXPECT_EQ(step(config, state, tick).first.variance_arcsec2, 0.75 * 0.75);
}

// A mean alone: half of the mean square of a half in which the detuning falls to a thirtieth.
TEST(RelockDriftLaw, AMeanAloneShowsWhatMayBeMissing) {
    for (const double centre : {0.0, 0.03}) {
        Configured config = configured(RelockMethod::mean_square);
        config.gyro.centre = Wavelengths{centre};
        RelockDriftState state;
        enter_gap(state);
        RelockTick tick = with_mean_square(0.0, 0.0);
        tick.detuning_second_lambda = 0.05;
        (void)step(config, state, tick);
        tick.detuning_second_lambda = 0.0;
        const double left = 2.0 * (0.05 - centre) * (0.05 - centre);
        EXPECT_NEAR(std::sqrt(step(config, state, tick).tick.variance_arcsec2), arcsec_per_lambda2 * left, 1e-9);
    }
}

TEST(RelockDriftLaw, AfterADetuningOfZeroNothingIsMissing) {
    RelockDriftState state;
    enter_gap(state);
    RelockTick nearly = with_mean_square(0.0, 0.0);
    nearly.detuning_first_lambda = 0.0;
    nearly.detuning_second_lambda = 1e-200;  // seen, and its square is 0
    EXPECT_GT(missing_arcsec(state, nearly), 0.0);
    nearly.detuning_second_lambda = 0.0;
    EXPECT_EQ(missing_arcsec(state, nearly), 0.0);
}

TEST(RelockDriftLaw, NothingIsCorrectedBeforeTheFirstGap) {
    for (const auto method : {RelockMethod::frequency, RelockMethod::detuning, RelockMethod::mean_square}) {
        RelockDriftState state;
        for (int k = 0; k < 30; ++k) {
            const RelockDriftOutput out = step(configured(method), state, tick_of(1000.0));
            EXPECT_FALSE(out.due || out.waiting || out.first_due || out.tick.known || out.first.known);
        }
    }
}

TEST(RelockDriftLaw, ExactlyTheTicksAskedForAreDue) {
    for (const auto method : {RelockMethod::frequency, RelockMethod::detuning, RelockMethod::mean_square})
        for (const std::int64_t ticks : {0, 1, 2, 3, 20}) {
            RelockDriftState state;
            for (int gap = 0; gap < 3; ++gap) {  // every gap starts anew, whatever was left of the last
                for (int k = 0; k < 3; ++k) enter_gap(state);
                for (int i = 1; i <= (gap == 1 ? 2 : 25); ++i)
                    EXPECT_EQ(step(configured(method, ticks), state, tick_of(4000.0 / i)).due, i <= ticks)
                        << ticks << ' ' << i;
            }
        }
}

TEST(RelockDriftLaw, MethodNoneCorrectsNothing) {
    RelockDriftState state;
    enter_gap(state);
    for (int k = 0; k < 3; ++k) {
        const RelockDriftOutput out = step(configured(RelockMethod::none), state, tick_of(1000.0));
        EXPECT_FALSE(out.due || out.waiting || out.first_due || out.tick.known || out.first.known);
    }
}

TEST(RelockDriftLaw, TickOneOfFrequencyIsKnownOneTickLater) {
    for (const std::int64_t ticks : {1, 2, 20}) {
        RelockDriftState state{.armed = true};
        const RelockDriftOutput first = step(configured(RelockMethod::frequency, ticks), state, tick_of(4000.0));
        EXPECT_TRUE(first.due && first.waiting && !first.tick.known && !first.first_due);
        const RelockDriftOutput second = step(configured(RelockMethod::frequency, ticks), state, tick_of(1600.0));
        EXPECT_TRUE(second.first_due && second.first.known && !second.waiting);
        EXPECT_EQ(second.due, ticks >= 2);
        EXPECT_EQ(second.tick.known, ticks >= 2);
        // q = sqrt(1600/4000); false rate = deficit (1 - q)/(1 + q) below zero.
        const double q = std::sqrt(0.4);
        EXPECT_NEAR(second.first.value_arcsec, -3.263 * 0.005 * 4000.0 * (1.0 - q) / (1.0 + q), 1e-11);
        const RelockDriftOutput third = step(configured(RelockMethod::frequency, ticks), state, tick_of(640.0));
        EXPECT_FALSE(third.first_due || third.waiting);
    }
}

TEST(RelockDriftLaw, TheRootOfTickIIsOfDegreeTwiceIMinusOne) {
    RelockDriftState state{.armed = true};
    double deficit_hz = 12800.0;  // always a whole number of counts
    for (int i = 1; i <= 4; ++i, deficit_hz *= 0.5) {
        const RelockDriftOutput out = step(configured(RelockMethod::frequency), state, tick_of(deficit_hz));
        if (i == 1) continue;
        const double q = std::pow(0.5, (i - 1.0) / (2.0 * (i - 1.0)));
        EXPECT_NEAR(out.tick.value_arcsec, -3.263 * 0.005 * deficit_hz * (1.0 - q) / (1.0 + q), 1e-11) << i;
    }
}

TEST(RelockDriftLaw, FrequencyNeedsADeficitThatShrinksAndKeepsItsSign) {
    for (const auto& [first_hz, second_hz] :
         {std::pair{0.0, 0.0}, {4000.0, 4000.0}, {4000.0, 4400.0}, {4000.0, 0.0}, {4000.0, -400.0}, {0.0, 400.0}}) {
        RelockDriftState state{.armed = true};
        (void)step(configured(RelockMethod::frequency), state, tick_of(first_hz));
        const RelockDriftOutput out = step(configured(RelockMethod::frequency), state, tick_of(second_hz));
        EXPECT_TRUE(out.due && out.first_due);
        EXPECT_FALSE(out.tick.known || out.first.known) << first_hz << ' ' << second_hz;
        EXPECT_EQ(out.first.value_arcsec, 0.0);
    }
}

TEST(RelockDriftLaw, DetuningNeedsARatioBetweenZeroAndOne) {
    const double nan = not_a_number;
    for (const auto& [first, second] : {std::pair{0.0, 0.0},
                                        {0.0, 0.1},
                                        {0.1, 0.0},
                                        {0.1, 0.1},
                                        {0.1, 0.11},
                                        {0.1, -0.08},
                                        {-0.1, 0.08},
                                        {nan, 0.08},
                                        {0.1, nan},
                                        {nan, nan},
                                        {infinite, 0.1},
                                        {0.1, infinite},
                                        {infinite, infinite},
                                        {1e308, 1e307}})
        expect_unknown(RelockMethod::detuning, with_detuning(first, second));
}

TEST(RelockDriftLaw, MeanSquareNeedsTwoSquares) {
    const double nan = not_a_number;
    for (const auto& [first, second] : {std::pair{0.0, 0.0},
                                        {-0.01, 0.02},
                                        {0.02, -0.01},
                                        {nan, 0.01},
                                        {0.01, nan},
                                        {nan, nan},
                                        {infinite, 0.1},
                                        {0.1, infinite},
                                        {infinite, infinite},
                                        {1e308, 0.0}})
        expect_unknown(RelockMethod::mean_square, with_mean_square(first, second));
}

TEST(RelockDriftLaw, NoNumberInTheOutputIsEverNotANumber) {
    Random random{1};
    for (int trial = 0; trial < 200'000; ++trial) {
        const auto method = static_cast<RelockMethod>(random.index(1, 3));
        const auto wild = [&] { return std::bit_cast<double>(random.bits()); };
        RelockDriftState state{.armed = true};
        for (int i = 1; i <= 3; ++i) {
            const RelockTick tick{.sign = random.chance(0.5) ? 1 : -1,
                                  .counts_first = random.integer(-(1LL << 52), 1LL << 52),
                                  .counts_second = random.integer(-(1LL << 52), 1LL << 52),
                                  .detuning_first_lambda = wild(),
                                  .detuning_second_lambda = wild(),
                                  .detuning_sq_first_lambda2 = wild(),
                                  .detuning_sq_second_lambda2 = wild(),
                                  .temperature_c = wild()};
            const RelockDriftOutput out = step(configured(method), state, tick);
            for (const FalseAngle& angle : {out.tick, out.first}) {
                ASSERT_TRUE(std::isfinite(angle.value_arcsec) && std::isfinite(angle.variance_arcsec2));
                ASSERT_GE(angle.variance_arcsec2, 0.0);
                ASSERT_TRUE(angle.known || angle.value_arcsec == 0.0);
            }
        }
    }
}

TEST(RelockDriftLaw, CheckRefusesANegativeNumberOfTicks) {
    EXPECT_EQ(check(RelockDriftConfig{}), RelockDriftFault::none);
    EXPECT_EQ(check(RelockDriftConfig{.ticks = 0}), RelockDriftFault::none);
    EXPECT_EQ(check(RelockDriftConfig{.ticks = -1}), RelockDriftFault::ticks);
}

}  // namespace relock_drift_law_test
