// When a tick is corrected, when it cannot be, and what `check` refuses.
#include <zlg/core/relock_drift.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <utility>

#include "compensation_support.hpp"

namespace {

using namespace zlg::core;
using namespace compensation_test;

RelockDriftConfig config_of(RelockMethod method, std::int64_t ticks = 20) {
    RelockDriftConfig config;
    config.method = method;
    config.ticks = ticks;
    return config;
}

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
    const RelockDriftOutput out = step(config_of(method), state, tick);
    EXPECT_TRUE(out.due);
    EXPECT_FALSE(out.tick.known);
    EXPECT_EQ(out.tick.value_arcsec, 0.0);
    EXPECT_EQ(out.tick.variance_arcsec2, 0.0);
}

TEST(RelockDriftLaw, NothingIsCorrectedBeforeTheFirstGap) {
    for (const auto method : {RelockMethod::frequency, RelockMethod::detuning, RelockMethod::mean_square}) {
        RelockDriftState state;
        for (int k = 0; k < 30; ++k) {
            const RelockDriftOutput out = step(config_of(method), state, tick_of(1000.0));
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
                    EXPECT_EQ(step(config_of(method, ticks), state, tick_of(4000.0 / i)).due, i <= ticks)
                        << ticks << ' ' << i;
            }
        }
}

TEST(RelockDriftLaw, MethodNoneCorrectsNothing) {
    RelockDriftState state;
    enter_gap(state);
    for (int k = 0; k < 3; ++k) {
        const RelockDriftOutput out = step(config_of(RelockMethod::none), state, tick_of(1000.0));
        EXPECT_FALSE(out.due || out.waiting || out.first_due || out.tick.known || out.first.known);
    }
}

TEST(RelockDriftLaw, TickOneOfFrequencyIsKnownOneTickLater) {
    for (const std::int64_t ticks : {1, 2, 20}) {
        RelockDriftState state{.armed = true};
        const RelockDriftOutput first = step(config_of(RelockMethod::frequency, ticks), state, tick_of(4000.0));
        EXPECT_TRUE(first.due && first.waiting && !first.tick.known && !first.first_due);
        const RelockDriftOutput second = step(config_of(RelockMethod::frequency, ticks), state, tick_of(1600.0));
        EXPECT_TRUE(second.first_due && second.first.known && !second.waiting);
        EXPECT_EQ(second.due, ticks >= 2);
        EXPECT_EQ(second.tick.known, ticks >= 2);
        // q = sqrt(1600/4000); false rate = deficit (1 - q)/(1 + q) below zero.
        const double q = std::sqrt(0.4);
        EXPECT_NEAR(second.first.value_arcsec, -3.263 * 0.005 * 4000.0 * (1.0 - q) / (1.0 + q), 1e-11);
        const RelockDriftOutput third = step(config_of(RelockMethod::frequency, ticks), state, tick_of(640.0));
        EXPECT_FALSE(third.first_due || third.waiting);
    }
}

TEST(RelockDriftLaw, TheRootOfTickIIsOfDegreeTwiceIMinusOne) {
    RelockDriftState state{.armed = true};
    double deficit_hz = 12800.0;  // always a whole number of counts
    for (int i = 1; i <= 4; ++i, deficit_hz *= 0.5) {
        const RelockDriftOutput out = step(config_of(RelockMethod::frequency), state, tick_of(deficit_hz));
        if (i == 1) continue;
        const double q = std::pow(0.5, (i - 1.0) / (2.0 * (i - 1.0)));
        EXPECT_NEAR(out.tick.value_arcsec, -3.263 * 0.005 * deficit_hz * (1.0 - q) / (1.0 + q), 1e-11) << i;
    }
}

TEST(RelockDriftLaw, FrequencyNeedsADeficitThatShrinksAndKeepsItsSign) {
    for (const auto& [first_hz, second_hz] :
         {std::pair{0.0, 0.0}, {4000.0, 4000.0}, {4000.0, 4400.0}, {4000.0, 0.0}, {4000.0, -400.0}, {0.0, 400.0}}) {
        RelockDriftState state{.armed = true};
        (void)step(config_of(RelockMethod::frequency), state, tick_of(first_hz));
        const RelockDriftOutput out = step(config_of(RelockMethod::frequency), state, tick_of(second_hz));
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
            const RelockDriftOutput out = step(config_of(method), state, tick);
            for (const FalseAngle& angle : {out.tick, out.first}) {
                ASSERT_TRUE(std::isfinite(angle.value_arcsec) && std::isfinite(angle.variance_arcsec2));
                ASSERT_GE(angle.variance_arcsec2, 0.0);
                ASSERT_TRUE(angle.known || (angle.value_arcsec == 0.0 && angle.variance_arcsec2 == 0.0));
            }
        }
    }
}

TEST(RelockDriftLaw, CheckAcceptsTheDefaultsAndTheEdges) {
    EXPECT_EQ(check(RelockDriftConfig{}), RelockDriftFault::none);
    RelockDriftConfig edge;
    edge.ticks = 0;
    edge.chi = 0.0;
    edge.light_noise = Wavelengths{0.0};
    edge.light_samples = 1;
    edge.bias = Hertz{1e12};
    edge.temperature_coefficient_per_c = -1.0;
    EXPECT_EQ(check(edge), RelockDriftFault::none);
}

TEST(RelockDriftLaw, CheckNamesTheFirstBadField) {
    const auto expect_fault = [](RelockDriftFault fault, const std::function<void(RelockDriftConfig&, double)>& set,
                                 std::initializer_list<double> bad) {
        for (const double value : bad) {
            RelockDriftConfig config;
            set(config, value);
            EXPECT_EQ(check(config), fault) << static_cast<int>(fault) << ' ' << value;
        }
    };
    const double nan = not_a_number;
    const double inf = infinite;
    using Fault = RelockDriftFault;
    using Config = RelockDriftConfig;
    expect_fault(Fault::tick, [](Config& c, double x) { c.tick = Seconds{x}; }, {0.0, -0.005, nan, inf});
    expect_fault(Fault::scale, [](Config& c, double x) { c.scale = Arcsec{x}; }, {0.0, -3.0, nan, inf});
    expect_fault(Fault::bias, [](Config& c, double x) { c.bias = Hertz{x}; }, {0.0, -60e3, nan, inf});
    expect_fault(Fault::chi, [](Config& c, double x) { c.chi = x; }, {-0.1, nan, inf});
    expect_fault(Fault::temperature, [](Config& c, double x) { c.temperature_coefficient_per_c = x; },
                 {nan, inf, -inf});
    expect_fault(Fault::temperature, [](Config& c, double x) { c.reference_temperature = Celsius{x}; },
                 {nan, inf, -inf});
    expect_fault(Fault::light_noise, [](Config& c, double x) { c.light_noise = Wavelengths{x}; }, {-0.1, nan, inf});
    expect_fault(Fault::light_samples, [](Config& c, double x) { c.light_samples = static_cast<int>(x); }, {0.0, -1.0});
    expect_fault(Fault::ticks, [](Config& c, double x) { c.ticks = static_cast<std::int64_t>(x); }, {-1.0, -1e15});
}

}  // namespace
