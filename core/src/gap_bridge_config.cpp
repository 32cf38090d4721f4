#include <zlg/core/gap_bridge.hpp>
#include <zlg/core/maths.hpp>

namespace zlg::core {

int order_of(BridgeMethod method) noexcept {
    return method == BridgeMethod::quadratic ? 2 : method == BridgeMethod::linear ? 1 : 0;
}

int final_delay_ticks(const GapBridgeConfig& config) noexcept {
    const bool extrapolation_is_longer = config.extrapolation_points > config.points_after;
    return max_gap_ticks + (extrapolation_is_longer ? config.extrapolation_points : config.points_after);
}

GapBridgeFault check(const GapBridgeConfig& c) noexcept {
    const auto bad = [](int points) { return points < 1 || points > max_points; };
    if (bad(c.extrapolation_points)) return GapBridgeFault::extrapolation_points;
    if (bad(c.points_before)) return GapBridgeFault::points_before;
    if (bad(c.points_after)) return GapBridgeFault::points_after;
    const int order = order_of(c.method);
    if (c.extrapolation_points <= order || c.points_before + c.points_after <= order) return GapBridgeFault::order;
    if (!(c.count.value() >= 0.0 && is_finite(c.count.value()))) return GapBridgeFault::count;
    return GapBridgeFault::none;
}

}  // namespace zlg::core
