#include "gap_interpolation.hpp"

#include <zlg/core/compensation/border.hpp>

namespace zlg::core {

PolynomialFit fit_beside(const GapBridgeState& state, const Gap& gap, int n_before, int n_after, std::int64_t end,
                         int order) noexcept {
    std::array<std::int32_t, max_fit_points> position{};
    int n = 0;
    const auto collect = [&](std::int64_t from, std::int64_t to) {
        for (std::int64_t tick = from < 0 ? 0 : from; tick < to && tick < end; ++tick)
            if (at(state, tick).read.measured)
                position[static_cast<unsigned>(n++)] = static_cast<std::int32_t>(tick - gap.first_tick + 1);
    };
    collect(gap.first_tick - n_before, gap.first_tick);
    collect(gap.first_tick + gap.n, gap.first_tick + gap.n + n_after);
    return {position, n, order};
}

PolynomialSum sum_of(const CompensationConstants& gyro, const GapBridgeState& state, const Gap& gap,
                     const PolynomialFit& fit, const FitWeights& weight) noexcept {
    const double usual = rounding_arcsec2(gyro, state.with_phase);
    PolynomialSum sum;
    double last_weight = 0.0;
    double last_arcsec2 = 0.0;
    for (int k = 0; k < fit.n(); ++k) {
        const HistoryTick& point = at(state, gap.first_tick - 1 + fit.position(k));
        const double w = weight[static_cast<unsigned>(k)];
        sum.value_arcsec += w * point.row.dtheta_final_arcsec;
        sum.variance_arcsec2 += w * w * point.read.variance_arcsec2;
        // Neighbouring ticks share a rounding, so their covariance is negative.
        if (k > 0 && fit.position(k) == fit.position(k - 1) + 1)
            sum.variance_arcsec2 -= shared_rounding(usual, last_arcsec2, point.read.variance_arcsec2) * w * last_weight;
        last_weight = w;
        last_arcsec2 = point.read.variance_arcsec2;
    }
    return sum;
}

}  // namespace zlg::core
