#include "gap_first.hpp"

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "gap_final.hpp"
#include "gap_interpolation.hpp"
#include "gap_points.hpp"
#include "gap_rounding.hpp"

namespace zlg::core {
namespace {

// Ticks before the gap without a break, as prefix sums.
struct Run {
    int n = 0;
    std::array<double, 2 * window_ticks> angle_arcsec{};
};

Run run_before(const GapBridgeState& state, const Gap& gap, std::int64_t end) noexcept {
    Run run;
    double sum = 0.0;
    for (std::int64_t tick = gap.first_tick - 1; tick >= 0 && tick > end - history_ticks; --tick) {
        if (!at(state, tick).measured || run.n + 1 == static_cast<int>(run.angle_arcsec.size())) break;
        sum += at(state, tick).row.dtheta_final_arcsec;
        run.angle_arcsec[static_cast<unsigned>(++run.n)] = sum;
    }
    return run;
}

// The rounding law of the few ticks of a run: rate and mean squares of its own.
RoundingLaw law_of(const Run& run, double step) noexcept {
    const double rate = run.n > 0 ? run.angle_arcsec[static_cast<unsigned>(run.n)] / run.n : 0.0;
    std::array<double, window_ticks + 1> read{};
    for (int lag = 1; lag <= window_ticks; ++lag) {
        const auto k = static_cast<unsigned>(lag);
        // Distances that the run does not hold: a scatter of a count, at which the coherence is 0.
        read[k] = step * step;
        if (lag > run.n) continue;
        double sum = 0.0;
        for (unsigned i = 0; i + k <= static_cast<unsigned>(run.n); ++i) {
            const double x = run.angle_arcsec[i + k] - run.angle_arcsec[i] - rate * lag;
            sum += x * x;
        }
        read[k] = sum / (run.n - lag + 1);
    }
    return rounding_law(step, rate, read, false, 0.0);
}

// Variance of the angle at a constant rate, with the roundings as they go together.
double variance_at_rest(const CompensationConstants& gyro, const GapBridgeState& state, const Gap& gap,
                        std::int64_t end) noexcept {
    const double variance = state.estimate.solution.estimate.sum_variance_arcsec2;
    const bool with_phase = state.estimate.problem.with_phase;
    const double step = step_arcsec(gyro, with_phase);
    const RoundingLaw law = with_phase ? independent_readings(step) : law_of(run_before(state, gap, end), step);
    const RoundingSums sums = rounding_of_estimate(state, gap, law);
    const double right = variance + sums.broken_arcsec2 - sums.white_arcsec2;
    return right > sums.broken_arcsec2 ? right : sums.broken_arcsec2;
}

double angle_of_gap(const GapBridgeState& state) noexcept {
    double sum = 0.0;
    for (unsigned j = 0; j < static_cast<unsigned>(state.estimate.problem.n_gap); ++j)
        sum += state.estimate.solution.estimate.value_arcsec[j];
    return sum;
}

// The mixture is there, and every number of it: wild counts may have made another one.
bool is_mixed(const GapBridgeState& state, double at_rest) noexcept {
    const MixtureEstimate& m = state.estimate.mixture.estimate;
    if (!m.known) return false;
    double sum = mixed_variance(state, at_rest) + angle_of_gap(state);
    for (const double x : m.value_arcsec) sum += x;
    for (const double x : m.dual) sum += x;
    return is_finite(sum);
}

// There are points on both sides: the last one lies after the gap, and the gap after a measured tick.
bool is_between_points(const GapBridgeState& state, const Gap& gap) noexcept {
    const GapProblem& problem = state.estimate.problem;
    const auto last = static_cast<unsigned>(problem.factor.n - 1);
    return gap.has_before && problem.place[0] < problem.n_side && problem.place[last] >= problem.n_side;
}

}  // namespace

bool is_read_by_phase(const GapBridgeState& state, const Gap& gap) noexcept {
    return (!gap.has_before || at(state, gap.first_tick - 1).with_phase) &&
           at(state, gap.first_tick + gap.n).with_phase;
}

EstimatedAngle first_angle(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                           const Gap& gap, std::int64_t end, double misfit) noexcept {
    EstimatedAngle out{.order = order_in_place(config, state)};
    const double at_rest = variance_at_rest(gyro, state, gap, end);
    const bool mixed = is_mixed(state, at_rest);
    const double variance = mixed ? mixed_variance(state, at_rest) : misfit * at_rest;
    const double beyond = relock_beyond(state, gap, end, state.estimate.n_after);
    if (mixed) mix(state);
    if (mixed && is_between_points(state, gap)) {
        apply_mixture(state, gap, state.estimate.solution.estimate.sum_variance_arcsec2, variance, out);
        for (unsigned j = 0; j < static_cast<unsigned>(gap.n); ++j)
            at(state, gap.first_tick + j).row.flags |= flag_lower_order;
        out.sigma_sum_arcsec = deviation(variance + beyond);
        return out;
    }
    // The polynomial's mean square error over the models.
    double off = -angle_of_gap(state);
    const GapSums sums = sums_of(gyro, config, state, gap, end, out.order);
    for (unsigned j = 0; j < static_cast<unsigned>(gap.n); ++j) off += sums.value_arcsec[j];
    out.polynomial_variance_arcsec2 = variance + off * off + beyond;
    return out;
}

}  // namespace zlg::core
