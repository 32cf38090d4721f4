#pragma once
// Control of the gyro: everything that happens between the latch of one half-period and the command for the next.

#include <cstdint>

#include <zlg/core/control/gyro_control_state.hpp>
#include <zlg/core/control/mode_switch.hpp>
#include <zlg/core/control/switch_schedule.hpp>
#include <zlg/core/health.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

struct GyroControlOutput {
    ActuatorFrame actuator{};   // in force from the start of the next half
    HalfRecord record{};        // of the half just latched; every number finite but a fringe that is not known
    std::uint32_t health = 0;   // of the half just latched, a sum of HealthBit
    bool switch_waits = false;  // one is due, and the gyro is not ready for it
    bool has_event = false;     // a switch, a return or a search ended in a lock
    SwitchEvent event{};
};

// What is commanded for half 0, before any frame: loop closed, at the start's set-point and polarity.
[[nodiscard]] ActuatorFrame initial_actuator(const GyroControlConfig& config) noexcept;

// Advance by one half-period. Call it once per half, also when its frame was missed.
//
// Counts are the difference of two counter readings modulo 2^64, as a signed number. The record takes bias sign, mode
// and loop state from the echoes; where there is none, or it is no sign, from the alternation and the last command.
// Valid is a half with light in both directions, whose frame was received and follows its predecessor, with good signs,
// and to whose counts no monitor objects. Where the light is missing but the bias beats on, the beat is accepted after
// some halves. Counts are 0 in a missed frame, where the frame's number does not follow (nothing in such a frame is
// used), and while a reading may be wrong; the next good half has the difference over all of these, `span` halves. What
// was not measured is recorded as 0; voltage and temperature keep their last finite value.
//
// Where the phase of the fringe is read, each reading is the whole count on that side of a border on which the phase
// lies, and the record holds the place within the count. Where the phase cannot be trusted: the count as read, and no
// place.
//
// A mode of the other helicity than was commanded is kept, and the command follows it. Near an end of its range the
// piezo is led away by an additional switch, outside the schedule.
//
// config   passed `check`.
// state    from `initial_state`; every number in it stays finite, whatever the frames hold.
// advice   what compensation has learnt by now, for a schedule that asks for it.
// latency  a switch at the start of tick j is decided in half 2j - 1: halves 2j .. 2j + 2 gap_ticks - 1 are open, or
// fewer
//          whole ticks where the gap may be shortened (mode_switch.hpp).
// cost     bounded by the number of light samples; no allocation.
[[nodiscard]] GyroControlOutput step(const GyroControlConfig& config, GyroControlState& state, const SensorFrame& frame,
                                     const SwitchAdvice& advice = {}) noexcept;

}  // namespace zlg::core
