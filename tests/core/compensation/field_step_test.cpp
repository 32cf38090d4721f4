#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

#include <zlg/core/compensation/field_step.hpp>
#include <zlg/core/compensation/magnetic_drift.hpp>

namespace zlg::core {
namespace field_step_test {

constexpr double tick_s = 0.005;
constexpr double count_arcsec = 3.263;
constexpr CompensationConstants constants{
    .tick = Seconds{tick_s}, .scale = Arcsec{count_arcsec}, .random_walk = ArcsecPerRootSecond{0.14}};

using Rate = std::function<double(double)>;

const Rate none = [](double) { return 0.0; };

Rate pulse(double size_arcsec_s, double from_s, double to_s = 1e9) {
    return [=](double t) { return t >= from_s && t < to_s ? size_arcsec_s : 0.0; };
}

// A gyro with a drift of 0.7 arcsec/s that switches every `interval_s`, the first time after half of that.
struct Gyro {
    Rate field = none;
    Rate base = none;
    double interval_s = 45.0;
    double length_s = 400.0;
    bool by_phase = false;
    std::int8_t first_mode = 1;
};

// Angle errors at the end, of the values as read and of those corrected.
struct Outcome {
    double without_arcsec = 0.0;
    double with_arcsec = 0.0;
    double sigma_arcsec = 0.0;  // by what was added to the ticks
    double worst_arcsec = 0.0;  // in the last half
    double told_arcsec_s = 0.0;
    MagneticDriftState state{};
};

Outcome run(const Gyro& gyro, std::uint64_t seed = 1) {
    std::mt19937_64 random{seed};
    std::normal_distribution<> normal;
    Outcome out;
    double place = std::uniform_real_distribution<>{0.0, 1.0}(random);
    double counted = 0.0;
    double variance = 0.0;
    int gap = 0;
    int relock = 0;
    std::int8_t mode = gyro.first_mode;
    double next_s = gyro.interval_s / 2.0;
    for (std::int64_t k = 0; static_cast<double>(k) * tick_s < gyro.length_s; ++k) {
        const double t_s = (static_cast<double>(k) + 0.5) * tick_s;
        if (t_s > next_s) {
            next_s += gyro.interval_s;
            mode = static_cast<std::int8_t>(-mode);
            gap = 3;
            relock = 20;
        }
        const double magnetic = mode * (0.7 + gyro.field(t_s)) * tick_s;
        const double turned = gyro.base(t_s) * tick_s + magnetic + 0.14 * std::sqrt(tick_s) * normal(random);
        place += turned / count_arcsec;
        const double read = std::floor(place);
        const double angle = gyro.by_phase ? turned : (read - counted) * count_arcsec;
        counted = read;
        const bool measured = gap == 0;
        const double subtracted = step(constants, {.method = MagneticMethod::estimate}, out.state,
                                       {.measured = measured,
                                        .mode = mode,
                                        .angle_arcsec = angle,
                                        .settled = relock == 0,
                                        .with_phase = gyro.by_phase});
        if (!measured) {
            --gap;
            continue;
        }
        if (relock > 0) --relock;
        variance += out.state.variance_arcsec2;
        out.without_arcsec += magnetic;
        out.with_arcsec += magnetic - subtracted;
        if (2.0 * t_s > gyro.length_s) out.worst_arcsec = std::max(out.worst_arcsec, std::abs(out.with_arcsec));
    }
    out.sigma_arcsec = std::sqrt(variance);
    out.told_arcsec_s = out.state.field.field_arcsec_s;
    return out;
}

// Seeds 1 to 6.
double rms_with(const Gyro& gyro) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) sum += std::pow(run(gyro, seed).with_arcsec, 2) / 6.0;
    return std::sqrt(sum);
}

TEST(FieldStep, AFieldThatLastsIsToldAndTakenOut) {
    for (const double size : {-98.0, -10.0, 10.0, 50.0})
        for (const std::int8_t mode : {std::int8_t{1}, std::int8_t{-1}}) {
            const Gyro gyro{.field = pulse(size, 100.3), .first_mode = mode};
            const Outcome got = run(gyro);
            EXPECT_NEAR(got.told_arcsec_s, size, 1.5) << size;
            // 12 s of it stay without; the rest is a sawtooth of 22 s of it.
            EXPECT_LT(std::abs(got.with_arcsec), 30.0) << size;
            EXPECT_LT(got.worst_arcsec, 60.0) << size;
            EXPECT_GT(got.sigma_arcsec, 1.0);
        }
}

TEST(FieldStep, ItGoesAsItCame) {
    for (const double until_s : {125.3, 150.0, 190.0, 200.0}) {
        const Gyro gyro{.field = pulse(50.0, 100.3, until_s)};
        EXPECT_LT(rms_with(gyro), 40.0) << until_s;
        EXPECT_NEAR(run(gyro).told_arcsec_s, 0.0, 1.5) << until_s;
    }
}

TEST(FieldStep, BySteadyTurnAsByRest) {
    for (const double rate : {15.04, -1e3, 1e5})
        EXPECT_LT(rms_with({.field = pulse(50.0, 100.3), .base = [=](double) { return rate; }}), 30.0) << rate;
}

TEST(FieldStep, ByPhaseAFewArcsecASecondAreEnough) {
    const Gyro gyro{.field = pulse(5.0, 100.3, 200.0), .by_phase = true};
    EXPECT_LT(rms_with(gyro), 15.0);
    EXPECT_NEAR(run(gyro).told_arcsec_s, 0.0, 0.5);
}

