#include <zlg/core/compensation/motion_learning.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "compensation/compensation_support.hpp"

namespace motion_learning_test {

using compensation_test::Random;
using namespace zlg::core;

// A counter without steps: the motion alone.
constexpr CompensationConstants smooth{.scale = Arcsec{0.0}};

void learn_noise(const OptimalBridgeConfig& config, MotionLearningState& state, Random& random, int n_ticks,
                 bool idle = true) {
    for (int t = 0; t < n_ticks; ++t) step(smooth, config, state, {true, random.normal(), random.normal()}, idle);
}

TEST(MotionLearning, WhiteNoiseIsLearntAsSuch) {
    Random random{6};
    MotionLearningState state;
    const OptimalBridgeConfig config;
    learn_noise(config, state, random, 12000);
    const MotionCovariance covariance = covariance_of(smooth, config, state, GapProblem{.memory = slow_memory});
    for (int lag = 0; lag < 10; ++lag) EXPECT_NEAR(covariance.of_ticks(3, 3 + lag), lag == 0 ? 1.0 : 0.0, 0.12) << lag;
    // The mean of 16 bridges 3 ticks of variance 1 with 3.5625; 16 learnt weights cost a little more.
    EXPECT_NEAR(state.scores.score[by_slow_memory].loss, 3.56, 0.4);
    EXPECT_NEAR(variance_ratio(state.scores, slow_memory), 1.0, 0.15);
}

TEST(MotionLearning, ABlowIsNotLearntButANewMotionIs) {
    const OptimalBridgeConfig config;
    MotionLearningState struck;
    MotionLearningState quiet;
    for (int t = 0; t < 4000; ++t) {
        Random random{static_cast<std::uint64_t>(t) + 1};
        const double value = random.normal();
        step(smooth, config, quiet, {true, value, 0.0}, true);
        step(smooth, config, struck, {true, t >= 2000 && t < 2006 ? 1e6 : value, 0.0}, true);
    }
    const double usual = covariance_of(smooth, config, quiet, GapProblem{.memory = fast_memory}).of_ticks(0, 0);
    EXPECT_NEAR(covariance_of(smooth, config, struck, GapProblem{.memory = fast_memory}).of_ticks(0, 0) / usual, 1.0,
                0.2);
    EXPECT_NEAR(variance_ratio(struck.scores, fast_memory), variance_ratio(quiet.scores, fast_memory), 0.2);

    // A vibration a thousand times as large that stays is the motion before long.
    for (int t = 0; t < 3000; ++t) step(smooth, config, quiet, {true, 1e3 * std::sin(0.63 * t), 0.0}, true);
    EXPECT_NEAR(covariance_of(smooth, config, quiet, GapProblem{.memory = fast_memory}).of_ticks(0, 0), 0.5e6, 0.1e6);
}

// Noise of readings by phase after a motion that whole counts read as a thousand times as large. The debounce is longer than a window.
MotionLearningState learnt_by_phase(const OptimalBridgeConfig& config, Random& random, int n_ticks) {
    MotionLearningState state;
    for (int t = 0; t < 3000; ++t) step(smooth, config, state, {true, 1e3 * random.normal(), 0.0}, true);
    learn_noise(config, state, random, 32);
    state.moments.with_phase = true;
    learn_noise(config, state, random, n_ticks);
    return state;
}

TEST(MotionLearning, ByPhaseTheMotionIsLearntAnew) {
    Random random{11};
    const OptimalBridgeConfig config;
    const MotionLearningState before = learnt_by_phase(config, random, 99);
    EXPECT_EQ(before.moments.moments[fast_memory].by_phase, 0.0);
    EXPECT_GT(before.scores.n, 0.0);
    EXPECT_TRUE(is_ready(config, before));

    const MotionLearningState after = learnt_by_phase(config, random, 100);
    for (const MotionMemory memory : {fast_memory, slow_memory}) {
        EXPECT_EQ(after.moments.moments[memory].by_phase, 1.0);
        EXPECT_EQ(after.moments.moments[memory].n_windows, 100.0);
        EXPECT_NEAR(after.moments.moments[memory].scatter, 1.0, 0.4);
    }
    // Its losses as well, and both memories have weights after one more block.
    EXPECT_EQ(after.scores.n, 0.0);
    EXPECT_TRUE(is_ready(config, after));
    const MotionLearningState judged = learnt_by_phase(config, random, 310);
    EXPECT_GT(judged.scores.n, 50.0);
    EXPECT_LT(judged.scores.score[by_fast_memory].loss, 10.0);
}

TEST(MotionLearning, TooFewWindowsOfOneKindAreLeftOut) {
    Random random{12};
    const OptimalBridgeConfig config;
    const auto& fast = [](const MotionLearningState& s) -> const Moments& { return s.moments.moments[fast_memory]; };
    // A gap after 49 windows by phase, then 50 of them.
    MotionLearningState state = learnt_by_phase(config, random, 49);
    step(smooth, config, state, {}, true);
    EXPECT_EQ(fast(state).by_phase, 0.0);
    learn_noise(config, state, random, window_ticks - 1 + min_windows);
    step(smooth, config, state, {}, true);
    EXPECT_EQ(fast(state).by_phase, 1.0);
    EXPECT_EQ(fast(state).n_windows, min_windows);

    // The place is lost for 99 ticks, and then for 100.
    const Moments known = fast(state);
    learn_noise(config, state, random, window_ticks - 1);
    state.moments.with_phase = false;
    learn_noise(config, state, random, 99);
    step(smooth, config, state, {}, true);
    EXPECT_EQ(fast(state), known);
    learn_noise(config, state, random, window_ticks - 1 + 100);
    EXPECT_LT(fast(state).by_phase, 1.0);
    EXPECT_GT(fast(state).n_windows, min_windows);
    state.moments.with_phase = true;
    learn_noise(config, state, random, 100);
    EXPECT_EQ(fast(state).by_phase, 1.0);
    EXPECT_EQ(fast(state).n_windows, 100.0);
}

TEST(MotionLearning, HalvesMakeTheSameTicks) {
    Random random{7};
    MotionLearningState by_ticks;
    MotionLearningState by_halves;
    const OptimalBridgeConfig ticks;
    const OptimalBridgeConfig halves{.halves = true};
    for (int t = 0; t < 2000; ++t) {
        const double first = random.normal();
        const double second = random.normal();
        step(smooth, ticks, by_ticks, {true, first + second}, true);
        step(smooth, halves, by_halves, {true, first, second}, true);
    }
    for (unsigned m = 0; m < 2; ++m) {
        // The prior and the rounding part are taken out: the moments alone.
        const auto& a = by_ticks.moments.moments[m];
        const auto& b = by_halves.moments.moments[m];
        EXPECT_EQ(a.n_windows, b.n_windows);
        for (int i = 0; i < window_ticks; ++i)
            for (int j = i; j < window_ticks; ++j) {
                const MotionMomentsConfig h{true};
                double sum = 0.0;
                for (const int p : {2 * i, 2 * i + 1})
                    for (const int q : {2 * j, 2 * j + 1}) sum += moment(h, b, p < q ? p : q, p < q ? q : p);
                EXPECT_NEAR(sum, moment(MotionMomentsConfig{false}, a, i, j), 1e-10);
            }
    }
}

TEST(MotionLearning, WeightsWaitUntilNoGapDoes) {
    Random random{8};
    const OptimalBridgeConfig config;
    MotionLearningState state;
    learn_noise(config, state, random, 180, false);
    EXPECT_TRUE(is_ready(config, state));
    EXPECT_FALSE(state.scores.weights[fast_memory].known);
    learn_noise(config, state, random, 1);
    EXPECT_TRUE(state.scores.weights[fast_memory].known);
}

TEST(MotionLearning, EverySecondWindowIsJudgedOnceBothMemoriesHaveWeights) {
    Random random{10};
    const OptimalBridgeConfig config;
    MotionLearningState state;
    // 18 ticks before the first window, a block of 100, some ticks to weigh: the fast memory is known, the slow one is not.
    learn_noise(config, state, random, 18 + 100 + 30);
    EXPECT_TRUE(state.scores.weights[fast_memory].known);
    EXPECT_EQ(state.scores.n, 0.0);
    learn_noise(config, state, random, 100);
    EXPECT_TRUE(state.scores.weights[slow_memory].known);
    const double before = state.scores.n + state.scores.n_rough;
    learn_noise(config, state, random, 60);
    EXPECT_EQ(state.scores.n + state.scores.n_rough, before + 30.0);
}

TEST(MotionLearning, OfFourBlocksTheFastMemoryIsWeighedAfterTwoAndTheSlowOneAfterOne) {
    Random random{11};
    const OptimalBridgeConfig config;
    MotionLearningState state;
    learn_noise(config, state, random, 1000);
    std::array<int, 2> n_weighed{};
    for (int t = 0; t < 800; ++t) {
        const auto before = state.scores.weights;
        learn_noise(config, state, random, 1);
        for (const unsigned m : {fast_memory, slow_memory}) n_weighed[m] += !(state.scores.weights[m] == before[m]);
    }
    EXPECT_EQ(n_weighed[fast_memory], 4);
    EXPECT_EQ(n_weighed[slow_memory], 2);
}

TEST(MotionLearning, ReadyAfterFiftyWindowsOrWithAGivenPrior) {
    Random random{9};
    const OptimalBridgeConfig config;
    MotionLearningState state;
    learn_noise(config, state, random, 117);
    EXPECT_FALSE(is_ready(config, state));
    learn_noise(config, state, random, 1);  // the first block is full
    EXPECT_TRUE(is_ready(config, state));
    OptimalBridgeConfig given;
    given.learns = false;
    MotionLearningState empty;
    EXPECT_TRUE(is_ready(given, empty));
    learn_noise(given, empty, random, 200);
    EXPECT_EQ(empty, MotionLearningState{});
}

TEST(MotionLearning, PlacesLeaveTheGapOut) {
    EXPECT_EQ(place_of(0, 8, 3), 0);
    EXPECT_EQ(place_of(7, 8, 3), 7);
    EXPECT_EQ(place_of(8, 8, 3), 11);
    EXPECT_EQ(place_of(15, 8, 3), 18);
}

}  // namespace motion_learning_test
