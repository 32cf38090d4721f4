#include "gap_points.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "gap_interpolation.hpp"

namespace zlg::core {
namespace {

// chi and f0 age slowly: what a switch adds to the variance of their product's scale.
constexpr double scale_walk = 1e-8;

// Points that fit worse than this, or a step of the scale of more sigmas, tell of a blow and not of the scale.
constexpr double believable_innovation = 4.0;
constexpr double believable_step_sq = 9.0;

// No bias is further from the presumed one than that.
constexpr double max_scale = 0.1;

bool is_point(const HistoryTick& tick) noexcept { return tick.measured && is_finite(tick.variance_arcsec2); }

// Half h of a tick as it was read, without the bias.
double half_value(const HistoryTick& tick, int h) noexcept {
    const double excess = h == 0 ? tick.half_excess_arcsec : -tick.half_excess_arcsec;
    return 0.5 * (tick.row.dtheta_final_arcsec + excess);
}

// Of the half-tick k places after the first one after the gap; the re-lock correction of the whole tick is undone.
double corrected_half(const GapBridgeState& state, const HistoryTick& tick, unsigned k) noexcept {
    const double read = half_value(tick, static_cast<int>(k % 2)) + 0.5 * tick.row.relock_arcsec;
    return read + (1.0 + state.bias_scale.value) * state.joint.correction_arcsec[k];
}

// Covariance of the errors of half-ticks k and l after the gap.
double half_error(const GapBridgeState& state, unsigned k, unsigned l) noexcept {
    const JointRelock& joint = state.joint;
    return joint.covariance_arcsec2[k][l] +
           state.bias_scale.variance * joint.correction_arcsec[k] * joint.correction_arcsec[l];
}

// Place of a point among the half-ticks after the gap; negative before it.
int half_after(const EstimatedGap& e, const GapProblem& problem, unsigned point) noexcept {
    return e.index[point] - problem.n_side * stride_of(problem);
}

void add_tick(const MotionCovariance& covariance, const HistoryTick& tick, int k, EstimatedGap& e) noexcept {
    GapProblem& problem = e.problem;
    const auto n = static_cast<unsigned>(problem.factor.n);
    Column error{};
    error[n] = tick.relock_variance_arcsec2;
    e.data.value[n] = tick.row.dtheta_final_arcsec;
    e.relock_variance_arcsec2[n] = tick.relock_variance_arcsec2;
    e.index[n] = static_cast<std::int8_t>(k);
    add_point(covariance, problem, place_of(k, problem.n_side, problem.n_gap), error);
}

void add_half(const MotionCovariance& covariance, GapBridgeState& state, const HistoryTick& tick, int k) noexcept {
    EstimatedGap& e = state.estimate;
    GapProblem& problem = state.estimate.problem;
    const auto n = static_cast<unsigned>(problem.factor.n);
    e.index[n] = static_cast<std::int8_t>(k);
    e.data.value[n] = half_value(tick, k % 2);
    Column error{};
    const int after = half_after(e, problem, n);
    if (after >= 0) {
        const auto own = static_cast<unsigned>(after);
        e.data.value[n] = corrected_half(state, tick, own);
        e.data.probe[n] = (1.0 + state.bias_scale.value) * state.joint.correction_arcsec[own];
        for (unsigned i = 0; i <= n; ++i) {
            const int other = half_after(e, problem, i);
            if (other >= 0) error[i] = half_error(state, own, static_cast<unsigned>(other));
        }
    }
    add_point(covariance, problem, 2 * place_of(k / 2, problem.n_side, problem.n_gap) + k % 2, error);
}

void set_final(HistoryTick& tick, double value_arcsec, double relock_arcsec, ExactSum& change) noexcept {
    change.add(value_arcsec);
    change.add(-tick.row.dtheta_final_arcsec);
    tick.row.dtheta_final_arcsec = value_arcsec;
    tick.row.relock_arcsec = relock_arcsec;
}

}  // namespace

void try_point(const MotionCovariance& covariance, GapBridgeState& state) noexcept {
    EstimatedGap& e = state.estimate;
    const GapProblem& problem = e.problem;
    const int k = e.n_tried++;
    const std::int64_t tick = tick_of(e, problem, k);
    if (tick < 0 || !is_point(at(state, tick))) return;
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
        if (before < 0 || !is_point(at(state, before))) continue;
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
        if (own < 0) continue;
        if (!problem.halves) e.data.error_with_all[k] = e.relock_variance_arcsec2[k];
        for (unsigned i = 0; problem.halves && i < n; ++i) {
            const int other = half_after(e, problem, i);
            if (other >= 0)
                e.data.error_with_all[k] += half_error(state, static_cast<unsigned>(own), static_cast<unsigned>(other));
        }
        e.data.error_variance += e.data.error_with_all[k];
    }
}

