#include <zlg/core/compensation/motion_learning.hpp>

#include <array>
#include <span>

#include <zlg/core/compensation/border.hpp>

namespace zlg::core {
namespace {

// The outlier gate. The threshold is far above the 3 to 10 standard deviations of a usual gate on purpose: it keeps out
// faults and single shocks, while vibration that grows tenfold must be learnt at once. 16 ticks are 80 ms. By trial on
// bench/accuracy.
constexpr double outlier_ratio_sq = 1e4;
constexpr int outlier_step = 8;
constexpr int learnt_from_level = 16 * outlier_step;

// Advances the outlier gate; returns whether the tick is learnt.
bool passes_gate(const CompensationConstants& gyro, const OptimalBridgeConfig& config, MotionLearningState& state,
                 const MotionTick& tick) noexcept {
    const Moments& learnt = state.moments.moments[fast_memory];
    const double x = tick.first + (config.halves ? tick.second : 0.0) - state.moments.level;
    const double step = step_arcsec(gyro, state.moments.with_phase);
    if (!is_ready(config, state) || !(x * x > outlier_ratio_sq * (learnt.scatter + step * step))) {
        state.outlier_level -= state.outlier_level > 0;
        return true;
    }
    if (state.outlier_level < learnt_from_level) state.outlier_level += outlier_step;
    return state.outlier_level >= learnt_from_level;
}

GapWeights weights_of_pseudo_gap(const CompensationConstants& gyro, const OptimalBridgeConfig& config,
                                 const MotionLearningState& state, MotionMemory memory) noexcept {
    GapProblem problem{.n_gap = scored_gap, .n_side = points_a_side(scored_gap), .memory = memory};
    problem.with_phase = state.moments.with_phase;
    const MotionCovariance covariance = covariance_of(gyro, config, state, problem);
    for (int k = 0; k < 2 * problem.n_side; ++k)
        add_point(covariance, problem, place_of(k, problem.n_side, problem.n_gap), Column{});
    return weights(covariance, problem);
}

// New weights after a block: of four blocks two are for the fast memory and one for the slow one, which changes less.
void update_weights(const CompensationConstants& gyro, const OptimalBridgeConfig& config,
                    MotionLearningState& state) noexcept {
    const int block = state.moments.n_folded;
    if (state.n_weighed == block) return;
    state.n_weighed = block;
    if (block % 4 == 0) return;
    const MotionMemory memory = block % 2 != 0 ? fast_memory : slow_memory;
    state.scores.weights[memory] = weights_of_pseudo_gap(gyro, config, state, memory);
}

void judge(MotionLearningState& state, WindowTicks ticks) noexcept {
    const double learnt = state.moments.moments[fast_memory].scatter;
    step(state.scores, ticks, is_rough(scatter(ticks.data(), window_ticks), learnt));
}

void judge(const OptimalBridgeConfig& config, MotionLearningState& state) noexcept {
    const Window& recent = state.moments.recent;
    if (!config.halves) return judge(state, std::span{recent}.first<window_ticks>());
    std::array<double, window_ticks> ticks;
    for (unsigned k = 0; k < ticks.size(); ++k) ticks[k] = recent[2 * k] + recent[2 * k + 1];
    judge(state, ticks);
}

// Neighbouring windows share 18 of their 19 ticks, so every second one holds nearly all the information at half the
// cost.
bool is_judged_now(const MotionMomentsState& moments) noexcept { return moments.block.n_windows % 2 == 0; }

}  // namespace

void step(const CompensationConstants& gyro, const OptimalBridgeConfig& config, MotionLearningState& state,
          const MotionTick& tick, bool idle) noexcept {
    if (!config.learns) return;
    // Weights use the blocks that ended before this tick; a block that ends in it is expensive enough by itself.
    if (idle) update_weights(gyro, config, state);
    MotionTick learnt = tick;
    learnt.usable = tick.usable && passes_gate(gyro, config, state, tick);
    const MotionMomentsOutput out = step(MotionMomentsConfig{config.halves}, state.moments, learnt);
    if (out.began_by_phase) {
        // The losses were those of the old moments, and of readings with their rounding.
        state.scores = BridgeScoresState{.by_phase = true};
        state.n_weighed = 0;
    }
    if (out.has_window && is_judged_now(state.moments)) judge(config, state);
}

bool is_ready(const OptimalBridgeConfig& config, const MotionLearningState& state) noexcept {
    return !config.learns || state.moments.moments[fast_memory].n_windows >= min_windows;
}

}  // namespace zlg::core
