#include "polynomial_motion.hpp"

namespace zlg::core {
namespace {

// Some ticks with the weights of an error.
struct WeightedTicks {
    int n = 0;
    std::array<int, window_ticks> place{};
    std::array<double, window_ticks> weight{};

    void add(int tick_place, double of_tick) noexcept {
        place[static_cast<unsigned>(n)] = tick_place;
        weight[static_cast<unsigned>(n++)] = of_tick;
    }
};

// c^T C c.
double variance_of(const MotionCovariance& covariance, const WeightedTicks& ticks) noexcept {
    double sum = 0.0;
    for (unsigned k = 0; k < static_cast<unsigned>(ticks.n); ++k) {
        double row = 0.5 * ticks.weight[k] * covariance.of_ticks(ticks.place[k], ticks.place[k]);
        for (unsigned i = 0; i < k; ++i) row += ticks.weight[i] * covariance.of_ticks(ticks.place[i], ticks.place[k]);
        sum += 2.0 * ticks.weight[k] * row;
    }
    return sum > 0.0 ? sum : 0.0;
}

WeightedTicks points_with(const PolynomialFit& fit, const FitWeights& weight) noexcept {
    WeightedTicks ticks;
    for (int k = 0; k < fit.n(); ++k) ticks.add(fit.position(k) - fit.position(0), weight[static_cast<unsigned>(k)]);
    return ticks;
}

// Infinite where no motion is known.
void add_motion(const CompensationConstants& gyro, const GapBridgeConfig& config, const GapBridgeState& state,
                const Gap& gap, GapSums& sums) noexcept {
    const PolynomialFit& fit = sums.fit;
    const auto n = static_cast<int>(gap.n);
    // Tick 1 of the gap, in ticks from the first point.
    const int first = 1 - fit.position(0);
    const bool reaches = gap.has_before && fit.position(fit.n() - 1) - fit.position(0) < window_ticks;
    if (!is_ready(config.optimal, state.learning) || !reaches || first + n > window_ticks) {
        sums.variance_arcsec2.fill(infinity);
        sums.angle_variance_arcsec2 = infinity;
        return;
    }
    const MotionMemory memory = better_memory(state.learning.scores);
    const MotionCovariance covariance{gyro,
                                      config.optimal,
                                      state.learning.moments,
                                      memory,
                                      variance_ratio(state.learning.scores, memory),
                                      state.learning.moments.with_phase};
    FitWeights in_sum{};
    for (int j = 1; j <= n; ++j) {
        const FitWeights weight = fit.weights(j);
        for (unsigned k = 0; k < static_cast<unsigned>(fit.n()); ++k) in_sum[k] += weight[k];
        WeightedTicks error = points_with(fit, weight);
        error.add(first + j - 1, -1.0);
        sums.variance_arcsec2[static_cast<unsigned>(j - 1)] += variance_of(covariance, error);
    }
    WeightedTicks error = points_with(fit, in_sum);
    for (int j = 0; j < n; ++j) error.add(first + j, -1.0);
    sums.angle_variance_arcsec2 += variance_of(covariance, error);
}

}  // namespace

GapSums sums_with_motion(const CompensationConstants& gyro, const GapBridgeConfig& config, const GapBridgeState& state,
                         const Gap& gap, std::int64_t end, int order) noexcept {
    GapSums sums = sums_of(gyro, config, state, gap, end, order < 1 ? order : 1);
    add_motion(gyro, config, state, gap, sums);
    return sums;
}

}  // namespace zlg::core
