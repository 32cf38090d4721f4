#include "gap_estimate.hpp"

#include <memory>

#include <zlg/core/common/maths.hpp>

#include "gap_interpolation.hpp"
#include "gap_points.hpp"
#include "gap_rounding.hpp"

namespace zlg::core {
namespace {

// A prediction whose points lie this far out, in units of their variance, is worth less than a polynomial.
constexpr double foreign_motion = 9.0;

// Some 15 points that fit scatter their misfit by .4.
constexpr double certain_misfit = 1.4;

// The mean of one on each side.
constexpr int fewest_points = 2;

// A longer gap is estimated from whole ticks: half-ticks would take too long.
constexpr int longest_joint_gap = 8;

// What the variance of an estimate is to be multiplied by where the points do not fit.
double inflation(double scale, double innovation_ratio) noexcept {
    // The angle may be known better than the points: that alone is no misfit.
    const double ratio = innovation_ratio * (scale < 1.0 ? scale : 1.0);
    return ratio > 1.0 ? ratio : 1.0;
}

// The variance of the whole switch, if all was as it was learnt. What was added to the moments of the counter's rounding is
// scaled with them here.
double learnt_variance(const GapProblem& problem, const GapEstimate& found, const RoundingSums& rounding) noexcept {
    const double too_much = problem.scale < 1.0 ? (1.0 - problem.scale) * learnt_rounding_part : 0.0;
    return found.sum_variance_arcsec2 - too_much * rounding.white_arcsec2;
}

// The recent motion.
template <std::size_t capacity>
void presume(const BridgeScoresState& scores, GapProblemOf<capacity>& problem) noexcept {
    problem.memory = better_memory(scores);
    problem.scale = variance_ratio(scores, problem.memory);
}

void begin(GapBridgeState& state, const Gap& gap, bool halves) noexcept {
    // In place: a state that is assigned would stand on the stack first.
    EstimatedGap& e = *std::construct_at(&state.estimate);
    e.first_tick = gap.first_tick;
    e.end_tick = gap.first_tick + gap.n;
    e.problem.n_gap = static_cast<int>(gap.n);
    e.problem.n_side = points_a_side(e.problem.n_gap);
    e.problem.halves = halves;
    presume(state.learning.scores, e.problem);
}

bool is_solvable(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap) noexcept {
    return gap.n <= max_solved_gap && gap.has_before && is_ready(config.optimal, state.learning);
}

// The profile of the detuning after a gap: not there yet, of use, or given up.
bool is_profile_of(const GapBridgeState& state, const Gap& gap) noexcept {
    return state.joint.first_tick == gap.first_tick + gap.n;
}

bool is_given_up(const GapBridgeState& state, const Gap& gap) noexcept {
    return is_profile_of(state, gap) && !state.joint.known;
}

// Begin the problem of a gap, or begin it anew with whole ticks.
void begin_or_change(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, bool at_end) noexcept {
    const bool wanted = config.optimal.halves && gap.n <= longest_joint_gap && !is_given_up(state, gap) &&
                        (!at_end || is_profile_of(state, gap));
    const bool begun = state.estimate.first_tick == gap.first_tick;
    if (!begun || (state.estimate.problem.halves && !wanted)) begin(state, gap, wanted);
}

// Add points of ticks before `end`, then solve, as far as `work` goes: a point is 1, a stage of ticks 1, of half-ticks 2.
//
// last  no more points will come.
void work_on(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, int work, std::int64_t end,
             bool last) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    const MotionCovariance covariance = covariance_of(config.optimal, state.learning, problem);
    for (; work > 0 && e.n_tried < n_places(problem) && tick_of(e, problem, e.n_tried) < end; --work) {
        if (problem.halves && is_after(e, problem, e.n_tried) && !is_profile_of(state, gap)) return;
        try_point(covariance, state);
    }
    if (problem.failed || (e.n_tried < n_places(problem) && !last)) return;
    for (; work > 0 && !e.solution.done; work -= stride_of(problem)) {
        if (e.solving)
            advance(covariance, problem, e.data, e.solution);
        else
            begin_solution(state);
    }
}

// The error of a polynomial grows with the length of the gap: as n(n+2)(n+4), or with all factors n..n+4.
double growth(int order, std::int64_t gap_ticks) noexcept {
    const auto factor = [order](double n) {
        return order == 0 ? n * (n + 2.0) * (n + 4.0) : n * (n + 1.0) * (n + 2.0) * (n + 3.0) * (n + 4.0);
    };
    const double ratio = factor(static_cast<double>(gap_ticks)) / factor(scored_gap);
    return ratio * ratio;
}

void apply_to_gap(const GapEstimate& found, double scale, AngleRow& row, unsigned j) noexcept {
    row.dtheta_final_arcsec = found.value_arcsec[j];
    row.sigma_arcsec = deviation(scale * found.variance_arcsec2[j]);
    row.flags = (row.flags & ~(std::uint32_t{flag_unrepaired} | flag_lower_order)) | flag_interpolated;
}

// scale     of all variances of ticks.
// variance  of the whole angle.
void apply(GapBridgeState& state, const Gap& gap, const GapEstimate& found, double scale, double variance,
           EstimatedAngle& out) noexcept {
    for (unsigned j = 0; j < static_cast<unsigned>(gap.n); ++j) {
        AngleRow& row = at(state, gap.first_tick + j).row;
        apply_to_gap(found, scale, row, j);
        out.gap_arcsec.add(row.dtheta_final_arcsec);
        out.gap_arcsec.add(-row.dtheta_arcsec);
    }
    if (state.estimate.problem.halves)
        correct_halves(state, found, out.after_arcsec);
    else
        correct_ticks(state, found, out.after_arcsec);
    out.known = true;
    out.sigma_sum_arcsec = deviation(variance);
}

// Of the false angle in the ticks after a gap, as a polynomial takes them.
double relock_variance(const GapBridgeState& state, const Gap& gap) noexcept {
    double sum = 0.0;
    for (int k = 0; k < max_points_a_side; ++k) {
        const HistoryTick& tick = at(state, gap.first_tick + gap.n + k);
        if (tick.measured && tick.row.tick == gap.first_tick + gap.n + k) sum += tick.relock_variance_arcsec2;
    }
    return sum;
}

// True where a polynomial does better for such points: it has lost less, and would lose less with this re-lock.
//
// variance  claimed by the estimate.
bool choose_polynomial(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, std::int64_t end,
                       const RoundingLaw& law, double variance, double misfit, EstimatedAngle& out) noexcept {
    const MotionLearningState& learning = state.learning;
    const bool rough = is_rough(scatter_of_points(state), learning.moments.moments[fast_memory].scatter);
    const BridgeCandidate choice = choose(learning.scores, state.estimate.problem.memory, rough);
    if (is_learnt(choice)) return false;
    // A line has the angle of a constant, and in a ramp the right ticks too.
    const int order = choice == by_constant ? 1 : 2;
    const PolynomialFit fit = fit_of(config, state, gap, end, order);
    const RoundingSums rounding = rounding_of_fit(config, state, gap, fit, law);
    // It knows of a misfit no more than the estimate does.
    const double usual = loss_of(learning.scores, choice, rough);
    const double grown = growth(order == 1 ? 0 : 2, gap.n);
    const double relock = relock_variance(state, gap);
    const double lost = motion_in(usual, rounding_of_score(choice, law));
    const double expected = misfit * (lost * grown + relock) + rounding.broken_arcsec2;
    const double unexpected = (misfit - 1.0) * (usual * grown + relock);
    const double claimed = unexpected > expected ? unexpected : expected;
    if (!(claimed < variance)) return false;
    out.order = order;
    out.polynomial_variance_arcsec2 = claimed;
    return true;
}

}  // namespace

