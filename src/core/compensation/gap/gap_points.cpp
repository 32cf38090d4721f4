#include "gap_points.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "gap_interpolation.hpp"

namespace zlg::core {
namespace {

// Kalman filter of the scale d of chi f0, a random walk over the switches: its process noise, 1e-4 a switch, since chi
// and f0 age slowly. By trial on bench/accuracy (docs/accuracy_campaign.md, (f): chi f0 wrong by 1 %).
constexpr double scale_walk = 1e-8;

// Gates of the filter: an innovation ratio, or a squared step over its variance, beyond these comes from a shock and
// not from the scale. Two and three standard deviations.
constexpr double max_innovation_ratio = 4.0;
constexpr double max_step_sq = 9.0;

// Square of the standard deviations beyond which an estimated error of a re-lock is a jump of the motion: by phase the first
// ticks after a closing err by up to thirteen.
constexpr double max_relock_error_sq = 900.0;

// A scale farther off is no property of a gyro whose chi f0 was calibrated at all.
constexpr double max_scale = 0.1;

// By phase a reading without one is no point: it errs by up to half a count, which the next tick takes back.
bool is_point(const HistoryTick& tick, bool with_phase) noexcept {
    return tick.measured && is_finite(tick.variance_arcsec2) && (tick.with_phase || !with_phase);
}

// Half h of a tick as it was read, without the bias.
double half_value(const HistoryTick& tick, int h) noexcept {
    const double excess = h == 0 ? tick.half_excess_arcsec : -tick.half_excess_arcsec;
    return 0.5 * (tick.row.dtheta_final_arcsec + excess);
}

// The k-th half-tick after the gap, or before k = 0 a lit one at its end.
const LitHalf& lit_half(const EstimatedGap& e, int k) noexcept {
    return e.lit.half[static_cast<unsigned>(e.lit.n + k)];
}

// s D of it, by the constants.
double correction(const GapBridgeState& state, int k) noexcept {
    return k < 0 ? lit_half(state.estimate, k).correction_arcsec
                 : state.joint.correction_arcsec[static_cast<unsigned>(k)];
}

// Of a half-tick after the gap; the re-lock correction of the whole tick is undone.
double half_as_read(const HistoryTick& tick, int k) noexcept {
    return half_value(tick, k % 2) + 0.5 * tick.row.relock_arcsec;
}

// Covariance of the errors of half-ticks k and l.
double half_error(const GapBridgeState& state, int k, int l) noexcept {
    double sum = state.bias_scale.variance * correction(state, k) * correction(state, l);
    if (k >= 0 && l >= 0)
        return sum + state.joint.covariance_arcsec2[static_cast<unsigned>(k)][static_cast<unsigned>(l)];
    if (k >= 0 || l >= 0) return sum;
    const EstimatedGap& e = state.estimate;
    sum += lit_half(e, k).common_arcsec * lit_half(e, l).common_arcsec;
    return k == l ? sum + lit_half(e, k).variance_arcsec2 : sum;
}

// Place of a point among the half-ticks after the gap; lit ones are negative.
int half_after(const EstimatedGap& e, const GapProblem& problem, unsigned point) noexcept {
    return place_after(e, problem, e.index[point]);
}

// It has a false angle.
bool is_corrected(const EstimatedGap& e, int after) noexcept { return after >= -e.lit.n; }

// First of the points after the gap.
unsigned first_after(const EstimatedGap& e, const GapProblem& problem) noexcept {
    auto k = static_cast<unsigned>(problem.factor.n);
    while (k > 0 && half_after(e, problem, k - 1) >= 0) --k;
    return k;
}

// Covariance of the errors of points k and l by the magnetic drift, which steps at the gap; of whole ticks.
double magnetic_error(const EstimatedGap& e, unsigned k, unsigned l) noexcept {
    const bool same = is_corrected(e, half_after(e, e.problem, k)) == is_corrected(e, half_after(e, e.problem, l));
    return same ? e.magnetic_variance_arcsec2 : -e.magnetic_variance_arcsec2;
}

// Those of the newest point with all others.
void add_magnetic_error(const EstimatedGap& e, double share, Column& error) noexcept {
    if (e.magnetic_variance_arcsec2 == 0.0) return;
    const auto n = static_cast<unsigned>(e.problem.factor.n);
    for (unsigned k = 0; k <= n; ++k) error[k] += share * magnetic_error(e, k, n);
}

void add_tick(const MotionCovariance& covariance, const HistoryTick& tick, int k, EstimatedGap& e) noexcept {
    GapProblem& problem = e.problem;
    const auto n = static_cast<unsigned>(problem.factor.n);
    e.index[n] = static_cast<std::int8_t>(k);
    Column error{};
    add_magnetic_error(e, 1.0, error);
    error[n] += tick.relock_variance_arcsec2;
    e.data.value[n] = tick.row.dtheta_final_arcsec - tick.row.mode * e.magnetic_arcsec;
    e.relock_variance_arcsec2[n] = tick.relock_variance_arcsec2;
    add_point(covariance, problem, sample_of(e, problem, k), error);
}

void add_half(const MotionCovariance& covariance, GapBridgeState& state, const HistoryTick& tick, int k) noexcept {
    EstimatedGap& e = state.estimate;
    GapProblem& problem = state.estimate.problem;
    const auto n = static_cast<unsigned>(problem.factor.n);
    e.index[n] = static_cast<std::int8_t>(k);
    e.data.value[n] = half_value(tick, k % 2);
    Column error{};
    add_magnetic_error(e, 0.25, error);
    const int own = half_after(e, problem, n);
    if (is_corrected(e, own)) {
        const double correction_arcsec = correction(state, own);
        e.data.probe[n] = correction_arcsec;
        e.data.value[n] = (own < 0 ? lit_half(e, own).value_arcsec : half_as_read(tick, own)) +
                          (1.0 + state.bias_scale.value) * correction_arcsec;
        for (unsigned i = 0; i <= n; ++i) {
            const int other = half_after(e, problem, i);
            if (is_corrected(e, other)) error[i] += half_error(state, own, other);
        }
    }
    e.data.value[n] -= 0.5 * (own < 0 && is_corrected(e, own) ? e.lit.mode : tick.row.mode) * e.magnetic_arcsec;
    add_point(covariance, problem, sample_of(e, problem, k), error);
}

void set_final(HistoryTick& tick, double value_arcsec, double relock_arcsec, ExactSum& change) noexcept {
    change.add(value_arcsec);
    change.add(-tick.row.dtheta_final_arcsec);
    tick.row.dtheta_final_arcsec = value_arcsec;
    tick.row.relock_arcsec = relock_arcsec;
}

// Where the motion jumped, the estimate would take it for an error of the re-lock that the correction cannot have.
bool is_plausible(double error_arcsec, double variance_arcsec2) noexcept {
    return error_arcsec * error_arcsec <= max_relock_error_sq * variance_arcsec2;
}

// Part of a false angle by which the law of the bias errs, as its quartic term does near the miss: what the learnt motion
// tells from a motion, and another one does not.
constexpr double law_part = 0.03;

void hold_unsure(AngleRow& row, double error_arcsec, double sure_arcsec2) noexcept {
    if (!(error_arcsec * error_arcsec > sure_arcsec2)) return;
    const double by_law = law_part * row.relock_arcsec;
    row.sigma_arcsec = square_root(row.sigma_arcsec * row.sigma_arcsec + error_arcsec * error_arcsec + by_law * by_law);
}

}  // namespace

void take_lit_halves(GapBridgeState& state) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = e.problem;
    if (!problem.halves || state.lit.end_tick != e.end_tick || state.lit.n > 2 * problem.n_gap) return;
    e.lit = state.lit;
    // Whole ticks.
    const int too_many = n_places(e, problem) - static_cast<int>(max_unknowns);
    if (too_many > 0) e.n_tried = too_many + too_many % 2;
}

