#pragma once
// The pulse of a clock outside, against which the ends of the ticks are stamped.

#include <cstdint>

#include <zlg/wire/telemetry.hpp>

namespace zlg::firmware {

// Latched by the timer of the stamps.
struct Pulse {
    std::uint32_t n = 0;            // since the start; 0 where none has come
    std::uint64_t stamp_ticks = 0;  // of the last one
};

// When a tick ended. A pulse after that, or more than 2^32 ticks of the timer before it (seven minutes at 10 MHz), is
// none.
[[nodiscard]] constexpr wire::TickTime time_of(std::uint64_t end_ticks, const Pulse& pulse) noexcept {
    const std::uint64_t since_ticks = end_ticks - pulse.stamp_ticks;
    if (pulse.n == 0 || since_ticks > UINT32_MAX) return {.timer_ticks = end_ticks};
    return {.timer_ticks = end_ticks,
            .synchronised = true,
            .n_pulses = pulse.n,
            .since_pulse_ticks = static_cast<std::uint32_t>(since_ticks)};
}

}  // namespace zlg::firmware
