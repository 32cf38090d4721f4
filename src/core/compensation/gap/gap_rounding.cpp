#include "gap_rounding.hpp"

#include <zlg/core/compensation/border.hpp>

#include "gap_interpolation.hpp"
#include "gap_points.hpp"

namespace zlg::core {
namespace {

RoundingSums sums_of(const GapBridgeState& state, const Gap& gap, const RoundingLaw& law,
                     BorderWeights& weights) noexcept {
    weights.add_edges();
    return rounding_of(law, weights, at(state, gap.first_tick - 1).sign, at(state, gap.first_tick + gap.n).sign);
}

// Weight of a point in the sum of the ticks 1..n.
double weight_in_sum(const PointWeight& w, double n) noexcept {
    const double sum_j = n * (n + 1.0) / 2.0;
    const double sum_j2 = sum_j * (2.0 * n + 1.0) / 3.0;
    return (w.by_j2 * sum_j2 + w.by_j * sum_j + w.by_1 * n) / w.determinant;
}

}  // namespace

RoundingLaw law_of(const CompensationConstants& gyro, const GapBridgeConfig& config, const GapBridgeState& state,
                   bool halves, bool with_phase) noexcept {
    if (with_phase) return independent_readings(step_arcsec(gyro, true));
    return rounding_law(gyro, config.optimal, state.learning.moments, halves, state.bias_arcsec);
}

RoundingSums rounding_of_estimate(const GapBridgeState& state, const Gap& gap, const RoundingLaw& law) noexcept {
    const GapProblem& problem = state.estimate.problem;
    const int stride = stride_of(problem);
    BorderWeights weights{.gap_begin = stride * problem.n_side, .gap_end = stride * (problem.n_side + problem.n_gap)};
    const EstimatedGap& e = state.estimate;
    for (unsigned k = 0; k < static_cast<unsigned>(problem.factor.n); ++k) {
        const FalseReading f = false_reading(state, k);
        weights.add(problem.place[k], e.solution.estimate.sum_weight[k], f.value_arcsec, f.variance_arcsec2);
    }
    return sums_of(state, gap, law, weights);
}

// The roundings of the points count as independent, each with half the variance of the difference between two readings a tick
// apart, or more. Those that the learnt moments hold have just that variance, as often as `scale` says, and once more in part.
void take_out_own_rounding(const GapBridgeState& state, const RoundingLaw& law, bool learns, double misfit,
                           GapEstimate& found) noexcept {
    const GapProblem& problem = state.estimate.problem;
    const double white = law.step_arcsec * law.step_arcsec / 12.0;
    const double learnt = white - law.arcsec2[0][static_cast<unsigned>(stride_of(problem))];
    const double more = learnt_rounding_part * (problem.scale > 1.0 ? problem.scale : 1.0);
    const double counted = learns ? problem.scale * learnt + more * white : white;
    for (unsigned j = 0; j < static_cast<unsigned>(problem.n_gap); ++j) {
        const double of_points = found.border_weight_sq[j];
        const double with_own = of_points + 2.0 + 2.0 * found.edge_weight[j];
        const double motion = found.variance_arcsec2[j] - counted * with_own;
        found.variance_arcsec2[j] =
            (learnt > white ? learnt : white) * of_points + (motion > 0.0 ? misfit * motion : 0.0);
    }
}

RoundingSums rounding_of_fit(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap,
                             const PolynomialFit& fit, const RoundingLaw& law) noexcept {
    const int side = config.points_before;
    BorderWeights weights{.gap_begin = side, .gap_end = side + static_cast<int>(gap.n)};
    for (int k = 0; k < fit.n(); ++k) {
        const HistoryTick& tick = at(state, gap.first_tick - 1 + fit.position(k));
        const double of_point = weight_in_sum(fit.weight_of(static_cast<unsigned>(k)), static_cast<double>(gap.n));
        weights.add(side - 1 + fit.position(k), of_point, tick.row.relock_arcsec, tick.relock_variance_arcsec2);
    }
    return sums_of(state, gap, law, weights);
}

RoundingSums rounding_of_score(BridgeCandidate polynomial, const RoundingLaw& law) noexcept {
    const double inner = polynomial == by_constant ? 0.75 : 2.5;
    const double outer = 1.5 - inner;
    BorderWeights weights{.gap_begin = 2, .gap_end = 2 + scored_gap};
    weights.add(0, outer);
    weights.add(1, inner);
    weights.add(2 + scored_gap, inner);
    weights.add(3 + scored_gap, outer);
    weights.add_edges();
    return rounding_of(law, weights, 1, 1);
}

}  // namespace zlg::core
