#include <zlg/core/compensation/coil_asymmetry.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "compensation_support.hpp"

namespace coil_asymmetry_test {

using namespace zlg::core;
using compensation_test::Random;
using compensation_test::Statistics;

constexpr int second = 200;              // ticks
constexpr double arcsec_a_tick = 978.9;  // of the gyro of the paper, for eps of 1
constexpr double scale_arcsec = 3.263;
constexpr double code_a = 4.0 / 4096.0;  // of a converter of 12 bits for +-2 A
constexpr double noise_a = 0.001;        // of a reading

using OfTime = std::function<double(double)>;
OfTime constant(double value) {
    return [value](double) { return value; };
}

// A gyro with a coil of 1 A: its counter, and the current as it is read.
class Coil {
public:
    explicit Coil(std::uint64_t seed, double noise = noise_a) : noise_a_{noise}, random_{seed} {}

    // eps of the current, and of the sensor alone.
    CoilAsymmetry tick(double eps, double offset_a = 0.0) {
        const double time_s = static_cast<double>(n_) / second;
        ++n_;
        HalfRecord first{.bias_sign = 1, .coil_ua = read(1.0 + eps + offset_a)};
        HalfRecord other{.bias_sign = -1, .coil_ua = read(-1.0 + eps + offset_a)};
        if (starts_negative) std::swap(first, other);
        angle_arcsec_ += rate_arcsec_s(time_s) / second + mode * arcsec_a_tick * eps;
        const double counted = scale_arcsec * std::floor(angle_arcsec_ / scale_arcsec);
        const double value = counted - std::exchange(counted_arcsec_, counted);
        found = step(state, first, other,
                     {.measured = true,
                      .mode = mode,
                      .value_arcsec = value,
                      .variance_arcsec2 = scale_arcsec * scale_arcsec / 6.0,
                      .per_ratio_arcsec = mode * arcsec_a_tick});
        const double left = eps - found.ratio;
        left_arcsec += mode * arcsec_a_tick * left;
        false_arcsec += mode * arcsec_a_tick * eps;
        // The error of a tick is that of its neighbours.
        sigma_arcsec += arcsec_a_tick * std::sqrt(found.variance);
        return found;
    }
    CoilAsymmetry ticks(int n, double eps, double offset_a = 0.0) {
        for (int k = 0; k < n; ++k) tick(eps, offset_a);
        return found;
    }
    void begin() { left_arcsec = false_arcsec = sigma_arcsec = 0.0; }

    CoilAsymmetryState state{};
    CoilAsymmetry found{};
    bool starts_negative = false;
    std::int8_t mode = 1;
    OfTime rate_arcsec_s = constant(0.0);
    double left_arcsec = 0.0;   // in the angle
    double false_arcsec = 0.0;  // without the correction
    double sigma_arcsec = 0.0;  // claimed

private:
    std::int32_t read(double current_a) {
        const double amperes = code_a * std::round((current_a + noise_a_ * random_.normal()) / code_a);
        return static_cast<std::int32_t>(std::lround(1e6 * amperes));
    }

    double noise_a_;
    Random random_;
    std::int64_t n_ = 0;
    double angle_arcsec_ = 0.0;
    double counted_arcsec_ = 0.0;
};

const OfTime turning = [](double t) { return 12000.0 * std::sin(44.17 * t); };  // 7.03 Hz
const OfTime swaying = [](double t) { return 3000.0 * std::sin(1.9 * t) + 500.0 * std::sin(0.7 * t); };

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
        // Of a larger step, the variance also holds the chance that it is one of the sensor.
        if (std::abs(eps) <= 0.002) EXPECT_GT(off.variance(), 0.5) << eps;
        EXPECT_LT(off.variance(), 1.6) << eps;
    }
}

