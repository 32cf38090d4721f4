#pragma once
// What is learnt of the motion between gaps: its moments, and how well each way to bridge a gap would have done.
//
// After a block of the moments the weights of a pseudo-gap are computed anew for one of the memories, in a tick in which no gap
// waits for its estimate.

#include <cstdint>

#include <zlg/core/compensation/bridge_scores.hpp>
#include <zlg/core/compensation/motion_moments.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>

namespace zlg::core {

struct MotionLearningState {
    MotionMomentsState moments{};
    BridgeScoresState scores{};
    int n_weighed = 0;  // blocks in the moments when the last weights were computed
    int foreign = 0;    // recent ticks that were no such motion, weighted

    friend bool operator==(const MotionLearningState&, const MotionLearningState&) = default;
};

// Take one tick.
//
// tick  usable: measured, with final values.
// idle  no gap lasts or waits: there is time for weights.
// cost  beside that of the moments: the weights of a pseudo-gap, where a block has ended.
void step(const OptimalBridgeConfig& config, MotionLearningState& state, const MotionTick& tick, bool idle) noexcept;

// The moments hold enough windows to be believed, or the prior is given.
[[nodiscard]] bool is_ready(const OptimalBridgeConfig& config, const MotionLearningState& state) noexcept;

// The covariance that a problem presumes.
[[nodiscard]] MotionCovariance covariance_of(const OptimalBridgeConfig& config, const MotionLearningState& state,
                                             const GapProblem& problem) noexcept;

// Place of the k-th of the points around a gap, in ticks from the start of the window.
[[nodiscard]] constexpr int place_of(int k, int n_side, int n_gap) noexcept { return k < n_side ? k : k + n_gap; }

}  // namespace zlg::core
