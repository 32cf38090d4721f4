#include "fault_light.hpp"

#include <numbers>

#include <zlg/core/common/maths.hpp>

#include "fault_plan.hpp"

namespace zlg::twin {

LightParts light_parts(std::span<const Fault> active, double time_s) {
    LightParts parts;
    for (const Fault& fault : active) {
        if (!acts_at(fault, time_s)) continue;
        if (fault.kind == FaultKind::laser_off) return {0.0, 0.0};
        if (fault.kind != FaultKind::beam_fades) continue;
        const double depth = core::maths::sin(std::numbers::pi * progress(fault, time_s));
        parts.a *= 1.0 - fault.size * depth * depth;
    }
    return parts;
}

}  // namespace zlg::twin
