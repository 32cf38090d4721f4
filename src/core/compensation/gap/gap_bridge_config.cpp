#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/gap_bridge.hpp>

namespace zlg::core {

GapBridgeFault check(const GapBridgeConfig& c) noexcept {
    const auto bad = [](int points) { return points < 1 || points > max_points; };
    if (bad(c.extrapolation_points)) return GapBridgeFault::extrapolation_points;
    if (bad(c.points_before)) return GapBridgeFault::points_before;
    if (bad(c.points_after)) return GapBridgeFault::points_after;
    const int order = order_of(c.method);
    if (c.extrapolation_points <= order || c.points_before + c.points_after <= order) return GapBridgeFault::order;
    if (!(c.count.value() >= 0.0 && is_finite(c.count.value()))) return GapBridgeFault::count;
    if (is_estimated(c) && check(c.optimal) != OptimalBridgeFault::none) return GapBridgeFault::optimal;
    return GapBridgeFault::none;
}

}  // namespace zlg::core
