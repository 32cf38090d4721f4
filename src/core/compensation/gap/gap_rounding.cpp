#include "gap_rounding.hpp"

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

RoundingLaw law_of(const GapBridgeConfig& config, const GapBridgeState& state, bool halves) noexcept {
    return rounding_law(config.optimal, state.learning.moments, halves, state.bias_arcsec);
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

FitWeights weights_in_sum(const PolynomialFit& fit, std::int64_t n) noexcept {
    FitWeights out{};
    for (unsigned k = 0; k < static_cast<unsigned>(fit.n()); ++k)
        out[k] = weight_in_sum(fit.weight_of(k), static_cast<double>(n));
    return out;
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
