#include <zlg/core/compensation/gap_bridge_config.hpp>

namespace zlg::core {

GapBridgeFault check(const GapBridgeConfig& c) noexcept {
    const auto bad = [](int points) { return points < 1 || points > 8; };
    if (bad(c.extrapolation_points)) return GapBridgeFault::extrapolation_points;
    if (bad(c.points_before)) return GapBridgeFault::points_before;
    if (bad(c.points_after)) return GapBridgeFault::points_after;
    const int order = order_of(c.method);
    if (c.extrapolation_points <= order || c.points_before + c.points_after <= order) return GapBridgeFault::order;
    if (!is_estimated(c)) return GapBridgeFault::none;
    if (c.gap_ticks < 1 || c.gap_ticks > max_estimated_gap) return GapBridgeFault::gap_ticks;
    if (c.relock_ticks < 0 || c.relock_ticks > most_relock_ticks) return GapBridgeFault::relock_ticks;
    return GapBridgeFault::none;
}

}  // namespace zlg::core
