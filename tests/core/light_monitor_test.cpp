#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <zlg/core/light_monitor.hpp>

namespace zlg::core {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr LightMonitorConfig config{.noise = Wavelengths{0.0033}, .bias_chi = 3.6};
static_assert(check(config) == LightMonitorFault::none);
static_assert(check(LightMonitorConfig{.noise = Wavelengths{nan_value}}) == LightMonitorFault::noise);
static_assert(check(LightMonitorConfig{.bias_chi = -1.0}) == LightMonitorFault::bias_chi);
static_assert(check(LightMonitorConfig{.most_gain = 0.5}) == LightMonitorFault::most_gain);

// Two beams of 1000, their noise, and what a detector makes of them.
class Light {
public:
    double detuning_lambda = 0.0;
    double noise_lambda = 0.0033;
    double share_a = 1.0;  // of beam A that is left
    bool stuck = false;
    bool two_way = true;
    bool dark = false;
    bool beats = true;
    double deficit_ratio = 0.0;

    LightMonitorOutput half(const LightMonitorConfig& c = config) {
        sign_ = -sign_;
        if (!stuck) shine();
        double sum = 0.0;
        double squares = 0.0;
        for (std::size_t k = 0; k < a_.size(); ++k) {
            const double a = static_cast<double>(a_[k]);
            const double b = static_cast<double>(b_[k]);
            const double x = sign_ * (a - b) / (a + b) / slope;
            sum += x;
            squares += x * x;
        }
        return step(c, state,
                    {.light_a = a_,
                     .light_b = b_,
                     .sign = sign_,
                     .settled = true,
                     .beats = beats,
                     .deficit_ratio = deficit_ratio,
                     .two_way = two_way,
                     .dark = dark,
                     .light = 2000.0,
                     .signal_per_lambda = slope,
                     .usable = two_way,
                     .detuning = Wavelengths{sum / 16.0},
                     .mean_sq_lambda2 = squares / 16.0});
    }
    LightMonitorOutput halves(int n) {
        for (int k = 1; k < n; ++k) (void)half();
        return half();
    }

    LightMonitorState state;

private:
    static constexpr double slope = 0.332;

    void shine() {
        const double noise = std::sqrt(2.0) * 1000.0 * slope * noise_lambda;
        for (std::size_t k = 0; k < a_.size(); ++k) {
            const double signal = sign_ * slope * detuning_lambda;
            a_[k] = static_cast<float>(share_a * 1000.0 * (1.0 + signal) + noise * normal_(random_));
            b_[k] = static_cast<float>(1000.0 * (1.0 - signal) + noise * normal_(random_));
        }
    }

