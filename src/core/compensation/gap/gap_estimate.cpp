#include "gap_estimate.hpp"

#include <memory>

#include <zlg/core/common/maths.hpp>

#include "gap_final.hpp"
#include "gap_first.hpp"
#include "gap_interpolation.hpp"
#include "gap_points.hpp"
#include "gap_rounding.hpp"

namespace zlg::core {
namespace {

// Innovation ratio q beyond which a prediction is worth less than a polynomial: points three standard deviations off
// the learnt motion. By trial on bench/accuracy.
constexpr double max_prediction_innovation = 9.0;

// Misfit beyond chance: q of 15 degrees of freedom has a standard deviation of sqrt(2/15) = 0.37.
constexpr double certain_misfit = 1.4;

// A mean needs one on each side.
constexpr int min_points = 2;

// A longer gap is estimated from whole ticks: the stages of half-ticks would not be ready in time.
constexpr int max_joint_gap = 8;

// Before pseudo-gaps have judged the covariance, the points beside the gap do: the smooth prior is then a large part of
// it, and a motion that it does not describe is learnt with far too much uncertainty. A ratio q < 1 with n degrees of freedom
// is averaged with 1, which weighs as `presumed_freedom` degrees. By trial on first gaps 70 to 300 ticks after the start.
constexpr double presumed_freedom = 1.0;

double deflation(const GapProblem& problem, double innovation_ratio) noexcept {
    const int freedom = problem.factor.n - (problem.halves ? 3 : 1);
    return innovation_ratio < 1.0 ? (presumed_freedom + freedom * innovation_ratio) / (presumed_freedom + freedom)
                                  : 1.0;
}

// var of (2). The part of the rounding that is added to the moments is not scaled with them; here the excess is
// subtracted.
double learnt_variance(const GapProblem& problem, const GapEstimate& found, const RoundingSums& rounding) noexcept {
    const double too_much = problem.scale < 1.0 ? (1.0 - problem.scale) * learnt_rounding_part : 0.0;
    return found.sum_variance_arcsec2 - too_much * rounding.white_arcsec2;
}

// The memory and the calibration of the recent motion, and how it is read; fixed when the problem begins.
template <std::size_t capacity>
void presume(const MotionLearningState& learning, GapProblemOf<capacity>& problem) noexcept {
    problem.memory = better_memory(learning.scores);
    problem.scale = variance_ratio(learning.scores, problem.memory);
    problem.with_phase = learning.moments.with_phase;
}

// The motion was known when the problem of this gap began, or is now.
bool is_learnt(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap) noexcept {
    const EstimatedGap& e = state.estimate;
    return e.first_tick == gap.first_tick ? e.learnt : is_ready(config.optimal, state.learning);
}

void begin(GapBridgeState& state, const Gap& gap, bool halves, bool learnt) noexcept {
    // In place: a state that is assigned would stand on the stack first.
    EstimatedGap& e = *std::construct_at(&state.estimate);
    e.first_tick = gap.first_tick;
    e.end_tick = gap.first_tick + gap.n;
    e.problem.n_gap = static_cast<int>(gap.n);
    e.problem.n_side = points_before_gap(e.problem.n_gap);
    e.n_after = points_a_side(e.problem.n_gap);
    e.problem.halves = halves;
    e.learnt = learnt;
    e.magnetic_arcsec = state.magnetic_arcsec;
    const bool steps = at(state, e.end_tick).row.mode != gap.mode_before;
    e.magnetic_variance_arcsec2 = steps ? state.magnetic_variance_arcsec2 : 0.0;
    if (learnt) {
        presume(state.learning, e.problem);
        take_lit_halves(state);
        return;
    }
    if (e.problem.n_side > points_beside_first) e.problem.n_side = points_beside_first;
    if (e.n_after > points_beside_first) e.n_after = points_beside_first;
    e.problem.with_phase = is_read_by_phase(state, gap);
}

bool is_solvable(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap) noexcept {
    return gap.n <= max_solved_gap && (gap.has_before || !is_learnt(config, state, gap));
}

// The profile of the detuning after a gap: not there yet, known, or given up.
bool is_given_up(const GapBridgeState& state, const Gap& gap) noexcept {
    return is_profile_of(state, gap) && !state.joint.known;
}

// Begin the problem of a gap, or begin it anew with whole ticks.
void begin_or_change(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, bool at_end) noexcept {
    const bool learnt = is_learnt(config, state, gap);
    // In a re-lock the halves before the gap hold a bias that still grows: together they are a tick, of which that is corrected.
    const bool settled = gap.first_tick - points_before_gap(static_cast<int>(gap.n)) >= gap.settled_tick;
    const bool wanted = config.optimal.halves && learnt && settled && gap.n <= max_joint_gap &&
                        !is_given_up(state, gap) && (!at_end || is_profile_of(state, gap));
    const bool begun = state.estimate.first_tick == gap.first_tick;
    if (!begun || (state.estimate.problem.halves && !wanted)) begin(state, gap, wanted, learnt);
}

// Of the gap whose problem grows.
MotionCovariance covariance_of(const CompensationConstants& gyro, const GapBridgeConfig& config,
                               const GapBridgeState& state) noexcept {
    const EstimatedGap& e = state.estimate;
    return covariance_of(gyro, e.learnt ? config.optimal : readings_alone, state.learning, e.problem);
}

// Add points of ticks before `end`, then solve, as far as `work` goes: a point is 1, a stage of ticks 1, of half-ticks
// 2.
//
// last    no more points will come.
// return  work that is left.
int work_on(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap,
            int work, std::int64_t end, bool last) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    const MotionCovariance covariance = covariance_of(gyro, config, state);
    for (; work > 0 && e.n_tried < n_places(e, problem) && tick_of(e, problem, e.n_tried) < end; --work) {
        if (problem.halves && is_after(e, problem, e.n_tried) && !is_profile_of(state, gap)) return 0;
        try_point(covariance, state);
    }
    if (problem.failed || (e.n_tried < n_places(e, problem) && !last)) return 0;
    for (; work > 0 && !e.solution.done; work -= stride_of(problem)) {
        if (e.solving)
            advance(covariance, problem, e.data, e.solution);
        else
            begin_solution(state);
    }
    return work;
}

// Of the points of a mixture, in thousands of instructions.
constexpr int cost_of_points = 10;

// The mixture, once the estimate by the learnt motion is there, as far as `work` goes.
//
// work  in thousands of instructions.
void work_on_mixture(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                     int work) noexcept {
    EstimatedGap& e = state.estimate;
    if (!config.optimal.learns || !e.solution.estimate.known || is_done(e.mixture)) return;
    const MotionCovariance covariance = covariance_of(gyro, config, state);
    if (!e.mixing && work >= cost_of_points) {
        begin_mixture(covariance, state);
        work -= cost_of_points;
    }
    while (e.mixing && !is_done(e.mixture)) {
        work -= cost_of_stage(e.mixture);
        if (work < 0) return;
        advance(covariance, e.mixture);
    }
}

// Stages of a solution: the rates, the points, each tick of the gap, the sum, the probe.
int n_stages(const GapProblem& problem) noexcept { return problem.n_gap + 4; }

// `work` suffices for the points before `end` and for the solution, in the measure of work_on.
bool can_finish(const EstimatedGap& e, std::int64_t end, int work) noexcept {
    if (e.solution.done) return true;
    const GapProblem& problem = e.problem;
    for (int k = e.n_tried; k < n_places(e, problem) && tick_of(e, problem, k) < end; ++k) --work;
    const int stages = n_stages(problem) - e.solution.stage + (e.solving ? 0 : 1);
    return work > stride_of(problem) * (stages - 1);
}

// Ratio of the mean square error of a polynomial in a gap of n ticks to that in the pseudo-gap of 3. Leading terms for
// a motion of angular frequency w, eq (15) with two points a side: order 0 (w T)^2 n(n+2)(n+4)/12, order 2 (w T)^4
// n(n+1)..(n+4)/720.
double growth(int order, std::int64_t gap_ticks) noexcept {
    const auto factor = [order](double n) {
        return order == 0 ? n * (n + 2.0) * (n + 4.0) : n * (n + 1.0) * (n + 2.0) * (n + 3.0) * (n + 4.0);
    };
    const double ratio = factor(static_cast<double>(gap_ticks)) / factor(scored_gap);
    return ratio * ratio;
}

// Variance of the re-lock correction in the ticks after a gap, which a polynomial uses as they are.
double relock_variance(const GapBridgeState& state, const Gap& gap) noexcept {
    double sum = 0.0;
    for (int k = 0; k < max_points_a_side; ++k) {
        const HistoryTick& tick = at(state, gap.first_tick + gap.n + k);
        if (tick.measured && tick.row.tick == gap.first_tick + gap.n + k) sum += tick.relock_variance_arcsec2;
    }
    return sum;
}

// True where a polynomial does better for these points: its mean loss is smaller (bridge_scores), and so is the
// variance expected for this gap, its loss scaled to the length of the gap, with re-lock and rounding.
//
// variance  that the estimate claims.
bool choose_polynomial(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, std::int64_t end,
                       const RoundingLaw& law, double variance, double misfit, EstimatedAngle& out) noexcept {
    const MotionLearningState& learning = state.learning;
    const bool rough = is_rough(scatter_of_points(state), learning.moments.moments[fast_memory].scatter);
    const BridgeCandidate choice = choose(learning.scores, state.estimate.problem.memory, rough);
    if (is_learnt(choice)) return false;
    // The fit of order 1 has the same sum over the gap as that of order 0, and in a ramp the right ticks too.
    const int order = choice == by_constant ? 1 : 2;
    const PolynomialFit fit = fit_of(config, state, gap, end, order);
    const RoundingSums rounding = rounding_of_fit(config, state, gap, fit, law);
    // The misfit of the points applies to the polynomial's losses as well.
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

void predict_gap(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                 std::int64_t tick) noexcept {
    if (!is_ready(config.optimal, state.learning)) return;
    PredictionProblem problem{.n_gap = predicted_ticks, .n_side = max_points_a_side};
    presume(state.learning, problem);
    const MotionCovariance covariance = covariance_of(gyro, config.optimal, state.learning, problem);
    const PredictionData data = points_before(covariance, state, tick, problem);
    if (problem.failed || problem.factor.n < min_points) return;
    // Only the stages of the single ticks are needed.
    GapSolutionOf<few_unknowns> solution;
    while (!solution.done && solution.stage < 2 + predicted_ticks) advance(covariance, problem, data, solution);
    const GapEstimateOf<few_unknowns>& found = solution.estimate;
    if (solution.done || !(found.innovation_ratio <= max_prediction_innovation)) return;
    const double scale = inflation(problem.scale, found.innovation_ratio);
    state.prediction.first_tick = tick;
    for (unsigned j = 0; j < max_gap_ticks; ++j) {
        // Farther on only the mean rate is known: variance of a tick about it, and that of the mean.
        const bool far = j >= predicted_ticks;
        state.prediction.value_arcsec[j] = far ? data.level + solution.rate : found.value_arcsec[j];
        state.prediction.variance_arcsec2[j] =
            scale * (far ? covariance.of_ticks(0, 0) + 1.0 / solution.rates.information : found.variance_arcsec2[j]);
    }
}

namespace {

// Ticks before this one are final: the first tick after a gap may still be amended by the next.
std::int64_t end_of_amended(const GapBridgeState& state) noexcept {
    const std::int64_t last = state.next_tick - 1;
    return last > 0 && at(state, last - 1).measured ? last + 1 : last;
}

// In thousands of instructions: what an estimate may cost in a half, and each point or stage of it.
constexpr int most_of_half = 50;
constexpr int cost_of_work = 6;
constexpr int cost_of_most_points = 7;  // with lit halves beside all others
constexpr int most_of_mixture = 1000;

// Points and stages of a first gap.
constexpr int work_of_first = 2 * points_beside_first + max_solved_gap + 5;

}  // namespace

void advance_estimate(const CompensationConstants& gyro, const GapBridgeConfig& config,
                      GapBridgeState& state) noexcept {
    const PendingGap* waiting = nullptr;
    for (int k = 0; k < state.n_pending && waiting == nullptr; ++k)
        if (!state.pending[static_cast<unsigned>(k)].resolved) waiting = &state.pending[static_cast<unsigned>(k)];
    if (waiting == nullptr || !is_solvable(config, state, waiting->gap)) return;
    begin_or_change(config, state, waiting->gap, false);
    const int left = work_on(gyro, config, state, waiting->gap, work_a_half, end_of_amended(state), false);
    // While another gap lasts or waits, or the re-lock after this one is watched, a half-period has less time.
    const bool is_watched = state.next_tick <= waiting->gap.first_tick + waiting->gap.n + max_points_a_side;
    if (is_watched || state.gap.open || state.n_pending > 1) return;
    const int cost = state.estimate.lit.n > 0 ? cost_of_most_points : cost_of_work;
    work_on_mixture(gyro, config, state, most_of_half - cost * (work_a_half - left));
}

EstimatedAngle estimate(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                        const Gap& gap, std::int64_t end, int work) noexcept {
    EstimatedAngle out{.order = order_in_place(config, state)};
    if (!is_solvable(config, state, gap)) return out;
    begin_or_change(config, state, gap, true);
    // An estimate that would stay unfinished is not continued: the polynomial that takes its place costs as much.
    if (state.estimate.learnt && !can_finish(state.estimate, end, work)) return out;
    // The tick that needs the estimate has no time for the mixture, the end of a log has. The few points of a first gap are
    // solved in any case.
    const int more = state.estimate.learnt ? 0 : work_of_first;
    if (work_on(gyro, config, state, gap, work + more, end, true) > work_a_half + more)
        work_on_mixture(gyro, config, state, most_of_mixture);
    const GapProblem& problem = state.estimate.problem;
    if (problem.factor.n < min_points) return out;
    GapEstimate& found = state.estimate.solution.estimate;
    if (!found.known) return out;
    double misfit = inflation(problem.scale, found.innovation_ratio);
    if (!state.estimate.learnt) return first_angle(gyro, config, state, gap, end, misfit);
    if (config.optimal.learns && !is_judged(state.learning.scores))
        misfit *= deflation(problem, found.innovation_ratio);
    out.has_history = true;
    const bool something = finds_something(state.estimate.mixture);
    // A switch beside a manoeuvre says nothing of the gyro.
    if (!something && !problem.with_phase) learn_scale(state);
    const double of_sum = misfit * found.sum_variance_arcsec2;
    double variance = of_sum;
    const RoundingLaw law = law_of(gyro, config, state, problem.halves, problem.with_phase);
    if (config.optimal.learns) {
        const RoundingSums rounding = rounding_of_estimate(state, gap, law);
        const double expected =
            misfit * motion_in(learnt_variance(problem, found, rounding), rounding) + rounding.broken_arcsec2;
        // (2). Beyond chance the excess is scaled from the whole variance, rounding included.
        const double unexpected = misfit > certain_misfit ? variance : 0.0;
        variance = unexpected > expected ? unexpected : expected;
    }
    if (misfit > certain_misfit)  // inflated like the variance of the sum
        for (double& x : found.variance_arcsec2) x *= misfit;
    else
        take_out_own_rounding(state, law, config.optimal.learns, misfit, found);
    // The points end before the re-lock does.
    const double beyond = relock_beyond(state, gap, end, state.estimate.n_after);
    if (something) {
        const double mixed = mixed_variance(state, variance);
        mix(state);
        apply_mixture(state, gap, of_sum, mixed, out);
        out.sigma_sum_arcsec = deviation(mixed + beyond);
        return out;
    }
    if (config.method == BridgeMethod::automatic &&
        choose_polynomial(config, state, gap, end, problem.halves ? of_whole_ticks(law) : law, variance, misfit, out)) {
        out.polynomial_variance_arcsec2 += beyond;
    } else {
        apply(state, gap, found, variance + beyond, out);
    }
    // After `apply`: the corrections must use the scale and variance that the problem was solved with; the scale just learnt
    // would count this switch's step twice. By phase that is as large as the whole error; of whole counts, whose sigma is
    // rather too large, it makes 1.5 % at most.
    if (problem.with_phase) learn_scale(state);
    return out;
}

void learn(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
           const TickInput& tick, bool idle) noexcept {
    const double value = tick.value_arcsec;
    MotionTick motion{.usable = tick.measured && tick.settled && is_finite(tick.variance_arcsec2), .first = value};
    if (config.optimal.halves) {
        motion.first = 0.5 * (value + tick.half_excess_arcsec);
        motion.second = 0.5 * (value - tick.half_excess_arcsec);
    }
    step(gyro, config.optimal, state.learning, motion, idle);
}

}  // namespace zlg::core