// What is left of a real asymmetry, beside what would be. No sigma holds what turns before it is seen: `late_arcsec`.
TEST(CoilAsymmetry, OfARealOneLittleIsLeft) {
    struct Case {
        double eps;
        int duration_s;
        double late_arcsec;
        double most;  // of what would be left
    };
    for (const OfTime& motion : {constant(0.0), constant(3600.0), turning})
        for (const Case& c : {Case{0.001, 1, 60.0, 0.5}, Case{0.001, 5, 60.0, 0.2}, Case{-0.001, 60, 60.0, 0.05},
                              Case{0.0005, 10, 120.0, 0.3}, Case{0.003, 1, 60.0, 0.3}, Case{0.003, 60, 60.0, 0.05},
                              Case{0.01, 1, 60.0, 0.2}, Case{0.01, 60, 60.0, 0.05}, Case{0.0002, 60, 700.0, 0.4}})
            for (std::uint64_t seed = 1; seed <= 20; ++seed) {
                Coil coil{seed};
                coil.rate_arcsec_s = motion;
                coil.ticks(60 * second, 0.0);
                coil.begin();
                coil.ticks(c.duration_s * second, c.eps);
                coil.ticks(3 * second, 0.0);
                EXPECT_LT(std::abs(coil.left_arcsec), c.late_arcsec + 3.0 * coil.sigma_arcsec) << c.eps << ' ' << seed;
                EXPECT_LT(std::abs(coil.left_arcsec), c.most * std::abs(coil.false_arcsec))
                    << c.eps << ' ' << c.duration_s << ' ' << motion(0.01) << ' ' << seed;
            }
}

TEST(CoilAsymmetry, OneTooShortOrTooSmallToBeSeenIsNotMadeWorse) {
    for (const double eps : {0.0001, 0.0002, 0.0005, 0.001, 0.002})
        for (const int n_ticks : {20, 40, 100})
            for (std::uint64_t seed = 1; seed <= 20; ++seed) {
                Coil coil{seed};
                coil.ticks(60 * second, 0.0);
                coil.begin();
                coil.ticks(n_ticks, eps);
                coil.ticks(3 * second, 0.0);
                EXPECT_LT(std::abs(coil.left_arcsec), 1.1 * std::abs(coil.false_arcsec) + 3.0 * coil.sigma_arcsec)
                    << eps << ' ' << n_ticks << ' ' << seed;
            }
}

// Whatever the sensor does, at rest and in motion: nothing goes into the angle but what sigma holds.
TEST(CoilAsymmetry, AnErrorOfTheSensorIsNoRotation) {
    const auto after = [](double t) { return t < 0.0 ? 0.0 : t; };
    const std::pair<const char*, OfTime> errors[] = {
        {"step of 0.1 %", [](double t) { return t < 0.0 ? 0.0 : 0.001; }},
        {"step of 1 %", [](double t) { return t < 0.0 ? 0.0 : -0.01; }},
        {"0.1 % for 1 s", [](double t) { return t < 0.0 || t > 1.0 ? 0.0 : 0.001; }},
        {"drift of 0.1 % in 10 s", [&](double t) { return 1e-4 * after(t); }},
        {"drift of 0.1 % in 100 s", [&](double t) { return 1e-5 * after(t); }},
        {"a slow swing", [&](double t) { return 5e-4 * std::sin(0.2 * after(t)); }}};
    for (const OfTime& motion : {constant(0.0), constant(3600.0), turning, swaying})
        for (const auto& [name, error_a] : errors)
            for (std::uint64_t seed = 1; seed <= 5; ++seed) {
                Coil coil{seed};
                coil.rate_arcsec_s = motion;
                coil.ticks(60 * second, 0.0);
                coil.begin();
                for (int k = 0; k < 120 * second; ++k) coil.tick(0.0, error_a(static_cast<double>(k) / second));
                EXPECT_LE(std::abs(coil.left_arcsec), 3.0 * coil.sigma_arcsec)
                    << name << ' ' << motion(0.01) << ' ' << seed;
                // An even chance for 0.2 s, in which the counts begin to tell.
                const double most_arcsec = 50.0 + 0.5 * 0.2 * second * arcsec_a_tick * std::abs(error_a(10.0));
                if (motion(0.01) == 0.0 || motion(0.01) == 3600.0)
                    EXPECT_LT(std::abs(coil.left_arcsec), most_arcsec) << name << ' ' << seed;
            }
}

