// The borders of what can be corrected, each from both sides, numbers beyond belief, and the variance of `frequency` from
// first principles.
#include <zlg/core/compensation/relock_drift.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "compensation/compensation_support.hpp"
#include "relock_drift_support.hpp"

namespace relock_drift_edges_test {

using namespace zlg::core;
using namespace compensation_test;
using namespace relock_drift_support;

FalseAngle angle_of(RelockMethod method, const RelockTick& tick, Configured config = {}) {
    config.relock.method = method;
    RelockDriftState state{.armed = true};
    return step(config, state, tick).tick;
}

FalseAngle by_mean_square(double first, double second) {
    return angle_of(RelockMethod::mean_square,
                    {.detuning_sq_first_lambda2 = first, .detuning_sq_second_lambda2 = second});
}

FalseAngle by_detuning(double first, double second) {
    return angle_of(RelockMethod::detuning, {.detuning_first_lambda = first, .detuning_second_lambda = second});
}

// K T chi f0/2 per square of a wavelength.
constexpr double arcsec_per_lambda2 = 3.263 * 0.005 * 0.5 * 3.6 * 60e3;

TEST(RelockDriftEdges, OneOfTheTwoMeanSquaresMayBeZero) {
    EXPECT_TRUE(by_mean_square(0.0, 0.01).known);
    EXPECT_NEAR(by_mean_square(0.0, 0.01).value_arcsec, 0.01 * arcsec_per_lambda2, 1e-10);
    EXPECT_TRUE(by_mean_square(0.01, 0.0).known);
    EXPECT_NEAR(by_mean_square(0.01, 0.0).value_arcsec, -0.01 * arcsec_per_lambda2, 1e-10);
}

TEST(RelockDriftEdges, AThousandWavelengthsAreTooMany) {
    EXPECT_TRUE(by_mean_square(4e5, 5.99999e5).known);
    EXPECT_FALSE(by_mean_square(4e5, 6e5).known);
    EXPECT_FALSE(by_mean_square(6e5, 5e5).known);
    for (const double sign : {1.0, -1.0}) {
        EXPECT_TRUE(by_detuning(sign * 999.999, sign * 500.0).known);
        EXPECT_FALSE(by_detuning(sign * 1000.0, sign * 500.0).known);
    }
}

// A deficit that has changed its sign names no decay. By phase nothing of it is rounding: as large as the light of the tick before
// lets it be, or without light as the tick's own deficit.
TEST(RelockDriftEdges, WhatFrequencyCannotCorrectIsInSigmaByPhase) {
    const Configured config = configured(RelockMethod::frequency);
    for (const bool by_phase : {false, true}) {
        for (const double before_lambda2 : {-1.0, 0.0004}) {
            RelockDriftState state{.since_gap = 3, .armed = true, .first_deficit_hz = -900.0};
            state.last_sq_lambda2 = before_lambda2;
            // 0.2 counts more than the bias.
            const RelockTick tick{
                .counts_first = 150, .counts_second = -150, .known_excess_counts = -0.2, .with_phase = by_phase};
            const FalseAngle found = step(config, state, tick).tick;
            EXPECT_FALSE(found.known);
            const double by_light = arcsec_per_lambda2 * before_lambda2;
            const double left = before_lambda2 > 0.0 ? by_light : 3.263 * 0.2;
            EXPECT_NEAR(std::sqrt(found.variance_arcsec2), by_phase ? left : 0.0, 1e-9);
        }
    }
}

// Ticks 1..i of a decaying deficit with a count so fine that derivatives by it are differences of one of a thousand.
struct Decay {
    Configured config{.gyro = {.bias = Hertz{1e12}}, .relock = {.method = RelockMethod::frequency}};
    std::vector<std::int64_t> difference;  // c_first - c_second

    explicit Decay(int i) {
        for (int k = 1; k <= i; ++k) difference.push_back(std::llround(0.005 * (1e12 - 1e11 * std::pow(0.6, k))));
    }

