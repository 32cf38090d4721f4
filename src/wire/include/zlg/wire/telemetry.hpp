#pragma once
// The message of every tick: what real time needs of this tick, and all that the log needs of the tick that is settled
// now.

#include <cstdint>
#include <optional>

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/records.hpp>
#include <zlg/wire/angle_register.hpp>
#include <zlg/wire/frame.hpp>

namespace zlg::wire {

// When the tick ended, by the gyro's timer and against the pulse of a clock outside.
struct TickTime {
    std::uint64_t timer_ticks = 0;        // free-running
    bool synchronised = false;            // a pulse has come since the start: the next two are known
    std::uint32_t n_pulses = 0;           // since the start, wraps
    std::uint32_t since_pulse_ticks = 0;  // of the timer, from the last pulse to the end of the tick

    friend bool operator==(const TickTime&, const TickTime&) = default;
};

// A tick outside of these is no gyro's; so says the configuration.
inline constexpr double min_tick_s = 1e-6;
inline constexpr double max_tick_s = 10.0;

// The compensation settles every tick within so many.
inline constexpr std::uint16_t max_settled_age_ticks = core::most_final_delay_ticks;

struct Telemetry {
    std::uint32_t tick = 0;               // since the start of the gyro, wraps
    bool has_tick = true;                 // false: the gyro has stopped measuring and tells what is settled later
    bool has_settled = false;             // the settled row below is there
    std::uint16_t settled_age_ticks = 0;  // its tick is that much older than `tick`; fixed in a run
    std::int8_t mode = 1;
    std::uint32_t flags = 0;     // of `tick`, as far as known, a sum of core::AngleFlag
    double dtheta_arcsec = 0.0;  // of `tick`, as real time takes it
    std::uint64_t angle = 0;     // sum of dtheta up to and with `tick`, an angle register
    std::int8_t settled_mode = 1;
    std::uint32_t settled_flags = 0;
    double settled_dtheta_arcsec = 0.0;  // the same as was sent with that tick
    double settled_final_arcsec = 0.0;   // the best increment for it
    double settled_sigma_arcsec = 0.0;   // one standard deviation of that, 0 or more, may be inf
    std::uint64_t settled_angle = 0;     // sums up to and with the settled tick
    std::uint64_t settled_final_angle = 0;
    std::uint32_t health = 0;  // a sum of core::HealthBit, of both halves
    float temperature_c = 0.0f;
    double tick_s = 0.0;  // length of a tick, > 0
    TickTime time{};

    friend bool operator==(const Telemetry&, const Telemetry&) = default;
};

// The registers from which the messages are made.
struct TelemetryState {
    AngleRegister angle{};
    AngleRegister settled_angle{};
    AngleRegister settled_final_angle{};
    std::int64_t tick = 0;  // of the last sample

    friend bool operator==(const TelemetryState&, const TelemetryState&) = default;
};

// What is known at the end of a tick beside the angle.
struct TickReport {
    std::int8_t mode = 1;      // of the tick's second half, as recorded
    std::uint32_t health = 0;  // of both halves
    double temperature_c = 0.0;
    double tick_s = 0.005;
    TickTime time{};
};

// The message of one tick. To be called once for each sample, in order.
[[nodiscard]] Telemetry telemetry_of(TelemetryState& state, const core::AngleSample& sample,
                                     const TickReport& report) noexcept;

// The message of one row that is settled after the last tick, when measuring has stopped.
[[nodiscard]] Telemetry telemetry_of(TelemetryState& state, const core::AngleRow& row,
                                     const TickReport& report) noexcept;

// Ticks without a message of their own: their sums are part of the next message. `of_them` was all zeros before the
// first of them.
void skip(TelemetryState& state, const TelemetryState& of_them) noexcept;

[[nodiscard]] Frame frame_of(Sender& sender, const Telemetry& telemetry) noexcept;

// Nothing where the message is of another type or length, or holds what no gyro sends: an angle that is not finite, a
// negative sigma, a tick of an impossible length, a bit or byte that must be 0.
[[nodiscard]] std::optional<Telemetry> telemetry_in(const Message& message) noexcept;

}  // namespace zlg::wire
