#include "fault_frame.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "fault_light.hpp"
#include "fault_plan.hpp"

namespace zlg::twin {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// A fault is known by its start: another one beside it does not change its noise.
std::uint32_t thing_of(const Fault& fault) {
    const auto bits = std::bit_cast<std::uint64_t>(fault.at_s);
    return static_cast<std::uint32_t>(bits ^ (bits >> 32));
}

}  // namespace

void FrameFaults::act(std::span<const Fault> active, std::uint64_t half, double half_s, core::SensorFrame& sensor) {
    const double end_s = static_cast<double>(half + 1) * half_s;
    for (const Fault& fault : active) {
        spoil_light(fault, half, half_s, sensor);
        if (acts_at(fault, end_s)) spoil_slow(fault, sensor);
    }
    deliver(active, end_s, sensor);
}

// Each sample at the middle of its interval. A converter that sticks keeps the code of the sample before.
void FrameFaults::spoil_light(const Fault& fault, std::uint64_t half, double half_s, core::SensorFrame& sensor) {
    const std::size_t n = sensor.n_light;
    const double start_s = static_cast<double>(half) * half_s;
    const double interval_s = half_s / static_cast<double>(n);
    const Noise light_noise{seed_, chance::Cause::faulty_light, thing_of(fault)};
    const auto before = [&](const auto& now, const auto& earlier, std::size_t k) {
        if (k > 0) return now[k - 1];
        return has_latched_ ? earlier[n - 1] : now[0];
    };
    for (std::size_t k = 0; k < n; ++k) {
        if (!acts_at(fault, start_s + (static_cast<double>(k) + 0.5) * interval_s)) continue;
        float& a = sensor.light_a[k];
        float& b = sensor.light_b[k];
        if (fault.kind == FaultKind::light_stuck) {
            if (fault.size != 1.0) a = before(sensor.light_a, latched_.light_a, k);
            if (fault.size >= 1.0) b = before(sensor.light_b, latched_.light_b, k);
        } else if (fault.kind == FaultKind::light_noisy) {
            const double noise = fault.size * light_level;
            const auto index = static_cast<std::uint32_t>(2 * k);
            a += static_cast<float>(noise * light_noise.gauss(half, index));
            b += static_cast<float>(noise * light_noise.gauss(half, index + 1));
        } else if (fault.kind == FaultKind::light_saturated) {
            a = std::min(a, static_cast<float>(fault.size * light_level));
            b = std::min(b, static_cast<float>(fault.size * light_level));
        } else if (fault.kind == FaultKind::light_nan) {
            a = b = not_a_number;
        }
    }
}

void FrameFaults::spoil_slow(const Fault& fault, core::SensorFrame& sensor) const {
    switch (fault.kind) {
        case FaultKind::piezo_adc_stuck:
            if (has_latched_) sensor.piezo_v = latched_.piezo_v;
            break;
        case FaultKind::piezo_adc_nan: sensor.piezo_v = std::numeric_limits<double>::quiet_NaN(); break;
        case FaultKind::temperature_nan: sensor.temperature_c = std::numeric_limits<double>::quiet_NaN(); break;
        case FaultKind::counter_bit_stuck:
            sensor.counter |= std::uint64_t{1} << static_cast<unsigned>(fault.size);
            break;
        default: break;
    }
}

// A missed frame is delivered as what the receiver still holds, marked as stale.
void FrameFaults::deliver(std::span<const Fault> active, double end_s, core::SensorFrame& sensor) {
    const core::SensorFrame fresh = sensor;
    for (const Fault& fault : active) {
        if (!acts_at(fault, end_s)) continue;
        const bool is_late = fault.kind == FaultKind::frame_late;
        const bool is_first_late = is_late && !(late_before_ && has_latched_);
        if (fault.kind == FaultKind::frame_missed || is_first_late) {
            sensor = delivered_;
            sensor.status |= core::frame_missed;
        } else if (fault.kind == FaultKind::frame_repeated && has_latched_) {
            sensor = delivered_;
        } else if (is_late) {
            sensor = latched_;
        }
    }
    late_before_ = false;
    for (const Fault& fault : active) late_before_ |= fault.kind == FaultKind::frame_late && acts_at(fault, end_s);
    delivered_ = sensor;
    delivered_.status = 0;
    latched_ = fresh;
    has_latched_ = true;
}

}  // namespace zlg::twin
