#include <zlg/core/compensation/bridge_scores.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "compensation/compensation_support.hpp"

namespace bridge_scores_test {

using compensation_test::Random;
using namespace zlg::core;

using Ticks = std::array<double, window_ticks>;

// Weights 3/16 everywhere: exact for a constant rate.
GapWeights mean_weights(double variance) {
    GapWeights w{.known = true, .variance_arcsec2 = variance};
    for (unsigned k = 0; k < 16; ++k) w.weight[k] = 3.0 / 16.0;
    return w;
}

// Exact for every parabola through the four ticks nearest to the gap.
GapWeights quadratic_weights(double variance) {
    GapWeights w{.known = true, .variance_arcsec2 = variance};
    w.weight[6] = w.weight[9] = -1.0;
    w.weight[7] = w.weight[8] = 2.5;
    return w;
}

Ticks parabola(double curvature) {
    Ticks x;
    for (unsigned k = 0; k < x.size(); ++k) x[k] = curvature * (k - 9.0) * (k - 9.0);
    return x;
}

TEST(BridgeScores, NothingIsJudgedWithoutBothWeights) {
    BridgeScoresState state;
    state.weights[fast_memory] = mean_weights(1.0);
    step(state, parabola(1.0), false);
    EXPECT_EQ(state.n, 0.0);
    EXPECT_FALSE(is_judged(state));
    EXPECT_EQ(better_memory(state), fast_memory);
    EXPECT_EQ(choose(state, slow_memory, true), by_slow_memory);
    EXPECT_EQ(variance_ratio(state, fast_memory), 1.0);
}

TEST(BridgeScores, LossesAreTheSquaresOfTheErrorsOnAParabola) {
    BridgeScoresState state;
    state.weights = {mean_weights(2.0), quadratic_weights(0.5)};
    step(state, parabola(1.0), false);
    // The gap holds 1 + 0 + 1. Inner ticks 4, outer 9; the mean of 4..81 on both sides is (4 + 9 + .. + 81)/8.
    const double constant = 0.75 * (4 + 4 + 9 + 9) - 2.0;
    const double mean = 3.0 / 16.0 * 2.0 * (4 + 9 + 16 + 25 + 36 + 49 + 64 + 81) - 2.0;
    EXPECT_NEAR(state.score[by_fast_memory].loss, mean * mean, 1e-10);
    EXPECT_NEAR(state.score[by_slow_memory].loss, 0.0, 1e-20);
    EXPECT_NEAR(state.score[by_constant].loss, constant * constant, 1e-10);
    EXPECT_NEAR(state.score[by_quadratic].loss, 0.0, 1e-20);
    EXPECT_EQ(state.score[by_fast_memory].predicted, 2.0);
}

TEST(BridgeScores, TheOneThatLosesLessIsTaken) {
    Random random{4};
    BridgeScoresState state;
    state.weights = {quadratic_weights(1.0), mean_weights(1.0)};
    for (int k = 0; k < 3000; ++k) {
        Ticks x;
        for (double& tick : x) tick = random.normal();
        step(state, x, false);
    }
    // White noise: 3 + 9/16 for the mean of all, 3 + 2.25 for that of four, 3 + 14.5 for the parabola.
    EXPECT_NEAR(state.score[by_slow_memory].loss, 3.5625, 0.35);
    EXPECT_NEAR(state.score[by_constant].loss, 5.25, 0.5);
    EXPECT_NEAR(state.score[by_quadratic].loss, 17.5, 1.7);
    EXPECT_EQ(better_memory(state), slow_memory);
    EXPECT_EQ(choose(state, slow_memory, false), by_slow_memory);
    EXPECT_EQ(choose(state, fast_memory, false), by_constant);
    EXPECT_NEAR(variance_ratio(state, slow_memory), 3.5625, 0.35);
}

TEST(BridgeScores, ByPhaseTheSlowMemoryIsTakenSooner) {
    for (const bool by_phase : {false, true}) {
        BridgeScoresState state{.by_phase = by_phase};
        state.weights = {mean_weights(1.0), quadratic_weights(1.0)};
        const int least = by_phase ? 100 : 500;
        for (int k = 0; k < least; ++k) {
            EXPECT_EQ(better_memory(state), fast_memory) << k;
            step(state, parabola(1.0), false);
        }
        EXPECT_EQ(better_memory(state), slow_memory) << by_phase;
    }
}

TEST(BridgeScores, RoughWindowsAreAnAccountOfTheirOwn) {
    BridgeScoresState state;
    state.weights = {mean_weights(1.0), mean_weights(1.0)};
    for (int k = 0; k < 300; ++k) step(state, Ticks{}, false);
    for (int k = 0; k < 20; ++k) step(state, parabola(5.0), true);
    EXPECT_EQ(state.score[by_fast_memory].loss, 0.0);
    EXPECT_EQ(choose(state, fast_memory, true), by_quadratic);
    EXPECT_EQ(choose(state, fast_memory, false), by_fast_memory);
}

TEST(BridgeScores, TheRatioStaysWithinItsLimits) {
    BridgeScoresState state;
    state.weights = {quadratic_weights(1e9), mean_weights(1e-9)};
    for (int k = 0; k < 300; ++k) step(state, parabola(1.0), false);
    EXPECT_EQ(variance_ratio(state, fast_memory), 0.125);
    EXPECT_EQ(variance_ratio(state, slow_memory), 16.0);
}

TEST(BridgeScores, ScatterIsTheVariance) {
    const std::array<double, 4> values{1.0, 3.0, 5.0, 7.0};
    EXPECT_DOUBLE_EQ(scatter(values.data(), 4), 5.0);
    EXPECT_TRUE(is_rough(10.0, 1.0));
    EXPECT_FALSE(is_rough(8.0, 1.0));
}

}  // namespace bridge_scores_test
