#include <zlg/core/control/sync_detector.hpp>

#include "support.hpp"

namespace zlg::core::sync_detector_test {

constexpr SyncDetectorConfig config{};
static_assert(is_allowed(config));
static_assert(!is_allowed(SyncDetectorConfig{.discriminator_per_lambda = 0.0}));
static_assert(!is_allowed(SyncDetectorConfig{.discriminator_per_lambda = not_a_number}));
static_assert(is_allowed(SyncDetectorConfig{.discriminator_per_lambda = -0.3}));
static_assert(!is_allowed(SyncDetectorConfig{.dark_fraction = 1.0}));
static_assert(!is_allowed(SyncDetectorConfig{.level_min = -1.0}));
static_assert(!is_allowed(SyncDetectorConfig{.level_ticks = 0}));

struct Light {
    std::vector<float> a;
    std::vector<float> b;
};

// Sixteen samples of an ideal laser: (A - B)/(A + B) = sign K dl, one value of dl per sample.
Light light_of(const std::vector<double>& dl_lambda, int sign, double level = 1000.0, double k_per_lambda = 0.332) {
    Light light;
    for (const double dl : dl_lambda) {
        light.a.push_back(static_cast<float>(0.5 * level * (1.0 + sign * k_per_lambda * dl)));
        light.b.push_back(static_cast<float>(0.5 * level * (1.0 - sign * k_per_lambda * dl)));
    }
    return light;
}

std::vector<double> steady(double dl_lambda) { return std::vector<double>(16, dl_lambda); }

SyncDetectorOutput both(SyncDetectorState& s, const Light& light, int sign, bool settled = true, bool has_b = true) {
    return step(config, s,
                {.light_a = light.a,
                 .light_b = has_b ? std::span<const float>{light.b} : std::span<const float>{},
                 .sign = sign,
                 .settled = settled});
}

SyncDetectorOutput single(SyncDetectorState& s, const Light& light, int sign, bool settled = true) {
    return both(s, light, sign, settled, false);
}

// It has the level of light of 1000, by both beams.
SyncDetectorState with_level() {
    SyncDetectorState s;
    for (int half = 0; half < 8; ++half) (void)both(s, light_of(steady(0.0), 1), 1);
    return s;
}

TEST(SyncDetector, BothBeamsGiveMeanAndMeanSquareFromTheFirstHalf) {
    std::vector<double> ramp;
    double mean = 0.0;
    double mean_sq = 0.0;
    for (int k = 0; k < 16; ++k) {
        ramp.push_back(0.2 - 0.02 * k);
        mean += ramp.back() / 16.0;
        mean_sq += ramp.back() * ramp.back() / 16.0;
    }
    for (const int sign : {1, -1}) {
        SyncDetectorState s;
        const SyncDetectorOutput out = both(s, light_of(ramp, sign), sign);
        EXPECT_TRUE(out.readable && out.two_way && out.usable);
        EXPECT_NEAR(out.detuning.value(), mean, 1e-6);
        EXPECT_NEAR(out.mean_sq_lambda2, mean_sq, 1e-6);
        EXPECT_NEAR(out.light, 1000.0, 1e-3);
    }
}

TEST(SyncDetector, BeamAIsBrighterForAPositiveProductOfSigns) {
    SyncDetectorState s;
    const Light brighter_a{{510.0f}, {490.0f}};
    // (A - B)/(A + B) = 0.02, over 0.332 per wavelength
    EXPECT_NEAR(both(s, brighter_a, 1).detuning.value(), 0.02 / 0.332, 1e-12);
    EXPECT_NEAR(both(s, brighter_a, -1).detuning.value(), -0.02 / 0.332, 1e-12);
    const SyncDetectorConfig mirrored{.discriminator_per_lambda = -0.332};
    EXPECT_NEAR(step(mirrored, s, {.light_a = brighter_a.a, .light_b = brighter_a.b, .sign = 1}).detuning.value(),
                -0.02 / 0.332, 1e-12);
}

TEST(SyncDetector, TheUnitOfTheLightDoesNotMatter) {
    for (const double level : {1e-6, 1.0, 1e9}) {
        SyncDetectorState s;
        EXPECT_NEAR(both(s, light_of(steady(0.07), 1, level), 1).detuning.value(), 0.07, 1e-6);
    }
}

TEST(SyncDetector, CommonNoiseOfTheLightCancelsBetweenTheBeams) {
    SyncDetectorState s;
    Light light = light_of(steady(0.05), 1);
    for (std::size_t k = 0; k < 16; ++k) {
        const float flicker = k % 2 == 0 ? 1.2f : 0.8f;
        light.a[k] *= flicker;
        light.b[k] *= flicker;
    }
    EXPECT_NEAR(both(s, light, 1).detuning.value(), 0.05, 1e-6);
}

TEST(SyncDetector, OneWayAndDarkLightAndOneDarkSampleAreNotTwoWay) {
    SyncDetectorState s = with_level();
    const Light one_way{std::vector<float>(16, 1000.0f), std::vector<float>(16, 0.0f)};
    const Light other_way{std::vector<float>(16, 0.0f), std::vector<float>(16, 1000.0f)};
    Light one_dark_sample = light_of(steady(0.0), 1);
    one_dark_sample.b[7] = 0.0f;
    for (const Light& light :
         {one_way, other_way, one_dark_sample, light_of(steady(0.0), 1, 400.0), light_of(steady(0.0), 1, 0.0)}) {
        const SyncDetectorOutput out = both(s, light, 1);
        EXPECT_TRUE(out.readable);
        EXPECT_FALSE(out.two_way || out.usable);
        EXPECT_EQ(out.detuning.value(), 0.0);
        EXPECT_EQ(out.mean_sq_lambda2, 0.0);
    }
    EXPECT_TRUE(both(s, light_of(steady(0.0), 1, 600.0), 1).two_way);
}

TEST(SyncDetector, OneBeamNeedsItsLevelFirstThenReadsLikeTwo) {
    SyncDetectorState s;
    // Four whole ticks at a constant detuning: the modulation alternates and leaves the level alone.
    for (int half = 0; half < 8; ++half) {
        const int sign = half % 2 == 0 ? 1 : -1;
        EXPECT_FALSE(single(s, light_of(steady(0.1), sign), sign, false).usable);
    }
    for (const int sign : {1, -1}) {
        const SyncDetectorOutput out = single(s, light_of(steady(0.04), sign), sign);
        EXPECT_TRUE(out.two_way && out.usable);
        EXPECT_NEAR(out.detuning.value(), 0.04, 1e-5);
        EXPECT_NEAR(out.mean_sq_lambda2, 0.0016, 1e-6);
    }
}

TEST(SyncDetector, OneBeamIsTwoWayBetweenItsLimits) {
    SyncDetectorState s;
    for (int half = 0; half < 8; ++half) (void)single(s, light_of(steady(0.0), 1), half % 2 == 0 ? 1 : -1);
    const auto two_way = [&s](double beam_a) {
        SyncDetectorState copy = s;
        return single(copy, light_of(steady(0.0), 1, 2.0 * beam_a), 1).two_way;
    };
    // At 1000 the other beam has gone out.
    for (const double beam_a : {0.0, 249.0, 751.0, 1000.0}) EXPECT_FALSE(two_way(beam_a)) << beam_a;
    for (const double beam_a : {251.0, 749.0}) EXPECT_TRUE(two_way(beam_a)) << beam_a;
}

TEST(SyncDetector, TheLevelFollowsSettledLightWithItsTimeConstantAndNothingElse) {
    for (const bool has_b : {true, false}) {
        SyncDetectorState s;
        const auto one_tick = [&s, has_b](double level, bool settled) {
            for (const int sign : {1, -1}) (void)both(s, light_of(steady(0.05), sign, level), sign, settled, has_b);
        };
        const auto level = [&s, has_b] { return has_b ? s.both.level : 2.0 * s.single.level; };
        for (int tick = 0; tick < 4; ++tick) one_tick(1000.0, false);
        EXPECT_NEAR(level(), 1000.0, 0.01);
        for (int tick = 0; tick < 200; ++tick) one_tick(800.0, false);
        EXPECT_NEAR(level(), 1000.0, 0.01);
        for (int tick = 0; tick < 200; ++tick) one_tick(800.0, true);
        EXPECT_NEAR(level(), 800.0 + 200.0 * std::exp(-1.0), 0.5);
    }
}

TEST(SyncDetector, MoreLightIsLearntAnewLessNever) {
    for (const bool has_b : {true, false}) {
        SyncDetectorState s;
        const auto see = [&s, has_b](double level, int n_ticks) {
            SyncDetectorOutput out;
            for (int half = 0; half < 2 * n_ticks; ++half) {
                const int sign = half % 2 == 0 ? 1 : -1;
                out = both(s, light_of(steady(0.0), sign, level), sign, true, has_b);
            }
            return out;
        };
        (void)see(10.0, 10);
        EXPECT_TRUE(see(1000.0, 10).usable);
        EXPECT_FALSE(see(100.0, 10000).two_way);
        EXPECT_TRUE(see(1000.0, 1).usable);
    }
}

TEST(SyncDetector, ASingleFlashIsNotALevel) {
    SyncDetectorState s = with_level();
    const double before = s.both.level;
    for (int half = 0; half < 3; ++half) (void)both(s, light_of(steady(0.0), 1, 1e6), 1, false);
    EXPECT_EQ(s.both.level, before);
    EXPECT_TRUE(both(s, light_of(steady(0.0), 1), 1).usable);
}

TEST(SyncDetector, OneWayLightIsKnownBeforeAnyLevelIs) {
    SyncDetectorState s;
    const Light one_way{std::vector<float>(16, 1000.0f), std::vector<float>(16, 1.0f)};
    for (int half = 0; half < 10; ++half) EXPECT_FALSE(both(s, one_way, 1).two_way);
    EXPECT_EQ(s.both.level, 0.0);
}

TEST(SyncDetector, FlickeringLightIsNotLearnt) {
    SyncDetectorState s;
    for (int half = 0; half < 100; ++half) {
        (void)both(s, light_of(steady(0.0), 1, half % 2 == 0 ? 1000.0 : 3000.0), 1);
    }
    EXPECT_EQ(s.both.level, 0.0);
}

TEST(SyncDetector, OneBeamPairsNeighbouringHalvesOnly) {
    SyncDetectorState s;
    Light spoilt = light_of(steady(0.0), 1);
    spoilt.a[0] = std::numeric_limits<float>::quiet_NaN();
    for (int pair = 0; pair < 20; ++pair) {
        (void)single(s, light_of(steady(0.0), 1), 1);
        (void)single(s, spoilt, -1);
        (void)single(s, light_of(steady(0.0), 1), -1);
        (void)single(s, spoilt, 1);
    }
    EXPECT_EQ(s.single.level, 0.0);
}

TEST(SyncDetector, LightBelowTheFloorIsDarkFromTheStart) {
    const SyncDetectorConfig floor{.level_min = 10.0};
    const Light faint = light_of(steady(0.0), 1, 9.0);
    SyncDetectorState s;
    for (int half = 0; half < 100; ++half) {
        const int sign = half % 2 == 0 ? 1 : -1;
        EXPECT_FALSE(step(floor, s, {.light_a = faint.a, .light_b = faint.b, .sign = sign}).two_way);
        EXPECT_FALSE(step(floor, s, {.light_a = faint.a, .light_b = {}, .sign = sign}).two_way);
    }
    EXPECT_EQ(s.both.level, 0.0);
    EXPECT_EQ(s.single.level, 0.0);
}

TEST(SyncDetector, WhatCannotBeReadIsSaidAndLeavesTheLevelAlone) {
    SyncDetectorState s = with_level();
    const SyncDetectorState before = s;
    Light not_finite_a = light_of(steady(0.0), 1);
    not_finite_a.a[3] = std::numeric_limits<float>::quiet_NaN();
    Light not_finite_b = light_of(steady(0.0), 1);
    not_finite_b.b[15] = std::numeric_limits<float>::infinity();
    const Light none{};
    const Light too_many{std::vector<float>(65, 1.0f), std::vector<float>(65, 1.0f)};
    const Light unequal{std::vector<float>(16, 1.0f), std::vector<float>(15, 1.0f)};
    for (const Light& light : {not_finite_a, not_finite_b, none, too_many, unequal}) {
        const SyncDetectorOutput out = both(s, light, 1);
        EXPECT_FALSE(out.readable || out.two_way || out.usable);
        EXPECT_EQ(out.detuning.value(), 0.0);
        EXPECT_EQ(out.light, 0.0);
    }
    EXPECT_EQ(s, before);
}

TEST(SyncDetector, FaintLightIsLearntOnlyWhileThereIsABeat) {
    for (const bool beats : {false, true}) {
        SyncDetectorState s = with_level();
        const Light faint = light_of(steady(0.0), 1, 300.0);
        const SyncDetectorInput in{.light_a = faint.a, .light_b = faint.b, .beats = beats};
        for (int half = 0; half < 64; ++half) EXPECT_FALSE(step(config, s, in).two_way) << half;
        EXPECT_EQ(step(config, s, in).two_way, beats);
    }
}

TEST(SyncDetector, ATenthOfTheLightIsDark) {
    SyncDetectorState s = with_level();
    EXPECT_FALSE(both(s, light_of(steady(0.0), 1, 110.0), 1).dark);
    EXPECT_TRUE(both(s, light_of(steady(0.0), 1, 90.0), 1).dark);
}

}  // namespace zlg::core::sync_detector_test
