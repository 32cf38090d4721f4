#pragma once
// Sequential cross-validation of the candidates that can bridge a gap.
//
// A window of 19 measured ticks x_0..x_18 holds a pseudo-gap, its middle 3 ticks, whose angle S is known. Candidate c
// estimates it from the ticks around as S_c = w_c^T x; its loss is l = (S_c - S)^2. Mean losses follow the recursion
//
//   m <- m + g (l - m),   g = max(1/n, 1/N)      n: losses so far; N: memory
//
// an arithmetic mean up to N losses and an exponential one from there on. N is 2000 for the losses of ordinary windows
// and 100 for the recent ones among them. Rough windows, whose ticks scatter nine times more than the learnt motion (a
// shock, or a motion that begins after rest), have a mean of their own with N = 50. The weights come from moments of
// earlier ticks only, so that no candidate is judged by data that it was fitted to.
//
// Method: one-step-ahead (prequential) validation, Dawid, J. R. Stat. Soc. A 147 (1984).

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
    double loss = 0.0;         // mean square error of the pseudo-gap's angle in ordinary windows, arcsec^2
    double predicted = 0.0;    // mean of the variance that the candidate claimed there, arcsec^2
    double recent_loss = 0.0;  // the mean square error over the last hundred ordinary windows, arcsec^2
    double rough_loss = 0.0;   // the mean square error in rough windows, arcsec^2

    friend bool operator==(const BridgeScore&, const BridgeScore&) = default;
};

struct BridgeScoresState {
    bool by_phase = false;                // the windows have the place within the count
    std::array<GapWeights, 2> weights{};  // of the two memories
    double n = 0.0, n_rough = 0.0;        // ordinary and rough windows so far, each up to its memory
    std::array<BridgeScore, n_candidates> score{};

    friend bool operator==(const BridgeScoresState&, const BridgeScoresState&) = default;
};

// Mean square of n values about their mean.
[[nodiscard]] double scatter(const double* values, int n) noexcept;

// Points or windows of this scatter do not belong to a motion whose ticks scatter by `learnt`: three times its standard
// deviation. The scatter of 19 independent Gaussian ticks has a standard deviation of a third of its mean. By trial on
// bench/accuracy.
[[nodiscard]] constexpr bool is_rough(double scatter, double learnt) noexcept { return scatter > 9.0 * learnt; }

// Score all candidates by one more window of ticks, once both memories have weights.
void step(BridgeScoresState& state, WindowTicks window, bool rough) noexcept;

// True when at least 100 ordinary windows have been judged.
[[nodiscard]] bool is_judged(const BridgeScoresState& state) noexcept;

// The memory with the smaller mean loss; the fast one before 500 windows have been judged, or by phase 100.
[[nodiscard]] MotionMemory better_memory(const BridgeScoresState& state) noexcept;

// The better of the two polynomials if its mean loss is below that of the memory by a factor of 1.05, else the memory
// itself.
//
// rough  the points around the gap are rough: the losses in rough windows are compared, once 5 were seen. Otherwise both
//        the ordinary and the recent losses must agree, because after a change of the motion the moments are learnt long
//        before the old losses are forgotten.
[[nodiscard]] BridgeCandidate choose(const BridgeScoresState& state, MotionMemory memory, bool rough) noexcept;

// Expected loss of a candidate, arcsec^2: the larger of its ordinary, its recent and, for rough points, its rough mean
// loss.
[[nodiscard]] double loss_of(const BridgeScoresState& state, BridgeCandidate candidate, bool rough) noexcept;

// Ratio of the actual to the claimed variance of a memory's pseudo-gaps, within 1/8..16; 1 before 100 windows. It
// calibrates the covariance of the motion.
[[nodiscard]] double variance_ratio(const BridgeScoresState& state, MotionMemory memory) noexcept;

}  // namespace zlg::core
