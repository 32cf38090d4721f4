#pragma once
// Control of the gyro: everything that happens between the latch of one half-period and the command for the next.

#include <cstdint>

#include <zlg/core/bias_commutator.hpp>
#include <zlg/core/half_wave.hpp>
#include <zlg/core/health.hpp>
#include <zlg/core/mode_switch.hpp>
#include <zlg/core/perimeter_loop.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/switch_schedule.hpp>
#include <zlg/core/sync_detector.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct GyroControlConfig {
    SyncDetectorConfig detector{};
    PerimeterLoopConfig loop{};
    HalfWaveConfig half_wave{};
    SwitchScheduleConfig schedule{};
    ModeSwitchConfig mode_switch{};  // its range is that of `loop`
    BiasCommutatorConfig commutator{};
    HealthConfig health{};
    Celsius presumed_temperature{20.0};  // recorded until the first reading
};

enum class GyroControlFault : unsigned char {
    none,
    detector,
    loop,
    half_wave,
    schedule,
    mode_switch,
    commutator,
    health,
    temperature,
    ranges_differ
};

[[nodiscard]] constexpr GyroControlFault check(const GyroControlConfig& c) noexcept {
    const double temperature_c = c.presumed_temperature.value();
    if (check(c.detector) != SyncDetectorFault::none) return GyroControlFault::detector;
    if (check(c.loop) != PerimeterLoopFault::none) return GyroControlFault::loop;
    if (check(c.half_wave) != HalfWaveFault::none) return GyroControlFault::half_wave;
    if (check(c.schedule) != SwitchScheduleFault::none) return GyroControlFault::schedule;
    if (check(c.mode_switch) != ModeSwitchFault::none) return GyroControlFault::mode_switch;
    if (check(c.commutator) != BiasCommutatorFault::none) return GyroControlFault::commutator;
    if (check(c.health) != HealthFault::none) return GyroControlFault::health;
    if (!(temperature_c > -1e6 && temperature_c < 1e6)) return GyroControlFault::temperature;
    if (!(c.loop.range == c.mode_switch.range)) return GyroControlFault::ranges_differ;
    return GyroControlFault::none;
}

struct GyroControlState {
    SyncDetectorState detector{};
    PerimeterLoopState loop{};
    HalfWaveState half_wave{};
    SwitchScheduleState schedule{};
    ModeSwitchState mode_switch{};
    BiasCommutatorState commutator{};
    std::int64_t half = 0;       // index of the half that is latched next; 2j and 2j + 1 make tick j
    std::uint64_t counter = 0;   // reading at the end of the last half
    bool counter_stale = false;  // no: at the end of an earlier one
    bool sequence_known = false;
    std::uint32_t next_sequence = 0;
    double piezo_v = 0.0;  // last finite reading; so is the next
    double temperature_c = 0.0;

    friend constexpr bool operator==(const GyroControlState&, const GyroControlState&) = default;
};

struct GyroControlOutput {
    ActuatorFrame actuator{};  // in force from the start of the next half
    HalfRecord record{};       // of the half just latched; every number finite
    std::uint32_t health = 0;  // of the half just latched, a sum of HealthBit
    bool has_event = false;    // a switch, a return or a search ended in a lock
    SwitchEvent event{};
};

// The state before the first half.
//
// counter  reading of the fringe counter when the first half begins: the first record's counts are relative to it.
[[nodiscard]] GyroControlState initial_state(const GyroControlConfig& config, std::uint64_t counter = 0) noexcept;

// What is commanded for half 0, before any frame: loop closed, at the start's set-point and polarity.
[[nodiscard]] ActuatorFrame initial_actuator(const GyroControlConfig& config) noexcept;

// Advance by one half-period. Call it once per half, also when its frame was missed.
//
// Counts are the difference of two counter readings modulo 2^64, as a signed number. The record takes bias sign, mode
// and loop state from the echoes; where there is none, or it is no sign, from the alternation and the last command.
// Valid is a half with light in both directions, whose frame was received and follows its predecessor, with good signs.
// Counts are 0 where the difference spans more than this half: in a missed frame, in the next one, and where the
// frame's number does not follow. What was not measured is recorded as 0; voltage and temperature keep their last
// finite value.
//
// config   passed `check`.
// state    from `initial_state`; every number in it stays finite, whatever the frames hold.
// latency  a switch at the start of tick j is decided in half 2j - 1: halves 2j .. 2j + 2 gap_ticks - 1 are open.
// cost     bounded by the number of light samples; no allocation.
[[nodiscard]] GyroControlOutput step(const GyroControlConfig& config, GyroControlState& state,
                                     const SensorFrame& frame) noexcept;

}  // namespace zlg::core
