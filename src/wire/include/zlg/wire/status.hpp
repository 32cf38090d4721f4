#pragma once
// The slow message: how the gyro is, about once a second and when it is asked for.

#include <cstdint>
#include <optional>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/wire/frame.hpp>

namespace zlg::wire {

struct Status {
    std::uint32_t tick = 0;     // the last one, wraps
    double tick_s = 0.0;        // length of a tick
    double scale_arcsec = 0.0;  // of a count
    double timer_hz = 0.0;      // of the time stamps
    core::SwitchPhase phase = core::SwitchPhase::settling;
    bool loop_closed = false;      // command in force
    std::int8_t polarity = 1;      // helicity commanded
    bool held = false;             // scheduled switching is stopped
    bool asked = false;            // a forced switch waits until the gyro is ready
    std::uint32_t health = 0;      // of the last half
    std::uint32_t n_switches = 0;  // completed, wraps; and
    std::uint32_t n_failed = 0;    // returns and searches
    std::uint8_t n_late = 0;       // estimates of switches that were not there when they were due, wraps
    float half_wave_v = 0.0f;      // U_lambda/2 as learnt, one standard deviation of it
    float half_wave_sigma_v = 0.0f;
    float piezo_v = 0.0f;  // last readings
    float temperature_c = 0.0f;
    float detuning_lambda = 0.0f;        // smoothed, in lock
    float magnetic_arcsec_s = 0.0f;      // drift that is still in the angle, as measured; 0: not known
    float switch_error_arcsec = 0.0f;    // rms of what a switch leaves, as measured; 0: not known
    std::uint32_t settings_crc = 0;      // of what the gyro runs by, as it is stored
    std::uint32_t n_received = 0;        // frames from the host: good,
    std::uint32_t n_damaged = 0;         // and damaged
    std::uint32_t n_overruns = 0;        // halves whose work was not done when the next one ended
    std::uint32_t stack_used_bytes = 0;  // the most so far; 0: not measured
    std::uint32_t last_fault = 0;        // why the start before this one ended, a code of the board; 0: power

    friend bool operator==(const Status&, const Status&) = default;
};

// What the core knows; the counters of frames, switches and of the board are the caller's.
[[nodiscard]] Status status_of(const core::GyroControlState& control, const core::GyroCompensationState& compensation,
                               const core::GyroCompensationConfig& config) noexcept;

[[nodiscard]] Frame frame_of(Sender& sender, const Status& status) noexcept;

// Nothing where the message is of another type or length, or holds what no gyro sends.
[[nodiscard]] std::optional<Status> status_in(const Message& message) noexcept;

}  // namespace zlg::wire
