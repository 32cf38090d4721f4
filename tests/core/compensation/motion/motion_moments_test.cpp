#include <zlg/core/compensation/motion_moments.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "compensation/compensation_support.hpp"

namespace motion_moments_test {

using compensation_test::Random;
using zlg::core::fast_memory;
using zlg::core::MotionMomentsConfig;
using zlg::core::MotionMomentsState;
using zlg::core::MotionTick;
using zlg::core::slow_memory;

// Windows of a row of samples, weighted as the memories weigh blocks: all windows of one block alike.
double direct_moment(const std::vector<double>& samples, int stride, int window, int n_windows, int a, int b) {
    double sum = 0.0;
    for (int w = 0; w < n_windows; ++w)
        sum += samples[static_cast<unsigned>(w * stride + a)] * samples[static_cast<unsigned>(w * stride + b)];
    EXPECT_LE((n_windows - 1) * stride + window, static_cast<int>(samples.size()));
    return sum / n_windows;
}

MotionMomentsState learn(const MotionMomentsConfig& config, const std::vector<double>& samples) {
    MotionMomentsState state;
    const auto stride = static_cast<unsigned>(samples_per_tick(config));
    for (unsigned k = 0; k + stride <= samples.size(); k += stride)
        (void)step(config, state, {true, samples[k], stride == 2 ? samples[k + 1] : 0.0});
    (void)step(config, state, MotionTick{});
    return state;
}

class MotionMoments : public testing::TestWithParam<bool> {};

TEST_P(MotionMoments, UnfoldedBlockEqualsTheSumOverItsWindows) {
    const MotionMomentsConfig config{GetParam()};
    const int stride = samples_per_tick(config);
    Random random{2};
    std::vector<double> samples;
    // The first tick is the level that is taken from all: 0 here.
    for (int k = 0; k < stride * 60; ++k) samples.push_back(k < stride ? 0.0 : random.normal());
    const MotionMomentsState state = learn(config, samples);
    const int n = 60 - zlg::core::window_ticks + 1;
    EXPECT_EQ(state.moments[fast_memory].n_windows, n);
    for (int a = 0; a < window_of(config); ++a)
        for (int b = a; b < window_of(config); ++b)
            EXPECT_NEAR(moment(config, state.moments[fast_memory], a, b),
                        direct_moment(samples, stride, window_of(config), n, a, b), 1e-12)
                << a << ' ' << b;
}

TEST_P(MotionMoments, MemoriesForgetExponentially) {
    const MotionMomentsConfig config{GetParam()};
    std::vector<double> samples(static_cast<unsigned>(samples_per_tick(config) * 4018), 0.0);
    const MotionMomentsState state = learn(config, samples);  // 40 blocks of 100 windows
    const auto expected = [](double memory) {
        const double keep = std::exp(-100.0 / memory);
        return 100.0 * (1.0 - std::pow(keep, 40)) / (1.0 - keep);
    };
    EXPECT_NEAR(state.moments[fast_memory].n_windows, expected(500.0), 1e-9);
    EXPECT_NEAR(state.moments[slow_memory].n_windows, expected(3000.0), 1e-9);
    EXPECT_EQ(state.n_folded, 40);
}

TEST_P(MotionMoments, ScatterIsAboutTheMeanOfTheWindow) {
    // A ramp of 0.1 a tick: 19 ticks scatter by 0.01 (19^2 - 1)/12, wherever the ramp has got to.
    const MotionMomentsConfig config{GetParam()};
    const int stride = samples_per_tick(config);
    std::vector<double> samples;
    for (int t = 0; t < 900; ++t)
        for (int h = 0; h < stride; ++h) samples.push_back(0.1 * t / stride);
    const MotionMomentsState state = learn(config, samples);
    EXPECT_NEAR(state.moments[slow_memory].scatter, 0.01 * (19.0 * 19.0 - 1.0) / 12.0, 1e-8);
}

TEST_P(MotionMoments, OnlyRowsOfUsableTicksMakeWindows) {
    const MotionMomentsConfig config{GetParam()};
    MotionMomentsState state;
    for (int t = 0; t < 500; ++t) {
        const bool usable = t % 19 != 18;
        EXPECT_FALSE(step(config, state, {usable, 1e6, 1e6}).has_window);
    }
    EXPECT_EQ(state.moments[fast_memory].n_windows, 0.0);
    EXPECT_EQ(moment(config, state.moments[fast_memory], 0, 0), 0.0);
}

TEST_P(MotionMoments, WhatIsNoAngleIsNotUsable) {
    const MotionMomentsConfig config{GetParam()};
    for (const double bad : {compensation_test::not_a_number, compensation_test::infinite, -1e16}) {
        MotionMomentsState state;
        for (int t = 0; t < 40; ++t) (void)step(config, state, {true, t == 25 ? bad : 1.0, 1.0});
        EXPECT_TRUE(std::isfinite(state.moments[fast_memory].sum[0]));
        EXPECT_EQ(state.n_recent, 14 * samples_per_tick(config));
    }
}

INSTANTIATE_TEST_SUITE_P(TicksAndHalves, MotionMoments, testing::Bool());

}  // namespace motion_moments_test
