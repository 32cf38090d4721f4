#pragma once
// What control is set to, and all that it remembers from half to half.

#include <cstdint>

#include <zlg/core/control/bias_commutator.hpp>
#include <zlg/core/control/bias_monitor.hpp>
#include <zlg/core/control/coil_monitor.hpp>
#include <zlg/core/control/counter_monitor.hpp>
#include <zlg/core/control/detuning_monitor.hpp>
#include <zlg/core/control/frame_order.hpp>
#include <zlg/core/control/fringe_readout.hpp>
#include <zlg/core/control/half_wave.hpp>
#include <zlg/core/control/light_balance.hpp>
#include <zlg/core/control/light_monitor.hpp>
#include <zlg/core/control/mode_switch.hpp>
#include <zlg/core/control/monitor_limits.hpp>
#include <zlg/core/control/perimeter_loop.hpp>
#include <zlg/core/control/reading_monitor.hpp>
#include <zlg/core/control/switch_schedule.hpp>
#include <zlg/core/control/sync_detector.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

// Of the running mean of the temperature: its time constant is 8192 halves, 20 s.
inline constexpr double temperature_weight = 1.0 / 8192.0;

// Large arrays come last, here and in the state: an instruction of the processor reaches 1 KB from the start.
struct GyroControlConfig {
    PerimeterLoopConfig loop{};
    HalfWaveConfig half_wave{};  // its range is that of `loop`
    SwitchScheduleConfig schedule{};
    ModeSwitchConfig mode_switch{};  // its range is that of `loop`
    BiasCommutatorConfig commutator{};
    MonitorLimits limits{};
    FringeReadoutConfig fringe{};
    Celsius presumed_temperature{20.0};  // recorded until the first reading
    SyncDetectorConfig detector{};
};

enum class GyroControlFault : unsigned char {
    none,
    detector,
    loop,
    half_wave,
    schedule,
    mode_switch,
    commutator,
    monitors,
    temperature,
    ranges_differ,
    fringe
};

[[nodiscard]] constexpr GyroControlFault check(const GyroControlConfig& c) noexcept {
    if (!is_allowed(c.detector)) return GyroControlFault::detector;
    if (!is_allowed(c.loop)) return GyroControlFault::loop;
    if (!is_allowed(c.half_wave)) return GyroControlFault::half_wave;
    if (!is_allowed(c.schedule)) return GyroControlFault::schedule;
    if (!is_allowed(c.mode_switch)) return GyroControlFault::mode_switch;
    if (!is_allowed(c.commutator)) return GyroControlFault::commutator;
    if (!is_allowed(c.limits)) return GyroControlFault::monitors;
    if (!(c.presumed_temperature > Celsius{-1e6} && c.presumed_temperature < Celsius{1e6}))
        return GyroControlFault::temperature;
    if (!(c.loop.range == c.mode_switch.range && c.loop.range == c.half_wave.range))
        return GyroControlFault::ranges_differ;
    if (!is_allowed(c.fringe)) return GyroControlFault::fringe;
    return GyroControlFault::none;
}

struct GyroControlState {
    SyncDetectorState detector{};
    PerimeterLoopState loop{};
    double closed_at_v = 0.0;  // reading of the piezo when the loop was closed last,
    bool closed_read = false;  // if there was one
    SwitchScheduleState schedule{};
    ModeSwitchState mode_switch{};
    BiasCommutatorState commutator{};
    std::int64_t half = 0;       // index of the half that is latched next; 2j and 2j + 1 make tick j
    std::uint64_t counter = 0;   // reading at the end of the last half
    bool counter_stale = false;  // `counter` is that of an earlier half: the last frame was not fresh
    FrameOrderState order{};
    BiasMonitorState bias_monitor{};
    CoilMonitorState coil_monitor{};
    CounterMonitorState counter_monitor{};
    ReadingMonitorState reading_monitor{};
    LightBalanceState light_balance{};
    LightMonitorState light_monitor{};
    DetuningMonitorState detuning_monitor{};
    FringeReadoutState fringe{};
    bool was_lit = false;          // the last half was counted, closed and lit
    bool was_steady = false;       // both beams were lit and steady throughout the last half
    bool was_dark = false;         // a half since the loop was opened showed no light in both directions
    bool first_was_blind = false;  // the first half of the tick was valid, without a mean square of the detuning;
    bool first_was_seen = false;   // with one
    bool was_beyond = false;       // the last half had more counts than the gyro can make
    bool light_spoilt = false;     // its light was not to be trusted
    bool recentring = false;       // the last switch led away from an end of the range
    std::int32_t n_near_end = 0;   // halves in a row with the piezo near an end of its range; from 512 on again from 4
    bool temperature_known = false;
    double mean_temperature_c = 0.0;  // running mean
    double piezo_v = 0.0;             // last finite reading
    double temperature_c = 0.0;       // last finite reading
    double up_v = 0.0;                // the moves up and down that were predicted last
    double down_v = 0.0;
    HalfWaveState half_wave{};

    friend constexpr bool operator==(const GyroControlState&, const GyroControlState&) = default;
};

// The half-wave voltage U_lambda/2 by the moves up and down that were predicted last.
[[nodiscard]] constexpr Volts half_wave(const GyroControlState& s) noexcept { return Volts{0.5 * (s.up_v - s.down_v)}; }

// The state before the first half.
//
// counter  reading of the fringe counter when the first half begins: the first record's counts are relative to it.
[[nodiscard]] GyroControlState initial_state(const GyroControlConfig& config, std::uint64_t counter = 0) noexcept;

}  // namespace zlg::core
