#pragma once
// Learning of the motion between gaps: its second moments (motion_moments) and the scores of the ways to bridge a gap
// (bridge_scores), with the optimal weights of a pseudo-gap (optimal_bridge) in between.
//
//   tick -> outlier gate -> moments -> weights, after each block -> score, every second window
//
// Weights are computed for one memory after a block, in a tick in which no gap waits for its estimate: never two
// expensive steps in one tick.
//
// Outlier gate: a tick whose square, about the level, is beyond 10^4 times the learnt variance (100 standard deviations)
// plus the square of a count is not learnt, because its square would dominate the moments for minutes. A level counts such
// ticks, +8 for each and -1 for any other; from 128 on, 16 outliers in a row, they are learnt as a new motion.

#include <zlg/core/compensation/bridge_scores.hpp>
#include <zlg/core/compensation/motion_moments.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>

namespace zlg::core {

struct MotionLearningState {
    int n_weighed = 0;      // blocks in the moments when weights were last due
    int outlier_level = 0;  // of the outlier gate, 0..135
    BridgeScoresState scores{};
    MotionMomentsState moments{};

    friend bool operator==(const MotionLearningState&, const MotionLearningState&) = default;
};

// Learn from one tick.
//
// tick  usable: measured, with final values.
// idle  no gap lasts or waits: there is time for weights.
// cost  beside that of the moments: the weights of a pseudo-gap, where a block has ended.
void step(const CompensationConstants& gyro, const OptimalBridgeConfig& config, MotionLearningState& state,
          const MotionTick& tick, bool idle) noexcept;

// The moments hold at least 50 windows, or the prior is given.
[[nodiscard]] bool is_ready(const OptimalBridgeConfig& config, const MotionLearningState& state) noexcept;

// The covariance of the motion that a problem presumes.
template <std::size_t capacity>
[[nodiscard]] MotionCovariance covariance_of(const CompensationConstants& gyro, const OptimalBridgeConfig& config,
                                             const MotionLearningState& state,
                                             const GapProblemOf<capacity>& problem) noexcept {
    return {gyro, config, state.moments, problem.memory, problem.scale, problem.with_phase};
}

// Place of the k-th of the points around a gap, in ticks from the start of the window.
[[nodiscard]] constexpr int place_of(int k, int n_side, int n_gap) noexcept { return k < n_side ? k : k + n_gap; }

}  // namespace zlg::core