void try_point(const MotionCovariance& covariance, GapBridgeState& state) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = e.problem;
    const int k = e.n_tried++;
    const std::int64_t tick = tick_of(e, problem, k);
    const bool is_lit = !is_after(e, problem, k) && is_corrected(e, place_after(e, problem, k));
    if (!is_lit && (tick < 0 || !is_point(at(state, tick), problem.with_phase))) return;
    if (problem.halves)
        add_half(covariance, state, at(state, tick), k);
    else
        add_tick(covariance, at(state, tick), k, e);
}

PredictionData points_before(const MotionCovariance& covariance, const GapBridgeState& state, std::int64_t tick,
                             PredictionProblem& problem) noexcept {
    PredictionData data{.level = state.learning.moments.level};
    ColumnOf<few_unknowns> error{};
    for (int k = 0; k < problem.n_side && !problem.failed; ++k) {
        const std::int64_t before = tick - problem.n_side + k;
        if (before < 0 || !is_point(at(state, before), problem.with_phase)) continue;
        const auto n = static_cast<unsigned>(problem.factor.n);
        data.value[n] = at(state, before).row.dtheta_final_arcsec - data.level;
        error[n] = at(state, before).relock_variance_arcsec2;
        add_point(covariance, problem, k, error);
        error[n] = 0.0;
    }
    return data;
}

