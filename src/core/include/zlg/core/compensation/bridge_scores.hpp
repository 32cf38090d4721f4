#pragma once
// How well each way to bridge a gap would have done in recent gaps.
//
// A window of 19 measured ticks holds a gap of 3 ticks that was measured: each candidate bridges it with the 8 ticks on either
// side, and its error is known. Errors are averaged over some 2000 and over 100 windows, and apart from these over 50 that were
// rougher than the learnt motion: a shock, or a motion that begins after rest. Weights come from moments of earlier ticks, so no
// candidate has seen what it is judged by.

#include <array>
#include <span>

#include <zlg/core/compensation/motion_moments.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>

namespace zlg::core {

inline constexpr int scored_gap = 3;

using WindowTicks = std::span<const double, window_ticks>;

enum BridgeCandidate : unsigned { by_fast_memory, by_slow_memory, by_constant, by_quadratic };
inline constexpr unsigned n_candidates = 4;

[[nodiscard]] constexpr bool is_learnt(BridgeCandidate c) noexcept { return c < by_constant; }

struct BridgeScore {
    double loss = 0.0;       // mean square error of the pseudo-gap's angle, arcsec^2
    double predicted = 0.0;  // mean of the variance that was claimed
    double recent_loss = 0.0;
    double rough_loss = 0.0;  // the mean square error in rough windows, which do not count in the others

    friend bool operator==(const BridgeScore&, const BridgeScore&) = default;
};

struct BridgeScoresState {
    std::array<GapWeights, 2> weights{};  // of the two memories
    double n = 0.0, n_rough = 0.0;        // pseudo-gaps so far, up to those of the memory
    std::array<BridgeScore, n_candidates> score{};

    friend bool operator==(const BridgeScoresState&, const BridgeScoresState&) = default;
};

// Mean square of n values about their mean.
[[nodiscard]] double scatter(const double* values, int n) noexcept;

// Points or windows of this scatter were not made by a motion whose ticks scatter by `learnt`.
[[nodiscard]] constexpr bool is_rough(double scatter, double learnt) noexcept { return scatter > 9.0 * learnt; }

// Judge all by one more window of ticks, once both memories have weights.
void step(BridgeScoresState& state, WindowTicks window, bool rough) noexcept;

// True when at least 100 pseudo-gaps have been judged.
[[nodiscard]] bool is_judged(const BridgeScoresState& state) noexcept;

// The memory to be used: the one that lost less, the fast one before 500 pseudo-gaps.
[[nodiscard]] MotionMemory better_memory(const BridgeScoresState& state) noexcept;

// The polynomial to be taken instead of a memory's estimate, if there is one that lost less by a twentieth: in rough
// windows, where the points are rough and enough such windows were seen, else in all others, and in the recent ones as
// well: a change of the motion is learnt long before the old losses are forgotten. Else that memory itself.
[[nodiscard]] BridgeCandidate choose(const BridgeScoresState& state, MotionMemory memory, bool rough) noexcept;

// What a candidate loses in such windows, the worse of all and recent.
[[nodiscard]] double loss_of(const BridgeScoresState& state, BridgeCandidate candidate, bool rough) noexcept;

// Variance over claimed variance of a memory's pseudo-gaps, within 1/8..16; 1 before it is known.
[[nodiscard]] double variance_ratio(const BridgeScoresState& state, MotionMemory memory) noexcept;

}  // namespace zlg::core