double scatter_of_points(const GapBridgeState& state) noexcept {
    const GapProblem& problem = state.estimate.problem;
    const auto& value = state.estimate.data.value;
    if (!problem.halves) return scatter(value.data(), problem.factor.n);
    Column ticks{};
    for (unsigned k = 0; 2 * k + 1 < static_cast<unsigned>(problem.factor.n); ++k)
        ticks[k] = value[2 * k] + value[2 * k + 1];
    return scatter(ticks.data(), problem.factor.n / 2);
}

FalseReading false_reading(const GapBridgeState& state, unsigned point) noexcept {
    const EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    if (!problem.halves)
        return {at(state, tick_of(e, problem, e.index[point])).row.relock_arcsec, e.relock_variance_arcsec2[point]};
    const int after = half_after(e, problem, point);
    if (after < 0) return {};
    const auto own = static_cast<unsigned>(after);
    return {-(1.0 + state.bias_scale.value) * state.joint.correction_arcsec[own], half_error(state, own, own)};
}

void correct_ticks(GapBridgeState& state, const GapEstimate& found, ExactSum& change) noexcept {
    const EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    for (unsigned k = 0; k < static_cast<unsigned>(problem.factor.n); ++k) {
        if (half_after(e, problem, k) < 0 || !(e.relock_variance_arcsec2[k] > 0.0)) continue;
        HistoryTick& tick = at(state, tick_of(e, problem, e.index[k]));
        const double error = e.relock_variance_arcsec2[k] * found.dual[k];
        set_final(tick, tick.row.dtheta_final_arcsec - error, tick.row.relock_arcsec + error, change);
    }
}

void correct_halves(GapBridgeState& state, const GapEstimate& found, ExactSum& change) noexcept {
    const EstimatedGap& e = state.estimate;
    const GapProblem& problem = state.estimate.problem;
    const auto n = static_cast<unsigned>(problem.factor.n);
    for (unsigned k = 0; k + 1 < n; k += 2) {
        const int first = half_after(e, problem, k);
        if (first < 0) continue;
        double correction = 0.0;
        for (unsigned own = static_cast<unsigned>(first); own < static_cast<unsigned>(first) + 2; ++own) {
            correction += (1.0 + state.bias_scale.value) * state.joint.correction_arcsec[own];
            for (unsigned i = 0; i < n; ++i) {
                const int other = half_after(e, problem, i);
                if (other >= 0) correction -= half_error(state, own, static_cast<unsigned>(other)) * found.dual[i];
            }
        }
        HistoryTick& tick = at(state, tick_of(e, problem, e.index[k]));
        const double read = tick.row.dtheta_final_arcsec + tick.row.relock_arcsec;
        set_final(tick, read + correction, -correction, change);
        tick.row.flags = (tick.row.flags & ~std::uint32_t{flag_relock_uncorrected}) | flag_relock_corrected;
    }
}

void learn_scale(GapBridgeState& state) noexcept {
    if (!state.estimate.problem.halves) return;
    BiasScale& scale = state.bias_scale;
    const GapEstimate& found = state.estimate.solution.estimate;
    if (!(found.innovation_ratio <= believable_innovation)) return;
    if (!(found.probe_dual * found.probe_dual <= believable_step_sq * found.probe_information)) return;
    const double left = scale.variance - scale.variance * scale.variance * found.probe_information;
    const double moved = scale.value - scale.variance * found.probe_dual;
    if (!(size(moved) <= max_scale) || !(left > 0.0)) return;
    scale.value = moved;
    scale.variance = left + scale_walk;
}

}  // namespace zlg::core