    RelockDriftOutput last() const {
        RelockDriftState state{.armed = true};
        RelockDriftOutput out;
        for (const std::int64_t d : difference)
            out = step(config, state, {.counts_first = d, .temperature_c = not_a_number});
        return out;
    }
};

double tick_value(const RelockDriftOutput& out) { return out.tick.value_arcsec; }
double first_value(const RelockDriftOutput& out) { return out.first.value_arcsec; }

// By the count difference of tick k, from 0.
double slope(const Decay& decay, std::size_t k, double (*value)(const RelockDriftOutput&)) {
    constexpr std::int64_t few = 100'000;
    Decay less = decay;
    Decay more = decay;
    less.difference[k] -= few;
    more.difference[k] += few;
    return (value(more.last()) - value(less.last())) / (2.0 * few);
}

// c_first - c_second = 2 r_1 - r_0 - r_2 of the readings r at the borders of the halves; each is rounded uniformly.
double variance_by_readings(double by_first_tick, double by_this_tick, bool neighbours) {
    const double a = by_first_tick;
    const double b = by_this_tick;
    if (neighbours) return (a * a + 4.0 * a * a + (a + b) * (a + b) + 4.0 * b * b + b * b) / 12.0;
    return 6.0 * (a * a + b * b) / 12.0;
}

TEST(RelockDriftEdges, FrequencyStatesTheVarianceOfTheRoundingOfEveryReading) {
    for (const int i : {2, 3, 5}) {
        const Decay decay{i};
        const double by_first = slope(decay, 0, tick_value);
        const double by_last = slope(decay, static_cast<std::size_t>(i) - 1, tick_value);
        const double expected = variance_by_readings(by_first, by_last, i == 2);
        EXPECT_NEAR(decay.last().tick.variance_arcsec2 / expected, 1.0, 1e-5) << "tick " << i;
    }
    const Decay two{2};
    const double expected = variance_by_readings(slope(two, 0, first_value), slope(two, 1, first_value), true);
    EXPECT_NEAR(two.last().first.variance_arcsec2 / expected, 1.0, 1e-5);
}

// Tick 2 is read for the sake of tick 1; tick 3 is nobody's.
TEST(RelockDriftEdges, FrequencyOfOneTickIsDoneAfterTheSecond) {
    const Configured config = configured(RelockMethod::frequency, 1);
    RelockDriftState state{.armed = true};
    for (int k = 0; k < 2; ++k) (void)step(config, state, {.counts_first = 140 + k, .counts_second = -140});
    const RelockDriftState done = state;
    (void)step(config, state, {.counts_first = 142, .counts_second = -140});
    EXPECT_EQ(state, done);
}

// With the largest constants that are allowed, a false angle is finite and still drowns every other number.
TEST(RelockDriftEdges, AFalseAngleBeyondBeliefIsNotUsed) {
    const RelockTick tick{.counts_first = 1000,
                          .counts_second = -1000,
                          .detuning_first_lambda = 0.22,
                          .detuning_second_lambda = 0.2,
                          .detuning_sq_first_lambda2 = 0.0484,
                          .detuning_sq_second_lambda2 = 0.04};
    for (const RelockMethod method : {RelockMethod::detuning, RelockMethod::mean_square}) {
        Configured config;
        config.gyro.tick = Seconds{1e9};
        config.gyro.scale = Arcsec{1e9};
        config.gyro.bias = Hertz{1e15};
        for (const double chi : {10.0, 1e3, 1e6}) {
            config.gyro.chi = chi;
            ASSERT_EQ(check(config.gyro), CompensationConstantsFault::none);
            EXPECT_FALSE(angle_of(method, tick, config).known) << chi;
        }
        config.gyro.chi = 1e-3;
        EXPECT_TRUE(angle_of(method, tick, config).known);
    }
}

// (chi f0/2) K T = 1e30 arcsec for each square of a wavelength.
TEST(RelockDriftEdges, TheFalseAngleBeyondBeliefIsAboveTenToTheThirty) {
    Configured config;
    config.gyro.tick = Seconds{1e9};
    config.gyro.scale = Arcsec{1e9};
    config.gyro.chi = 2.0;
    config.gyro.bias = Hertz{1e12};
    for (const int sign : {1, -1}) {
        EXPECT_TRUE(
            angle_of(RelockMethod::mean_square, {.sign = sign, .detuning_sq_second_lambda2 = 1.0 - 0x1p-41}, config)
                .known);
        EXPECT_FALSE(
            angle_of(RelockMethod::mean_square, {.sign = sign, .detuning_sq_second_lambda2 = 1.0 + 0x1p-40}, config)
                .known);
    }
}

}  // namespace relock_drift_edges_test
