#include <zlg/core/compensation/bridge_scores.hpp>

namespace zlg::core {
namespace {

// Memories N of the mean losses, in windows; every second tick ends a window that is scored. 2000 are the 4000 ticks
// over which the trials on recorded motion scored the memories (results: docs/accuracy_campaign.md, (e)); the mean square of N
// independent Gaussian errors has a standard error of sqrt(2/N): 3 %. The two short ones (14 and 20 %) notice a change
// of the motion within a second; they were chosen by trial on bench/accuracy.
constexpr double memory = 2000.0;
constexpr double recent_memory = 100.0;
constexpr double rough_memory = 50.0;

// Windows before a mean loss is used. Rough windows are rare, so that few must do. By trial on bench/accuracy.
constexpr double min_scores = 100.0;
constexpr double min_rough_scores = 5.0;

// The slow memory has next to no prior (0.002 windows), so that its first weights are poor. By phase the prior of the fast
// one, 20 arcsec^2 beside a tone of 12 000 arcsec/s, is thousands of times the noise of a reading, and already the first weights of the
// slow one are better than that allows. By trial on bench/accuracy.
constexpr double min_scores_for_slow(const BridgeScoresState& state) noexcept {
    return state.by_phase ? min_scores : 500.0;
}

// A polynomial has no model of the motion: it must win by more than the standard error of a mean loss. By trial on
// bench/accuracy.
constexpr double polynomial_handicap = 1.05;

// Limits of the calibration of the claimed variance, so that no run of odd windows makes the covariance meaningless. By
// trial on bench/accuracy.
constexpr double min_ratio = 0.125;
constexpr double max_ratio = 16.0;

constexpr int side = points_a_side(scored_gap);
constexpr int after = side + scored_gap;

// w^T x over the points: 8 ticks before the pseudo-gap and 8 after it.
double learnt_angle(const Column& weight, WindowTicks x) noexcept {
    double sum = 0.0;
#pragma GCC unroll 8
    for (unsigned k = 0; k < side; ++k) sum += weight[k] * x[k];
#pragma GCC unroll 8
    for (unsigned k = 0; k < side; ++k) sum += weight[side + k] * x[after + k];
    return sum;
}

}  // namespace

double scatter(const double* values, int n) noexcept {
    double sum = 0.0;
    double squares = 0.0;
#pragma GCC unroll 4
    for (int k = 0; k < n; ++k) {
        sum += values[k];
        squares += values[k] * values[k];
    }
    const double about_mean = squares / n - (sum / n) * (sum / n);
    return about_mean > 0.0 ? about_mean : 0.0;
}

void step(BridgeScoresState& state, WindowTicks x, bool rough) noexcept {
    if (!state.weights[fast_memory].known || !state.weights[slow_memory].known) return;
    // The angle S of the pseudo-gap, and its estimates. The polynomials use two ticks a side, eq (15): of order 0 their
    // sum has the weights 3/4 four times, of order 2 -1, 5/2, 5/2, -1.
    const double truth = x[side] + x[side + 1] + x[side + 2];
    const double inner = x[side - 1] + x[after];
    const double outer = x[side - 2] + x[after + 1];
    const std::array<double, n_candidates> angle{learnt_angle(state.weights[fast_memory].weight, x),
                                                 learnt_angle(state.weights[slow_memory].weight, x),
                                                 0.75 * (inner + outer), 2.5 * inner - outer};
    // The recursion of the mean losses.
    double& n = rough ? state.n_rough : state.n;
    if (n < (rough ? rough_memory : memory)) n += 1.0;
    const double part = 1.0 / n;
    const double recent_part = n < recent_memory ? part : 1.0 / recent_memory;
    for (unsigned c = 0; c < n_candidates; ++c) {
        BridgeScore& score = state.score[c];
        const double loss = (angle[c] - truth) * (angle[c] - truth);
        if (rough) {
            score.rough_loss += part * (loss - score.rough_loss);
            continue;
        }
        score.loss += part * (loss - score.loss);
        score.recent_loss += recent_part * (loss - score.recent_loss);
        if (c >= state.weights.size()) continue;
        // After a shock the moments, and with them the claimed variance, are huge: at most 8 times the mean loss is
        // counted, or the shock would be remembered for minutes.
        const double most = score.loss / min_ratio;
        const double claimed = state.weights[c].variance_arcsec2;
        score.predicted += part * ((claimed < most || !(most > 0.0) ? claimed : most) - score.predicted);
    }
}

bool is_judged(const BridgeScoresState& state) noexcept { return state.n >= min_scores; }

MotionMemory better_memory(const BridgeScoresState& state) noexcept {
    return state.n >= min_scores_for_slow(state) && state.score[by_slow_memory].loss < state.score[by_fast_memory].loss
               ? slow_memory
               : fast_memory;
}

BridgeCandidate choose(const BridgeScoresState& state, MotionMemory memory_used, bool rough) noexcept {
    const auto learnt = static_cast<BridgeCandidate>(memory_used);
    if (!is_judged(state)) return learnt;
    const auto better = [&](double BridgeScore::*loss) {
        const BridgeCandidate fit =
            state.score[by_quadratic].*loss < state.score[by_constant].*loss ? by_quadratic : by_constant;
        return polynomial_handicap * state.score[fit].*loss < state.score[learnt].*loss ? fit : learnt;
    };
    if (rough && state.n_rough >= min_rough_scores) return better(&BridgeScore::rough_loss);
    return is_learnt(better(&BridgeScore::recent_loss)) ? learnt : better(&BridgeScore::loss);
}

double loss_of(const BridgeScoresState& state, BridgeCandidate candidate, bool rough) noexcept {
    const BridgeScore& score = state.score[candidate];
    const double usual = score.recent_loss > score.loss ? score.recent_loss : score.loss;
    return rough && score.rough_loss > usual ? score.rough_loss : usual;
}

double variance_ratio(const BridgeScoresState& state, MotionMemory memory_used) noexcept {
    const BridgeScore& score = state.score[memory_used];
    if (!is_judged(state) || !(score.predicted > 0.0)) return 1.0;
    const double ratio = score.loss / score.predicted;
    return ratio < min_ratio ? min_ratio : ratio > max_ratio ? max_ratio : ratio;
}

}  // namespace zlg::core
