#include <zlg/core/compensation/gap_bridge_config.hpp>

namespace zlg::core {

GapBridgeFault check(const GapBridgeConfig& c) noexcept {
    const auto bad = [](int points) { return points < 1 || points > max_points; };
    if (bad(c.extrapolation_points)) return GapBridgeFault::extrapolation_points;
    if (bad(c.points_before)) return GapBridgeFault::points_before;
    if (bad(c.points_after)) return GapBridgeFault::points_after;
    const int order = order_of(c.method);
    if (c.extrapolation_points <= order || c.points_before + c.points_after <= order) return GapBridgeFault::order;
    if (is_estimated(c) && check(c.optimal) != OptimalBridgeFault::none) return GapBridgeFault::optimal;
    return GapBridgeFault::none;
}

}  // namespace zlg::core
