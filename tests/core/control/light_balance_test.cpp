#include <zlg/core/control/light_balance.hpp>

#include "support.hpp"

namespace zlg::core::light_balance_test {

constexpr MonitorLimits config{.balance_ticks = 48'000.0};  // every tick is learnt from here
static_assert(is_allowed(config));
static_assert(!is_allowed(MonitorLimits{.balance_ticks = 0.0}));
static_assert(!is_allowed(MonitorLimits{.balance_ticks = not_a_number}));

constexpr double slope = 0.332;  // K: signal by wavelength
constexpr double ticks_an_hour = 720'000.0;

struct Beams {
    double a = 0.0;
    double b = 0.0;
};

// The light of both beams through its photodiodes: it falls by `droop` dl^2 from 1 on, and its signal is K times the
// detuning.
struct Gyro {
    double gain_b = 1.0;
    double offset_a = 0.0;
    double offset_b = 0.0;
    double droop = 13.5;
    LightBalanceState state{};
    int halves = 0;
    bool has_faded = false;

    [[nodiscard]] Beams seen(int sign, double detuning_lambda) const {
        const double power = 1.0 - droop * detuning_lambda * detuning_lambda;
        const double signal = sign * slope * detuning_lambda;
        return {power * (1.0 + signal) + offset_a, gain_b * power * (1.0 - signal) + offset_b};
    }
    [[nodiscard]] double signal(Beams seen) const {
        const double b = weight_of(state).of(seen.b);
        return (seen.a - b) / (seen.a + b);
    }
    [[nodiscard]] int sign() const { return halves % 2 == 0 ? 1 : -1; }

    BalancedHalf read(double detuning_lambda) const {
        const Beams light = seen(sign(), detuning_lambda);
        return {.is_first = halves % 2 == 0,
                .is_read = true,
                .has_faded = has_faded,
                .signal = signal(light),
                .light = light.a + weight_of(state).of(light.b)};
    }
    void half(double detuning_lambda, double noise = 0.0) {
        BalancedHalf half = read(detuning_lambda);
        half.signal += noise;
        follow(config, state, half);
        ++halves;
    }
    void ticks(int n, double detuning_lambda = 0.0) {
        for (int k = 0; k < 2 * n; ++k) half(detuning_lambda);
    }

    // The detuning falls from `miss_lambda` with a time constant of 8 halves, and jumps where the bias is reversed:
    // that is seen with this deviation.
    void relock(double miss_lambda, double deviation_lambda, auto& random) {
        std::normal_distribution<double> normal;
        state.has_last = false;  // the gap was dark
        constexpr int n = 60;
        const auto at = [miss_lambda](double half) { return miss_lambda * std::exp(-half / 8.0); };
        for (int k = 0; k < n; ++k) {
            const BalancedHalf half = read(at(k + 0.5));
            if (k > 0) {
                const double behind = signal(seen(sign(), at(k)));
                const double before = signal(seen(-sign(), at(k)));
                const double jump_lambda = (behind + before) / slope + deviation_lambda * normal(random);
                learn_offset(state, half, {jump_lambda, deviation_lambda * deviation_lambda}, slope);
            }
            follow(config, state, half);
            ++halves;
        }
    }
};

TEST(LightBalance, TheWeightIsTheInverseOfTheGain) {
    for (const double gain : {0.7, 0.99, 1.0, 1.02, 1.4}) {
        for (const double detuning_lambda : {0.0, 0.02, -0.05}) {
            Gyro gyro{.gain_b = gain};
            gyro.ticks(400, detuning_lambda);
            // The product of a/b over both halves of a tick is free of the detuning.
            EXPECT_NEAR(gyro.state.weight * gain, 1.0, 1e-4) << gain << ' ' << detuning_lambda;
            EXPECT_EQ(gyro.state.offset, 0.0);
            EXPECT_FALSE(gyro.state.changes);
        }
    }
}

// Later steps of the gain are followed with the memory: 1 - 1/e after 100 ticks.
TEST(LightBalance, TheWeightFollowsWithinItsMemory) {
    Gyro gyro;
    gyro.ticks(1000);
    gyro.gain_b = 1.001;
    gyro.ticks(100);
    // After a step, of a double pole at 1 - 1/200: (1 - n/200) exp(-n/200) is left.
    EXPECT_NEAR((1.0 - gyro.state.weight) / 0.001, 1.0 - 0.5 * std::exp(-0.5), 0.005);
}

// An even drift leaves nothing; a mean of 100 ticks would be 1e-5 behind where a tick makes 1e-7 of it.
TEST(LightBalance, AnEvenDriftOfAPhotodiodeLeavesNothing) {
    Gyro gyro;
    gyro.ticks(1000);
    for (int k = 0; k < 4000; ++k) {
        gyro.gain_b *= 1.0 + 1e-7;
        gyro.ticks(1);
    }
    EXPECT_NEAR(gyro.gain_b * weight_of(gyro.state).weight, 1.0, 2e-7);
}

// Where the detuning stands in the sense of `follow` its signal falls from S_2/r to S_2 <= .01/(r^-2 - 1) within the
// tick, r = exp(-1/8): the falls of a re-lock sum to at most .0106, of which the memory keeps a hundredth, and of
// earlier switches 1/e of it each.
TEST(LightBalance, ADetuningThatMovesInARelockDoesNotShiftTheWeight) {
    std::mt19937 random{3};
    constexpr double most = 2.0 * 0.0106 / 100.0 / (1.0 - 1.0 / std::numbers::e);
    for (const double miss_lambda : {0.1, -0.1, 0.02}) {
        Gyro gyro;
        gyro.ticks(1000);
        for (int k = 0; k < 20; ++k) {
            gyro.ticks(370);
            gyro.relock(miss_lambda, 1e-3, random);
        }
        EXPECT_NEAR(weight_of(gyro.state).of(1.0), 1.0, most) << miss_lambda;
    }
}

TEST(LightBalance, AnUnreadHalfTeachesNothing) {
    Gyro gyro{.gain_b = 1.1};
    for (int k = 0; k < 100; ++k) {
        BalancedHalf half = gyro.read(0.0);
        half.is_read = false;
        follow(config, gyro.state, half);
        ++gyro.halves;
    }
    EXPECT_EQ(gyro.state.weight, 1.0);
    EXPECT_EQ(gyro.state.n_ticks, 0.0);
}

// (2), against the jump that the light of an offset makes less that of light without.
TEST(LightBalance, TheJumpOfAnOffsetIsThatOfItsEquation) {
    for (const double detuning_lambda : {0.12, 0.06, -0.09}) {
        Gyro without;
        without.ticks(400);
        const double offset = 1e-5;
        Gyro with = without;
        with.offset_b = offset;
        with.state.weight = 1.0 / (1.0 + offset);  // equal at the centre
        const auto jump_lambda = [&](const Gyro& gyro) {
            return (gyro.signal(gyro.seen(1, detuning_lambda)) + gyro.signal(gyro.seen(-1, detuning_lambda))) / slope;
        };
        without.half(detuning_lambda);
        const double per_offset_sq = unknown_jump_lambda2(without.state, without.read(detuning_lambda), slope) / 9e-4;
        const double jump = jump_lambda(with) - jump_lambda(without);
        // In units of a beam's level, which is w P_0/2; negative, for beam B is the brighter one.
        EXPECT_LT(jump, 0.0);
        EXPECT_NEAR(-jump / offset / std::sqrt(per_offset_sq), 1.0, 0.02) << detuning_lambda;
    }
}

TEST(LightBalance, AnOffsetIsLearntFromTheJumpsOfItsRelocks) {
    for (const double offset_b : {0.01, -0.01, 0.03, -0.05}) {
        for (const double gain_b : {0.7, 1.0, 1.4}) {
            std::mt19937 random{7};
            Gyro gyro{.gain_b = gain_b, .offset_b = offset_b};
            for (int k = 0; k < 60; ++k) {
                gyro.ticks(400);
                gyro.relock(k % 2 == 0 ? 0.1 : -0.1, 0.003, random);
            }
            gyro.ticks(2000);
            EXPECT_NEAR(gyro.state.offset, offset_b, 1e-3 * gain_b) << gain_b;
            EXPECT_NEAR(gyro.state.weight * (1.0 + (offset_b - gyro.state.offset) / gain_b) * gain_b, 1.0, 1e-4);
        }
    }
}

TEST(LightBalance, EqualBeamsWithNoiseHaveNoOffset) {
    std::mt19937 random{11};
    for (int gyros = 0; gyros < 20; ++gyros) {
        Gyro gyro;
        for (int k = 0; k < 20; ++k) {
            gyro.ticks(200);
            gyro.relock(k % 2 == 0 ? 0.1 : -0.1, 0.0047, random);
            EXPECT_LT(std::abs(gyro.state.offset), 1e-3) << k;
        }
    }
}

TEST(LightBalance, OnlyAFastDriftIsAFault) {
    for (const auto& [drift_per_h, is_fault] :
         {std::pair{0.0, false}, {0.1, false}, {-0.1, false}, {0.4, true}, {-0.4, true}, {4.0, true}}) {
        Gyro gyro{.gain_b = 1.1};
        bool seen = false;
        for (int tick = 0; tick < 120'000; ++tick) {  // ten minutes
            gyro.gain_b = 1.1 * (1.0 + drift_per_h * tick / ticks_an_hour);
            gyro.ticks(1);
            seen |= gyro.state.changes;
        }
        EXPECT_EQ(seen, is_fault) << drift_per_h;
    }
}

// A beam that comes back within ten seconds finds the balance as it was; one that is away for a minute, to a tenth of
// its light, is followed by a fifth of the slower mean, which grows meanwhile by (32.5/20.5)^.2, and is not too bright
// afterwards: it is learnt anew.
TEST(LightBalance, ABeamThatFadesAndComesBackIsNotTooBright) {
    for (const auto& [ticks, most] : {std::pair{450, 1e-4}, {12'000, 0.316}}) {
        Gyro gyro{.gain_b = 1.1};
        gyro.ticks(20'000);
        const double before = gyro.state.weight;
        gyro.gain_b = 0.11;
        gyro.has_faded = true;
        gyro.ticks(ticks);
        EXPECT_NEAR(gyro.state.weight / before, 1.0, most) << ticks;
        gyro.gain_b = 1.1;
        gyro.has_faded = false;
        gyro.ticks(3000);
        EXPECT_NEAR(gyro.state.weight / before, 1.0, 1e-4) << ticks;
    }
}

TEST(LightBalance, WhateverTheLightIsTheStateStaysFinite) {
    constexpr double brightest = 200.0 * std::numeric_limits<float>::max();  // of both beams, one a hundredfold
    constexpr double lights[] = {0.0, -1.0, 1e-30, 2.0, 2.0, brightest};
    constexpr double signals[] = {-1.0, 0.0, 0.0, 1.0};
    constexpr double jumps[] = {0.0, 1e-3, -1e-3, 1e6, -1e6};  // of the least discriminator
    constexpr double variances[] = {1e-8, 1e-5, 1e12};
    std::mt19937 random{13};
    const auto one_of = [&random](const auto& values) { return values[random() % std::size(values)]; };
    LightBalanceState state;
    for (int k = 0; k < 200'000; ++k) {
        const BalancedHalf half{k % 2 == 0,        random() % 8 != 0, random() % 2 == 0,
                                random() % 8 == 0, one_of(signals),   one_of(lights)};
        ASSERT_GE(unknown_jump_lambda2(state, half, slope), 0.0) << k;
        learn_offset(state, half, {one_of(jumps), one_of(variances)}, slope);
        follow(config, state, half);
        ASSERT_TRUE(std::isfinite(state.weight) && state.weight >= 0.01 && state.weight <= 100.0) << k;
        ASSERT_TRUE(std::isfinite(state.offset)) << k;
        ASSERT_TRUE(std::isfinite(state.variance)) << k;
        ASSERT_TRUE(std::isfinite(state.slow_weight)) << k;
    }
}

}  // namespace zlg::core::light_balance_test