// What no data tell: between two switches it is a rotation.
TEST(FieldStep, APulseWithinOneSegmentStaysInTheAngle) {
    const Outcome got = run({.field = pulse(50.0, 100.3, 104.3)});
    EXPECT_NEAR(got.with_arcsec, got.without_arcsec, 10.0);
    EXPECT_GT(std::abs(got.without_arcsec), 180.0);
    EXPECT_EQ(got.told_arcsec_s, 0.0);
}

// The same steps as rotations: with the estimate the error is that without it.
TEST(FieldStep, ARotationIsLeftInTheAngle) {
    const std::vector<Rate> bases{pulse(50.0, 100.3),
                                  pulse(-98.0, 100.3, 190.0),
                                  pulse(10.0, 111.0),
                                  [](double t) { return std::fmod(t, 60.0) > 30.0 ? 50.0 : 0.0; },
                                  [](double t) { return std::fmod(t, 90.0) > 20.0 ? 30.0 : -30.0; },
                                  [](double t) { return 2000.0 * std::sin(2.0 * std::numbers::pi * 0.1 * t); },
                                  [](double t) { return 5.0 * std::sin(2.0 * std::numbers::pi * t / 90.0); },
                                  [](double t) { return t > 100.0 ? std::min(t - 100.0, 40.0) : 0.0; }};
    for (std::size_t k = 0; k < bases.size(); ++k)
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const Outcome got = run({.base = bases[k]}, seed);
            EXPECT_EQ(got.told_arcsec_s, 0.0) << k;
            EXPECT_LT(std::abs(got.with_arcsec), 1.1 * std::max(std::abs(got.without_arcsec), 16.0)) << k;
        }
}

// A field that comes in the gap, or with a rotation, is not told; nothing is made worse by it.
TEST(FieldStep, WhatIsNotUnderstoodIsLeftInTheAngle) {
    const std::vector<Gyro> gyros{
        {.field = pulse(50.0, 112.506, 200.0)},
        {.field = pulse(50.0, 112.45, 200.0)},
        {.field = [](double t) { return 50.0 * std::clamp((t - 100.0) / 20.0, 0.0, 1.0); }},
        {.field = pulse(50.0, 100.3), .base = pulse(30.0, 95.0)},
        {.field = [](double t) { return t > 95.0 ? (t > 103.0 ? 50.0 : 20.0) : 0.0; }},
        {.field = pulse(50.0, 100.3), .base = [](double t) { return 2000.0 * std::sin(0.6 * t); }}};
    for (std::size_t k = 0; k < gyros.size(); ++k)
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const Outcome got = run(gyros[k], seed);
            EXPECT_LT(std::abs(got.with_arcsec), 1.1 * std::abs(got.without_arcsec) + 5.0) << k << ' ' << seed;
        }
}

// A rotation and a field in one segment: the angle in question is in sigma.
TEST(FieldStep, WhatStaysOpenIsInSigma) {
    const Outcome got = run({.field = pulse(50.0, 100.3), .base = pulse(30.0, 95.0)});
    EXPECT_GT(got.sigma_arcsec, std::abs(got.with_arcsec));
}

TEST(FieldStep, WithoutAStepNothingIsAddedToSigma) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) EXPECT_EQ(run({}, seed).sigma_arcsec, 0.0);
}

// Two hours in a field: the filter goes on to know the rest of the drift.
TEST(FieldStep, TheFilterOfTheDriftKnowsItAgain) {
    Gyro gyro{.field = pulse(50.0, 1000.3), .length_s = 7200.0};
    const Outcome got = run(gyro);
    const double drift = got.state.filter.estimate[of_drift] + got.told_arcsec_s;
    EXPECT_NEAR(drift, 50.7, 0.3);
    EXPECT_LT(got.worst_arcsec, 25.0);
    EXPECT_GT(got.state.trust, 0.9);
}

// Where a step lies in a segment, and how large it is, of noiseless blocks: exact.
TEST(FieldStep, OfNoiselessBlocksTheStepIsExact) {
    const CompensationConstants fine{
        .tick = Seconds{tick_s}, .scale = Arcsec{1e-6}, .random_walk = ArcsecPerRootSecond{0.0}};
    for (const std::int64_t length : {800, 9000, 200'000})
        for (const double place : {0.3, 0.6, 0.95}) {
            SegmentBlocks blocks;
            const auto at = static_cast<std::int64_t>(place * static_cast<double>(length));
            for (std::int64_t k = 0; k < length; ++k) (void)accumulate(fine, blocks, (k < at ? 3.0 : 13.0) * tick_s);
            EXPECT_LE(blocks.n, field_blocks);
            const SegmentStep got = step_of(fine, blocks, false, 0.0);
            EXPECT_TRUE(got.stepped) << length << ' ' << place;
            EXPECT_NEAR(got.step_arcsec_s, 10.0, 1e-6);
            EXPECT_NEAR(got.rate_arcsec_s, 13.0, 1e-6);
            EXPECT_NEAR(got.excess_arcsec, 10.0 * tick_s * static_cast<double>(length - at), 1e-3);
        }
}

TEST(FieldStep, EveryTickIsInOneBlock) {
    SegmentBlocks blocks;
    for (std::int64_t k = 0; k < 3'000'000; ++k) (void)accumulate(constants, blocks, 1.0);
    double sum = blocks.growing.arcsec;
    for (int k = 0; k < blocks.n; ++k) sum += blocks.block[static_cast<unsigned>(k)].arcsec;
    EXPECT_EQ(sum, 3e6);
    EXPECT_LT(blocks.n, field_blocks);
}

}  // namespace field_step_test
}  // namespace zlg::core
