#include "fault_perimeter.hpp"

#include <limits>
#include <numbers>

#include <zlg/core/common/maths.hpp>

#include "fault_plan.hpp"

namespace zlg::twin {

double length_lambda(const Fault& fault, double time_s, double vibration_hz) {
    const double part = progress(fault, time_s);
    switch (fault.kind) {
        case FaultKind::mode_hop:
        case FaultKind::piezo_step: return fault.size * part;
        case FaultKind::perimeter_ramp: return fault.size * fault.duration_s * part;
        case FaultKind::vibration:
            if (!acts_at(fault, time_s)) return 0.0;
            return fault.size * core::maths::sin(2.0 * std::numbers::pi * vibration_hz * (time_s - fault.at_s));
        case FaultKind::shock: return part < 1.0 ? fault.size * core::maths::sin(std::numbers::pi * part) : 0.0;
        default: return 0.0;
    }
}

double longest_piece_s(const Fault& fault, double vibration_hz) {
    if (fault.kind == FaultKind::vibration) return 0.25 / vibration_hz;
    if (fault.kind == FaultKind::shock && fault.duration_s > 0.0) return 0.1 * fault.duration_s;
    return std::numeric_limits<double>::infinity();
}

double length_lambda(std::span<const Fault> active, double time_s, double vibration_hz) {
    double sum = 0.0;
    for (const Fault& fault : active) sum += length_lambda(fault, time_s, vibration_hz);
    return sum;
}

double switch_error_lambda(std::span<const Fault> active, double time_s) {
    double sum = 0.0;
    for (const Fault& fault : active) {
        const bool misleads = fault.kind == FaultKind::switch_wrong_mode || fault.kind == FaultKind::switch_no_mode;
        if (misleads && acts_at(fault, time_s)) sum += fault.size;
    }
    return sum;
}

double half_wave_ratio(std::span<const Fault> active, double time_s) {
    double ratio = 1.0;
    for (const Fault& fault : active) {
        if (fault.kind == FaultKind::half_wave_error && acts_at(fault, time_s)) ratio *= 1.0 + fault.size;
    }
    return ratio;
}

double warming_c(std::span<const Fault> active, double time_s) {
    double sum = 0.0;
    for (const Fault& fault : active) {
        if (fault.kind == FaultKind::thermal_shock) sum += fault.size * progress(fault, time_s);
    }
    return sum;
}

}  // namespace zlg::twin