int order_in_place(const GapBridgeConfig& config, const GapBridgeState& state) noexcept {
    if (config.method != BridgeMethod::automatic || !is_judged(state.learning.scores)) return order_of(config.method);
    const auto& score = state.learning.scores.score;
    return score[by_constant].loss < score[by_quadratic].loss ? 0 : 2;
}

void predict_gap(const GapBridgeConfig& config, GapBridgeState& state, std::int64_t tick) noexcept {
    if (!is_ready(config.optimal, state.learning)) return;
    PredictionProblem problem{.n_gap = predicted_ticks, .n_side = max_points_a_side};
    presume(state.learning.scores, problem);
    const MotionCovariance covariance{config.optimal, state.learning.moments, problem.memory, problem.scale};
    const PredictionData data = points_before(covariance, state, tick, problem);
    if (problem.failed || problem.factor.n < fewest_points) return;
    // Of the stages those of the single ticks.
    GapSolutionOf<few_unknowns> solution;
    while (!solution.done && solution.stage < 2 + predicted_ticks) advance(covariance, problem, data, solution);
    const GapEstimateOf<few_unknowns>& found = solution.estimate;
    if (solution.done || !(found.innovation_ratio <= foreign_motion)) return;
    const double scale = inflation(problem.scale, found.innovation_ratio);
    state.prediction.first_tick = tick;
    for (unsigned j = 0; j < max_gap_ticks; ++j) {
        // The motion is forgotten by then, but for its mean.
        const bool far = j >= predicted_ticks;
        state.prediction.value_arcsec[j] = far ? data.level + solution.rate : found.value_arcsec[j];
        state.prediction.variance_arcsec2[j] =
            scale * (far ? covariance.of_ticks(0, 0) + 1.0 / solution.rates.information : found.variance_arcsec2[j]);
    }
}

