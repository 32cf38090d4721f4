#include "gap_interpolation.hpp"

#include <zlg/core/compensation/border.hpp>

namespace zlg::core {
void Points::collect(const GapBridgeState& state, std::int64_t origin, int from, int to, std::int64_t end) noexcept {
    const int first = origin + from < 0 ? static_cast<int>(-origin) : from;
    const int last = origin + to < end ? to : static_cast<int>(end - 1 - origin);
    for (int x = first; x <= last; ++x) {
        // Written in any case, and kept where the tick counts.
        position[static_cast<unsigned>(n)] = x;
        if (at(state, origin + x).measured) ++n;
    }
}

GapSums sums_of(const CompensationConstants& gyro, const GapBridgeConfig& config, const GapBridgeState& state,
                const Gap& gap, std::int64_t end, int order) noexcept {
    const auto n = static_cast<unsigned>(gap.n);
    // Those before and after it, or after it alone in reversed time.
    Points points;
    const int behind = gap.has_before ? config.points_after : config.extrapolation_points;
    if (gap.has_before) points.collect(state, gap.first_tick - 1, 1 - config.points_before, 0, end);
    points.collect(state, gap.first_tick - 1, static_cast<int>(n) + 1, static_cast<int>(n) + behind, end);
    GapSums sums{.fit = PolynomialFit{points.position, points.n, order}};
    std::array<double, max_estimated_gap> last_weight{};
    double last_angle_weight = 0.0;
    double last_variance = 0.0;
    const double usual = rounding_arcsec2(gyro, state.with_phase);
    for (int k = 0; k < sums.fit.n(); ++k) {
        const HistoryTick& point = at(state, gap.first_tick - 1 + sums.fit.position(k));
        const double shared =
            neighbours(sums.fit, k) ? shared_rounding(usual, last_variance, point.variance_arcsec2) : 0.0;
        double angle_weight = 0.0;
        for (unsigned j = 0; j < n; ++j) {
            const double w = sums.fit.weight(static_cast<unsigned>(k), j + 1.0);
            sums.value_arcsec[j] += w * point.row.dtheta_final_arcsec;
            sums.variance_arcsec2[j] += w * w * point.variance_arcsec2 - shared * w * last_weight[j];
            last_weight[j] = w;
            angle_weight += w;
        }
        sums.angle_variance_arcsec2 +=
            angle_weight * angle_weight * point.variance_arcsec2 - shared * angle_weight * last_angle_weight;
        // The error of a re-lock correction is in the point, and stays in the angle behind the gap.
        if (sums.fit.position(k) > gap.n)
            sums.angle_variance_arcsec2 += (2.0 * angle_weight + 1.0) * point.relock_variance_arcsec2;
        last_angle_weight = angle_weight;
        last_variance = point.variance_arcsec2;
    }
    return sums;
}

}  // namespace zlg::core