    int sign_ = -1;
    std::array<float, 16> a_{};
    std::array<float, 16> b_{};
    std::mt19937 random_{11};
    std::normal_distribution<double> normal_;
};

TEST(LightMonitor, OrdinaryLightIsLeftAsItIs) {
    Light light;
    for (int k = 0; k < 100000; ++k) {
        light.detuning_lambda = 0.01 * std::sin(0.01 * k);
        const LightMonitorOutput out = light.half();
        ASSERT_FALSE(out.stuck || out.noisy || out.unbalanced || out.contradicted) << k;
        ASSERT_TRUE(out.usable && out.has_mean_square) << k;
        ASSERT_NEAR(out.detuning.value(), light.detuning_lambda, 0.006) << k;
    }
}

TEST(LightMonitor, LightWithoutNoiseMayStandStill) {
    Light light;
    light.noise_lambda = 0.0;
    for (int k = 0; k < 100; ++k) {
        const LightMonitorOutput out = light.half({});
        ASSERT_TRUE(out.usable && out.has_mean_square && !out.stuck);
    }
}

TEST(LightMonitor, AConverterThatStandsStillIsSeenInTwoHalvesAndSteersNothing) {
    Light light;
    (void)light.halves(100);
    light.stuck = true;
    (void)light.halves(17);  // its samples still differ within the half: it is held as a whole
    light.stuck = false;
    EXPECT_FALSE(light.half().stuck);

    LightMonitorState s;
    const std::array<float, 16> still = [] {
        std::array<float, 16> x{};
        x.fill(870.0f);
        return x;
    }();
    LightMonitorInput in{.light_a = still, .light_b = still, .two_way = true, .light = 1740.0, .usable = true};
    (void)step(config, s, in);
    EXPECT_FALSE(step(config, s, in).stuck);
    const LightMonitorOutput out = step(config, s, in);
    EXPECT_TRUE(out.stuck);
    EXPECT_FALSE(out.usable || out.has_mean_square);
}

TEST(LightMonitor, NoiseIsSeenInTwoHalvesAndMakesNoMeanSquare) {
    Light light;
    (void)light.halves(100);
    light.noise_lambda = 0.045;
    int k = 0;
    while (!light.half().noisy) ASSERT_LT(++k, 10);
    light.noise_lambda = 0.2;
    EXPECT_FALSE(light.halves(3).has_mean_square);
    light.noise_lambda = 0.0033;
    EXPECT_FALSE(light.half().has_mean_square);  // it may hold some of it
    EXPECT_TRUE(light.halves(30).has_mean_square);
}

TEST(LightMonitor, APerimeterThatSwingsIsNoNoise) {
    Light light;
    for (int k = 0; k < 1000; ++k) {
        light.detuning_lambda = 0.1 * std::sin(2.7 * k);
        ASSERT_FALSE(light.half().noisy) << k;
    }
}

TEST(LightMonitor, ABeamThatFadedLeavesTheDetuningAsTheMeanOfTwoHalves) {
    Light light;
    (void)light.halves(100);
    light.detuning_lambda = 0.01;
    light.share_a = 0.95;  // of 1.95: the reading is off by 0.077
    const LightMonitorOutput out = light.halves(12);
    EXPECT_TRUE(out.unbalanced);
    EXPECT_TRUE(out.usable);
    EXPECT_FALSE(out.has_mean_square);
    EXPECT_NEAR(out.detuning.value(), 0.01, 0.003);
    light.share_a = 1.0;
    const LightMonitorOutput again = light.halves(12);
    EXPECT_FALSE(again.unbalanced);
    EXPECT_TRUE(again.has_mean_square);
}

TEST(LightMonitor, ADetuningThatTakesNothingFromTheBiasIsOfABeam) {
    for (const double deficit_ratio : {0.0, 3.6 * 0.12 * 0.12}) {
        Light light;
        (void)light.halves(100);
        light.detuning_lambda = 0.12;
        light.deficit_ratio = deficit_ratio;
        EXPECT_EQ(light.halves(2).unbalanced, deficit_ratio == 0.0);
    }
}

// It takes from the beat in one half what it adds in the next; the light knows nothing of it.
TEST(LightMonitor, ARotationThatChangesIsNoFadedBeam) {
    Light light;
    (void)light.halves(100);
    for (int k = 0; k < 40; ++k) {
        light.deficit_ratio = k % 2 == 0 ? 0.2 : -0.2;
        const LightMonitorOutput out = light.half();
        EXPECT_FALSE(out.unbalanced) << k;
        EXPECT_TRUE(out.has_mean_square) << k;
    }
}

TEST(LightMonitor, TheBeatOverrulesTheLightAfterEightHalvesUnlessItIsDark) {
    Light light;
    (void)light.halves(100);
    light.two_way = false;
    EXPECT_FALSE(light.halves(7).contradicted);
    const LightMonitorOutput out = light.half();
    EXPECT_TRUE(out.contradicted);
    EXPECT_FALSE(out.usable);
    light.dark = true;
    EXPECT_FALSE(light.half().contradicted);
    light.dark = false;
    EXPECT_TRUE(light.halves(8).contradicted);
    light.beats = false;
    EXPECT_FALSE(light.half().contradicted);
}

TEST(LightMonitor, NoDetuningIsBeyondTheNextMode) {
    Light light;
    light.noise_lambda = 0.0033;
    light.detuning_lambda = 0.6;
    light.deficit_ratio = 10.0;
    EXPECT_FALSE(light.halves(3).usable);
}

TEST(LightMonitor, WhatItRemembersOfDamagedLightAreNumbers) {
    LightMonitorState state;
    const std::array<float, 4> damaged{std::numeric_limits<float>::quiet_NaN(), 1.0f, 1.0f, 1.0f};
    const std::array<float, 4> endless{std::numeric_limits<float>::infinity(), 1.0f, 1.0f, 1.0f};
    (void)step(config, state, {.light_a = damaged, .light_b = endless});
    EXPECT_EQ(state, LightMonitorState{state});
    EXPECT_EQ(state.last_a, 0.0f);
    EXPECT_EQ(state.last_b, 0.0f);
}

}  // namespace
}  // namespace zlg::core
