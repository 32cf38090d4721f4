#include <zlg/core/compensation/coil_asymmetry.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "compensation_support.hpp"

namespace {

using namespace zlg::core;
using compensation_test::Random;
using compensation_test::Statistics;

constexpr int second = 200;              // ticks
constexpr double arcsec_a_tick = 978.9;  // of the gyro of the paper, for eps of 1
constexpr double code_a = 4.0 / 4096.0;  // of a converter of 12 bits for +-2 A
constexpr double noise_a = 0.001;        // of a reading

// A coil of 1 A, as it is read.
class Coil {
public:
    explicit Coil(std::uint64_t seed, double noise = noise_a) : noise_a_{noise}, random_{seed} {}

    CoilAsymmetry tick(double eps, double offset_a = 0.0) {
        HalfRecord first{.coil_current_a = read(1.0 + eps + offset_a), .bias_sign = 1};
        HalfRecord other{.coil_current_a = read(-1.0 + eps + offset_a), .bias_sign = -1};
        if (starts_negative) std::swap(first, other);
        return step(state, first, other);
    }
    CoilAsymmetry ticks(int n, double eps, double offset_a = 0.0) {
        CoilAsymmetry out;
        for (int k = 0; k < n; ++k) out = tick(eps, offset_a);
        return out;
    }

    CoilAsymmetryState state{};
    bool starts_negative = false;

private:
    double read(double current_a) { return code_a * std::round((current_a + noise_a_ * random_.normal()) / code_a); }

    double noise_a_;
    Random random_;
};

TEST(CoilAsymmetry, NothingIsSubtractedInTenHoursWithoutAFault) {
    Coil coil{1};
    for (int k = 0; k < 36000 * second; ++k) ASSERT_EQ(coil.tick(0.0).variance, 0.0) << k;
}

TEST(CoilAsymmetry, AStepIsKnownAfterASecondAsWellAsItsVarianceSays) {
    for (const double eps : {0.0007, 0.001, -0.001, 0.002, 0.01, 0.1}) {
        Statistics off;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            Coil coil{seed};
            coil.starts_negative = seed % 2 == 0;
            coil.ticks(60 * second, 0.0);
            const CoilAsymmetry found = coil.ticks(second, eps);
            ASSERT_GT(found.variance, 0.0) << eps;
            off.add((found.ratio - eps) / std::sqrt(found.variance));
        }
        EXPECT_NEAR(off.mean(), 0.0, 0.6) << eps;  // what is left of the time before the change
        EXPECT_GT(off.variance(), 0.5) << eps;
        EXPECT_LT(off.variance(), 1.6) << eps;
    }
}

// 195 arcsec without the correction.
TEST(CoilAsymmetry, ATenthOfAPerCentForASecondLeavesATenthOfItsAngle) {
    Statistics left;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Coil coil{seed};
        coil.ticks(60 * second, 0.0);
        double angle = 0.0;
        for (int k = 0; k < second; ++k) angle += arcsec_a_tick * (0.001 - coil.tick(0.001).ratio);
        for (int k = 0; k < 3 * second; ++k) angle -= arcsec_a_tick * coil.tick(0.0).ratio;
        left.add(angle);
    }
    EXPECT_LT(std::sqrt(left.variance() + left.mean() * left.mean()), 25.0);
}

TEST(CoilAsymmetry, WhatIsOverIsNoLongerSubtracted) {
    for (const double eps : {0.0007, -0.001, 0.01, 0.1})
        for (const int duration : {second, 10 * second})
            for (std::uint64_t seed = 1; seed <= 20; ++seed) {
                Coil coil{seed};
                coil.ticks(30 * second, 0.0);
                coil.ticks(duration, eps);
                EXPECT_EQ(coil.ticks(3 * second, 0.0).variance, 0.0) << eps << ' ' << duration << ' ' << seed;
            }
}

TEST(CoilAsymmetry, ASingleWrongReadingIsNoChange) {
    for (const double wrong : {0.005, 0.007, 0.01, 0.02, 0.1, -0.5})
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            Coil coil{seed};
            coil.ticks(30 * second, 0.0);
            EXPECT_EQ(coil.tick(wrong).variance, 0.0) << wrong << ' ' << seed;
            for (int k = 0; k < second; ++k)
                EXPECT_EQ(coil.tick(0.0).variance, 0.0) << wrong << ' ' << seed << ' ' << k;
        }
}

// A fifth of a step of the converter is read as none or as a whole one, 480 ppm.
TEST(CoilAsymmetry, AConverterTooCoarseForItsNoiseTellsNothing) {
    for (const double noise : {0.0, 1e-5, 1e-4, 2e-4})
        for (const double offset_a : {0.0, 0.2 * code_a, 0.5 * code_a}) {
            Coil coil{1, noise};
            coil.ticks(30 * second, 0.0, offset_a);
            for (int k = 0; k < 5 * second; ++k)
                ASSERT_EQ(coil.tick(0.2 * code_a, offset_a).variance, 0.0) << noise << ' ' << offset_a << ' ' << k;
        }
}

TEST(CoilAsymmetry, AnErrorOfTheReadingThatStaysIsNone) {
    Coil coil{1};
    for (int k = 0; k < 120 * second; ++k) ASSERT_EQ(coil.tick(0.0, 0.003).variance, 0.0);
    EXPECT_NEAR(coil.ticks(second, 0.001, 0.003).ratio, 0.001, 3e-4);
}

TEST(CoilAsymmetry, AnAsymmetryOfTheStartIsGivenUpWhenItEnds) {
    Coil coil{1};
    EXPECT_EQ(coil.ticks(10 * second, 0.002).variance, 0.0);
    EXPECT_EQ(coil.ticks(second, 0.0).variance, 0.0);
    EXPECT_NEAR(coil.state.usual.ratio, 0.0, 4e-4);
    EXPECT_NEAR(coil.ticks(second, 0.001).ratio, 0.001, 5e-4);
}

// A ramp over 10 s; the usual asymmetry follows a part of it.
TEST(CoilAsymmetry, ASlowOnsetIsFound) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Coil coil{seed};
        coil.ticks(60 * second, 0.0);
        for (int k = 0; k < 10 * second; ++k) coil.tick(1e-3 * k / (10 * second));
        EXPECT_NEAR(coil.ticks(10 * second, 0.001).ratio, 0.001, 2e-4) << seed;
    }
}

TEST(CoilAsymmetry, ACurrentThatIsNotReadTellsNothing) {
    for (const double none : {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        CoilAsymmetryState state;
        const HalfRecord first{.coil_current_a = none, .bias_sign = 1};
        const HalfRecord other{.coil_current_a = -1.0, .bias_sign = -1};
        for (int k = 0; k < 100; ++k) {
            EXPECT_EQ(step(state, first, other).variance, 0.0);
            EXPECT_EQ(step(state, other, first).variance, 0.0);
        }
        EXPECT_EQ(state.usual.n_ticks, 0.0);
    }
}

TEST(CoilAsymmetry, WhatIsKnownStaysForTwoSecondsWithoutReadings) {
    Coil coil{1};
    coil.ticks(30 * second, 0.0);
    const double known = coil.ticks(second, 0.002).ratio;
    const HalfRecord unread{.bias_sign = 1};
    for (int k = 1; k < 2 * second; ++k) ASSERT_EQ(step(coil.state, unread, unread).ratio, known);
    EXPECT_EQ(step(coil.state, unread, unread).variance, 0.0);
}

}  // namespace