// But for a turn of about the rate that the step would explain, 196 arcsec/s, which nothing distinguishes.
TEST(CoilAsymmetry, ATurnThatBeginsWithAStepOfTheSensorIsNoCurrent) {
    for (const double rate : {50.0, -50.0, 3000.0, -3000.0})
        for (const double delay_s : {0.0, 0.2, 0.6})
            for (std::uint64_t seed = 1; seed <= 3; ++seed) {
                Coil coil{seed};
                coil.ticks(60 * second, 0.0);
                coil.rate_arcsec_s = [=](double t) { return t < 60.0 + delay_s ? 0.0 : rate; };
                coil.begin();
                coil.ticks(10 * second, 0.0, 0.001);
                EXPECT_LE(std::abs(coil.left_arcsec), 3.0 * coil.sigma_arcsec) << rate << ' ' << delay_s;
                coil.mode = static_cast<std::int8_t>(-coil.mode);
                const CoilAsymmetry found = coil.ticks(10 * second, 0.0, 0.001);
                EXPECT_LE(std::abs(found.ratio), 3.0 * std::sqrt(found.variance)) << rate << ' ' << delay_s;
            }
}

TEST(CoilAsymmetry, AStuckNoisyOrMisscaledSensorTurnsNothing) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Coil coil{seed};
        coil.ticks(60 * second, 0.0);
        coil.begin();
        HalfRecord first{.bias_sign = 1, .coil_ua = 1'000'976};
        HalfRecord other{.bias_sign = -1, .coil_ua = 1'000'976};
        for (int k = 0; k < 60 * second; ++k)  // stuck at a reading
            ASSERT_EQ(step(coil.state, first, other, {true, 1, 0.0, 1.77, arcsec_a_tick}).ratio, 0.0) << k;
        first.coil_ua = 1'030'000;  // both signs alike
        other.coil_ua = -1'030'000;
        coil.state = {};
        coil.ticks(60 * second, 0.0);
        for (int k = 0; k < 60 * second; ++k)
            ASSERT_LT(std::abs(step(coil.state, first, other, {true, 1, 0.0, 1.77, arcsec_a_tick}).ratio), 2e-4) << k;
    }
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {  // ten times the noise
        Coil quiet{seed};
        quiet.ticks(60 * second, 0.0);
        Coil noisy{seed, 0.01};
        noisy.state = quiet.state;
        noisy.begin();
        noisy.ticks(60 * second, 0.0);
        EXPECT_LE(std::abs(noisy.left_arcsec), 3.0 * noisy.sigma_arcsec) << seed;
    }
}

// By the counts alone nothing tells in such a motion; the switch does.
TEST(CoilAsymmetry, ASwitchTellsACurrentFromASensor) {
    for (const bool is_real : {true, false})
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            Coil coil{seed};
            coil.rate_arcsec_s = swaying;
            coil.ticks(60 * second, 0.0);
            for (int k = 0; k < 10; ++k) {
                coil.ticks(20 * second, is_real ? 0.003 : 0.0, is_real ? 0.0 : 0.003);
                coil.mode = static_cast<std::int8_t>(-coil.mode);
            }
            EXPECT_NEAR(coil.found.ratio, is_real ? 0.003 : 0.0, 3e-4) << is_real << ' ' << seed;
        }
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
            EXPECT_EQ(coil.tick(0.0, wrong).variance, 0.0) << wrong << ' ' << seed;
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
    coil.ticks(20 * second, 0.0);
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
    CoilAsymmetryState state;
    const HalfRecord first{.bias_sign = 1};
    const HalfRecord other{.bias_sign = -1, .coil_ua = -1'000'000};
    for (int k = 0; k < 100; ++k) {
        EXPECT_EQ(step(state, first, other, {}).variance, 0.0);
        EXPECT_EQ(step(state, other, first, {}).variance, 0.0);
    }
    EXPECT_EQ(state.usual.n_ticks, 0.0);
}

TEST(CoilAsymmetry, WhatIsKnownStaysForTwoSecondsWithoutReadings) {
    Coil coil{1};
    coil.ticks(30 * second, 0.0);
    const double known = coil.ticks(second, 0.002).ratio;
    const HalfRecord unread{.bias_sign = 1};
    for (int k = 1; k < 2 * second; ++k) ASSERT_EQ(step(coil.state, unread, unread, {}).ratio, known);
    EXPECT_EQ(step(coil.state, unread, unread, {}).variance, 0.0);
}

}  // namespace coil_asymmetry_test