void begin_solution(GapBridgeState& state) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    const auto n = static_cast<unsigned>(problem.factor.n);
    e.solving = true;
    e.data.level = state.learning.moments.level;
    for (unsigned k = 0; k < n; ++k) {
        e.data.value[k] -= e.data.level / stride_of(problem);
        const int own = half_after(e, problem, k);
        if (!is_corrected(e, own)) continue;
        if (!problem.halves) e.data.error_with_all[k] = e.relock_variance_arcsec2[k];
        // Of those after the gap: what a lit half reads wrong does not stay in the angle.
        for (unsigned i = first_after(e, problem); problem.halves && i < n; ++i)
            e.data.error_with_all[k] += half_error(state, own, half_after(e, problem, i));
        if (own >= 0) e.data.error_variance += e.data.error_with_all[k];
    }
}

namespace {

// Ticks on each side that the mixture uses: with more its stages would not all be ready for gaps of 5 and 6 ticks, or one
// with lit halves, whose own solutions are the longest beside so many points.
constexpr int few_a_side = 6;
constexpr int min_points_before = 2;
int mixture_side(const EstimatedGap& e) noexcept {
    return e.problem.n_gap == 5 || e.problem.n_gap == 6 || e.lit.n > 0 ? few_a_side : max_points_a_side;
}

// Whether the k-th point is the first half of a tick of which both halves are points, or is a tick.
bool begins_tick(const GapProblem& problem, int k) noexcept {
    if (!problem.halves) return true;
    const int place = problem.place[static_cast<unsigned>(k)];
    return place % 2 == 0 && k + 1 < problem.factor.n && problem.place[static_cast<unsigned>(k + 1)] == place + 1;
}

}  // namespace

void begin_mixture(const MotionCovariance& covariance, GapBridgeState& state) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = e.problem;
    const int stride = stride_of(problem);
    GapMixture& mixture = e.mixture;
    mixture.learnt = e.learnt;
    mixture.points.n_gap = problem.n_gap;
    mixture.points.n_side = problem.n_side;
    mixture.points.error_variance = e.data.error_variance;
    const int side = mixture_side(e);
    // Those that are lit in the gap stand for as many before it.
    const int lit = e.lit.n / 2;
    const int first_place = problem.n_side - side + (lit < side - min_points_before ? lit : side - min_points_before);
    std::array<std::int8_t, mixture_unknowns> first_of{};
    for (int k = 0; k < problem.factor.n; ++k) {
        const int place = problem.place[static_cast<unsigned>(k)] / stride;
        if (!begins_tick(problem, k) || place < first_place) continue;
        const auto n = static_cast<unsigned>(mixture.points.n);
        if (place >= problem.n_side + problem.n_gap + side || mixture.points.n == 2 * side) break;
        first_of[n] = static_cast<std::int8_t>(k);
        double value = 0.0;
        MixtureColumn error{};
        for (unsigned earlier = 0; earlier <= n && e.magnetic_variance_arcsec2 > 0.0; ++earlier)
            error[earlier] = magnetic_error(e, static_cast<unsigned>(first_of[earlier]), static_cast<unsigned>(k));
        for (int point = k; point < k + stride; ++point) {
            const auto own = static_cast<unsigned>(point);
            value += e.data.value[own];
            mixture.points.error_with_all[n] += e.data.error_with_all[own];
            const int after = half_after(e, problem, own);
            if (!problem.halves || !is_corrected(e, after)) continue;
            for (unsigned earlier = 0; earlier <= n; ++earlier)
                for (int i = first_of[earlier]; i < first_of[earlier] + stride; ++i) {
                    const int other = half_after(e, problem, static_cast<unsigned>(i));
                    if (is_corrected(e, other)) error[earlier] += half_error(state, after, other);
                }
        }
        if (!problem.halves) error[n] += e.relock_variance_arcsec2[static_cast<unsigned>(k)];
        add_point(covariance, mixture, place, value, error);
    }
    e.mixing = true;
}

void mix(GapBridgeState& state) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = e.problem;
    const MixtureEstimate& more = e.mixture.estimate;
    GapEstimate& found = e.solution.estimate;
    for (unsigned j = 0; j < static_cast<unsigned>(problem.n_gap); ++j)
        found.value_arcsec[j] =
            e.data.level + more.nothing * (found.value_arcsec[j] - e.data.level) + more.value_arcsec[j];
    const MixturePoints& used = e.mixture.points;
    int own = 0;
    for (int k = 0; k < problem.factor.n; ++k) {
        double& dual = found.dual[static_cast<unsigned>(k)];
        const int place = problem.place[static_cast<unsigned>(k)] / stride_of(problem);
        while (own < used.n && used.place[static_cast<unsigned>(own)] < place) ++own;
        const bool is_used = own < used.n && used.place[static_cast<unsigned>(own)] == place;
        dual = more.nothing * dual + (is_used ? more.dual[static_cast<unsigned>(own)] : 0.0);
    }
}

