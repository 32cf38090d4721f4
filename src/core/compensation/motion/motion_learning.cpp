#include <zlg/core/compensation/motion_learning.hpp>

#include <array>
#include <span>

namespace zlg::core {
namespace {

// Fewer say more of the moment than of the motion.
constexpr double enough_windows = 50.0;

// A tick this far out, of a variance of the learnt motion's, is a blow or a fault: what is squared only once is not learnt.
// A motion that goes on like this is a new one.
constexpr double foreign_ratio = 1e4;
constexpr int foreign_step = 8;
constexpr int foreign_at_most = 16 * foreign_step;

// return  the tick may be learnt.
bool is_familiar(const OptimalBridgeConfig& config, MotionLearningState& state, const MotionTick& tick) noexcept {
    const Moments& learnt = state.moments.moments[fast_memory];
    const double x = tick.first + (config.halves ? tick.second : 0.0) - state.moments.level;
    const double step = config.counter_step.value();
    if (!is_ready(config, state) || !(x * x > foreign_ratio * (learnt.scatter + step * step))) {
        state.foreign -= state.foreign > 0;
        return true;
    }
    if (state.foreign < foreign_at_most) state.foreign += foreign_step;
    return state.foreign >= foreign_at_most;
}

GapWeights weights_of_pseudo_gap(const OptimalBridgeConfig& config, const MotionLearningState& state,
                                 MotionMemory memory) noexcept {
    GapProblem problem{.n_gap = scored_gap, .n_side = points_a_side(scored_gap), .memory = memory};
    const MotionCovariance covariance = covariance_of(config, state, problem);
    for (int k = 0; k < 2 * problem.n_side; ++k)
        add_point(covariance, problem, place_of(k, problem.n_side, problem.n_gap), Column{});
    return weights(covariance, problem);
}

// Of four blocks the fast memory is weighed after two, the slow one after one.
void weigh(const OptimalBridgeConfig& config, MotionLearningState& state) noexcept {
    const int block = state.moments.n_folded;
    if (state.n_weighed == block) return;
    state.n_weighed = block;
    if (block % 4 == 0) return;
    const MotionMemory memory = block % 2 != 0 ? fast_memory : slow_memory;
    state.scores.weights[memory] = weights_of_pseudo_gap(config, state, memory);
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

// Neighbours share most of their ticks: every second window tells nearly as much as all.
bool is_judged_now(const MotionMomentsState& moments) noexcept { return moments.block.n_windows % 2 == 0; }

}  // namespace

void step(const OptimalBridgeConfig& config, MotionLearningState& state, const MotionTick& tick, bool idle) noexcept {
    if (!config.learns) return;
    // Of the blocks before this tick: one that ends now is work enough.
    if (idle) weigh(config, state);
    MotionTick learnt = tick;
    learnt.usable = tick.usable && is_familiar(config, state, tick);
    const MotionMomentsOutput out = step(MotionMomentsConfig{config.halves}, state.moments, learnt);
    if (out.has_window && is_judged_now(state.moments)) judge(config, state);
}

bool is_ready(const OptimalBridgeConfig& config, const MotionLearningState& state) noexcept {
    return !config.learns || state.moments.moments[fast_memory].n_windows >= enough_windows;
}

MotionCovariance covariance_of(const OptimalBridgeConfig& config, const MotionLearningState& state,
                               const GapProblem& problem) noexcept {
    return {config, state.moments, problem.memory, problem.scale};
}

}  // namespace zlg::core