namespace {

// Ticks before this one will not be amended any more: the first after a gap may be by the next.
std::int64_t end_of_amended(const GapBridgeState& state) noexcept {
    const std::int64_t last = state.next_tick - 1;
    return last > 0 && at(state, last - 1).measured ? last + 1 : last;
}

// Of one half: all 32 half-ticks are solved in ten.
constexpr int work_a_half = 6;

}  // namespace

void advance_estimate(const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    const PendingGap* waiting = nullptr;
    for (int k = 0; k < state.n_pending && waiting == nullptr; ++k)
        if (!state.pending[static_cast<unsigned>(k)].resolved) waiting = &state.pending[static_cast<unsigned>(k)];
    if (waiting == nullptr || !is_solvable(config, state, waiting->gap)) return;
    begin_or_change(config, state, waiting->gap, false);
    work_on(config, state, waiting->gap, work_a_half, end_of_amended(state), false);
}

EstimatedAngle estimate(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, std::int64_t end,
                        int work) noexcept {
    EstimatedAngle out{.order = order_in_place(config, state)};
    if (!is_solvable(config, state, gap)) return out;
    begin_or_change(config, state, gap, true);
    work_on(config, state, gap, work, end, true);
    const GapProblem& problem = state.estimate.problem;
    if (problem.factor.n < fewest_points) return out;
    const GapEstimate& found = state.estimate.solution.estimate;
    if (!found.known) return out;
    out.has_history = true;
    learn_scale(state);
    const double misfit = inflation(problem.scale, found.innovation_ratio);
    double variance = misfit * found.sum_variance_arcsec2;
    const RoundingLaw law = law_of(config, state, problem.halves);
    if (config.optimal.learns) {
        const RoundingSums rounding = rounding_of_estimate(state, gap, law);
        const double expected =
            misfit * motion_in(learnt_variance(problem, found, rounding), rounding) + rounding.broken_arcsec2;
        // Beyond chance, what does not fit is as large as all that was expected, whatever of that is the counter's.
        const double unexpected = misfit > certain_misfit ? variance : 0.0;
        variance = unexpected > expected ? unexpected : expected;
    }
    if (config.method == BridgeMethod::automatic &&
        choose_polynomial(config, state, gap, end, problem.halves ? of_whole_ticks(law) : law, variance, misfit, out))
        return out;
    apply(state, gap, found, misfit, variance, out);
    return out;
}

void learn(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& tick, bool idle) noexcept {
    const double value = tick.value_arcsec;
    MotionTick motion{.usable = tick.measured && tick.settled && is_finite(tick.variance_arcsec2), .first = value};
    if (config.optimal.halves) {
        motion.first = 0.5 * (value + tick.half_excess_arcsec);
        motion.second = 0.5 * (value - tick.half_excess_arcsec);
    }
    step(config.optimal, state.learning, motion, idle);
}

bool needs_profile(const GapBridgeState& state) noexcept {
    for (int k = 0; k < state.n_pending; ++k) {
        const PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (!pending.resolved && is_profile_of(state, pending.gap)) return true;
    }
    return false;
}

}  // namespace zlg::core