double scatter_of_points(const GapBridgeState& state) noexcept {
    const GapProblem& problem = state.estimate.problem;
    const auto& value = state.estimate.data.value;
    if (!problem.halves) return scatter(value.data(), problem.factor.n);
    Column ticks{};
    int n = 0;
    for (int k = 0; k < problem.factor.n; ++k) {
        const auto own = static_cast<unsigned>(k);
        if (begins_tick(problem, k)) ticks[static_cast<unsigned>(n++)] = value[own] + value[own + 1];
    }
    return scatter(ticks.data(), n);
}

double relock_beyond(const GapBridgeState& state, const Gap& gap, std::int64_t end, int n_after) noexcept {
    double sum = state.relock_to_come_arcsec2 + state.walk_of_switch_arcsec2;
    for (std::int64_t tick = gap.first_tick + gap.n + n_after; tick < end; ++tick)
        if (at(state, tick).measured) sum += at(state, tick).relock_variance_arcsec2;
    return sum;
}

FalseReading false_reading(const GapBridgeState& state, unsigned point) noexcept {
    const EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    if (!problem.halves)
        return {at(state, tick_of(e, problem, e.index[point])).row.relock_arcsec, e.relock_variance_arcsec2[point]};
    const int own = half_after(e, problem, point);
    if (!is_corrected(e, own)) return {};
    return {-(1.0 + state.bias_scale.value) * correction(state, own), half_error(state, own, own)};
}

void correct_ticks(GapBridgeState& state, const GapEstimate& found, double sure_sq, ExactSum& change) noexcept {
    const EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    for (unsigned k = 0; k < static_cast<unsigned>(problem.factor.n); ++k) {
        if (half_after(e, problem, k) < 0 || !(e.relock_variance_arcsec2[k] > 0.0)) continue;
        HistoryTick& tick = at(state, tick_of(e, problem, e.index[k]));
        const double error = e.relock_variance_arcsec2[k] * found.dual[k];
        if (!is_plausible(error, e.relock_variance_arcsec2[k])) continue;
        set_final(tick, tick.row.dtheta_final_arcsec - error, tick.row.relock_arcsec + error, change);
        hold_unsure(tick.row, error, sure_sq * e.relock_variance_arcsec2[k]);
    }
}

void correct_halves(GapBridgeState& state, const GapEstimate& found, double sure_sq, ExactSum& change) noexcept {
    const EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    const auto n = static_cast<unsigned>(problem.factor.n);
    for (unsigned k = first_after(e, problem); k + 1 < n; k += 2) {
        const int first = half_after(e, problem, k);
        double sum = 0.0, error_of_tick = 0.0, variance = 0.0;
        for (int own = first; own < first + 2; ++own) {
            double error = 0.0;
            for (unsigned i = 0; i < n; ++i) {
                const int other = half_after(e, problem, i);
                if (is_corrected(e, other)) error += half_error(state, own, other) * found.dual[i];
            }
            sum += (1.0 + state.bias_scale.value) * correction(state, own);
            const double of_half = half_error(state, own, own);
            if (!is_plausible(error, of_half)) continue;
            sum -= error;
            error_of_tick += error;
            variance += of_half;
        }
        if (sum == 0.0) continue;
        HistoryTick& tick = at(state, tick_of(e, problem, e.index[k]));
        const double read = tick.row.dtheta_final_arcsec + tick.row.relock_arcsec;
        set_final(tick, read + sum, -sum, change);
        hold_unsure(tick.row, error_of_tick, sure_sq * variance);
        tick.row.flags = (tick.row.flags & ~std::uint32_t{flag_relock_uncorrected}) | flag_relock_corrected;
    }
}

void learn_scale(GapBridgeState& state) noexcept {
    if (!state.estimate.problem.halves) return;
    BiasScale& scale = state.bias_scale;
    const GapEstimate& found = state.estimate.solution.estimate;
    if (!(found.innovation_ratio <= max_innovation_ratio)) return;
    if (!(found.probe_dual * found.probe_dual <= max_step_sq * found.probe_information)) return;
    const double posterior = scale.variance - scale.variance * scale.variance * found.probe_information;
    const double moved = scale.value - scale.variance * found.probe_dual;
    if (!(size(moved) <= max_scale) || !(posterior > 0.0)) return;
    scale.value = moved;
    scale.variance = posterior + scale_walk;
}

}  // namespace zlg::core
