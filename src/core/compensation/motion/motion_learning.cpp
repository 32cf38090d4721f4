#include <zlg/core/compensation/motion_learning.hpp>

#include <array>
#include <span>

namespace zlg::core {
namespace {

constexpr int points_a_tick = 2;

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

void begin_pseudo_gap(MotionMemory memory, GapProblem& problem) noexcept {
    begin_problem(scored_gap, points_a_side(scored_gap), problem);
    problem.memory = memory;
}

void add_points(const OptimalBridgeConfig& config, MotionLearningState& state) noexcept {
    GapProblem& problem = state.problem;
    const MotionCovariance covariance = covariance_of(config, state, problem);
    const int all = 2 * problem.n_side;
    for (int k = 0; k < points_a_tick && problem.factor.n < all && !problem.failed; ++k)
        add_point(covariance, problem, place_of(problem.factor.n, problem.n_side, problem.n_gap), Column{});
}

// Weights of the whole pseudo-gap.
void take_weights(const OptimalBridgeConfig& config, MotionLearningState& state) noexcept {
    state.scores.weights[state.problem.memory] = weights(covariance_of(config, state, state.problem), state.problem);
    state.weighing = false;
}

// Of four blocks the fast memory is weighed after two, the slow one after one.
void begin_weighing(MotionLearningState& state) noexcept {
    const int block = state.moments.n_folded;
    state.n_weighed = block;
    if (block % 4 == 0) return;
    begin_pseudo_gap(block % 2 != 0 ? fast_memory : slow_memory, state.problem);
    state.weighing = true;
}

void weigh(const OptimalBridgeConfig& config, MotionLearningState& state) noexcept {
    if (state.n_weighed != state.moments.n_folded) begin_weighing(state);
    if (!state.weighing) return;
    const GapProblem& problem = state.problem;
    if (problem.failed || problem.factor.n == 2 * problem.n_side) return take_weights(config, state);
    add_points(config, state);
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
    MotionTick learnt = tick;
    learnt.usable = tick.usable && is_familiar(config, state, tick);
    const MotionMomentsOutput out = step(MotionMomentsConfig{config.halves}, state.moments, learnt);
    if (out.has_window && is_judged_now(state.moments)) judge(config, state);
    // A gap takes the problem over, and weights of half of it are none: they are begun anew.
    if (!idle && state.weighing) state.n_weighed = -1;
    if (!idle) state.weighing = false;
    if (idle && !is_folding(state.moments)) weigh(config, state);
}

bool is_ready(const OptimalBridgeConfig& config, const MotionLearningState& state) noexcept {
    return !config.learns || state.moments.moments[fast_memory].n_windows >= enough_windows;
}

void begin_problem(int n_gap, int n_side, GapProblem& problem) noexcept {
    problem.halves = false;
    problem.n_gap = n_gap;
    problem.n_side = n_side;
    problem.memory = fast_memory;
    problem.scale = 1.0;
    problem.failed = false;
    problem.factor.n = 0;
}

MotionCovariance covariance_of(const OptimalBridgeConfig& config, const MotionLearningState& state,
                               const GapProblem& problem) noexcept {
    return {config, state.moments, problem.memory, problem.scale};
}

}  // namespace zlg::core
