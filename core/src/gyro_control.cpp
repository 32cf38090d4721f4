#include <zlg/core/gyro_control.hpp>

#include <zlg/core/maths.hpp>

namespace zlg::core {
namespace {

constexpr bool is_sign(std::int8_t x) noexcept { return x == 1 || x == -1; }

// What one frame tells, before anything is decided.
struct Observation {
    bool received = false;
    bool counted = false;  // `counts` are those of this half
    bool sequence_error = false;
    bool polarity_error = false;
    bool echo_error = false;
    std::int8_t polarity = 1;
    bool loop_closed = true;
    std::int64_t counts = 0;
    BiasCommutatorOutput bias;
    SyncDetectorOutput light;
    bool detuning_usable = false;
    Volts piezo{__builtin_nan("")};
};

void read_counter(GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    if (!o.received) {
        s.counter_stale = true;
        ++s.next_sequence;
        return;
    }
    o.sequence_error = s.sequence_known && frame.sequence != s.next_sequence;
    o.counted = !s.counter_stale && !o.sequence_error;
    if (o.counted) o.counts = static_cast<std::int64_t>(frame.counter - s.counter);
    s.counter = frame.counter;
    s.counter_stale = false;
    s.sequence_known = true;
    s.next_sequence = frame.sequence + 1;
}

void read_echoes(const GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    o.polarity = s.mode_switch.polarity;
    o.loop_closed = s.mode_switch.loop_closed;
    if (!o.received) return;
    o.polarity_error = !is_sign(frame.polarity);
    o.echo_error = frame.polarity != o.polarity || frame.loop_closed != o.loop_closed;
    if (!o.polarity_error) o.polarity = frame.polarity;
    o.loop_closed = frame.loop_closed;
}

void read_light(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    if (!o.received) return;
    const std::size_t n = frame.n_light <= max_light_samples ? frame.n_light : 0;
    SyncDetectorInput in;
    in.light_a = std::span{frame.light_a}.first(n);
    if (frame.has_light_b) in.light_b = std::span{frame.light_b}.first(n);
    in.sign = o.bias.sign * o.polarity;
    in.settled = o.loop_closed && s.mode_switch.phase == SwitchPhase::tracking;
    o.light = step(c.detector, s.detector, in);
    o.detuning_usable = o.light.usable && !o.bias.sign_error && !o.polarity_error;
}

void read_slow(GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    if (!o.received) return;
    o.piezo = Volts{frame.piezo_v};
    if (is_finite(frame.piezo_v)) s.piezo_v = frame.piezo_v;
    if (is_finite(frame.temperature_c)) s.temperature_c = frame.temperature_c;
}

Observation observe(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame) noexcept {
    Observation o;
    o.received = (frame.status & frame_missed) == 0;
    o.bias = step(c.commutator, s.commutator,
                  {.received = o.received, .bias_sign = frame.bias_sign, .timer_ticks = frame.timer_ticks});
    read_counter(s, frame, o);
    read_echoes(s, frame, o);
    read_light(c, s, frame, o);
    read_slow(s, frame, o);
    return o;
}

HalfRecord recorded(const GyroControlState& s, const Observation& o) noexcept {
    HalfRecord r;
    r.half = s.half;
    r.counts = o.counts;
    r.detuning_lambda = o.detuning_usable ? o.light.detuning.value() : 0.0;
    r.detuning_sq_lambda2 = o.detuning_usable ? o.light.mean_sq_lambda2 : 0.0;
    r.piezo_v = s.piezo_v;
    r.temperature_c = s.temperature_c;
    r.bias_sign = o.bias.sign;
    r.mode = o.polarity;
    r.loop_closed = o.loop_closed;
    r.valid = o.counted && o.light.two_way && !o.bias.sign_error && !o.polarity_error;
    return r;
}

ModeSwitchOutput sequence(const GyroControlConfig& c, GyroControlState& s, const Observation& o) noexcept {
    ModeSwitchInput in;
    in.tick_border = s.half % 2 != 0;
    in.next_tick = (s.half + 1) / 2;
    if (in.tick_border) {
        in.due = step(c.schedule, s.schedule, in.next_tick, s.mode_switch.phase == SwitchPhase::tracking).open;
    }
    in.light_known = o.received && o.light.readable;
    in.two_way = o.light.two_way;
    in.usable = o.detuning_usable;
    in.detuning = o.light.detuning;
    in.piezo = o.piezo;
    in.set_point = Volts{s.loop.set_point_v};
    in.half_wave = Volts{s.half_wave.estimate_v};
    return step(c.mode_switch, s.mode_switch, in);
}

// Says whether the switch taught nothing about the half-wave voltage.
bool learn_half_wave(const GyroControlConfig& c, GyroControlState& s, const ModeSwitchOutput& sequenced) noexcept {
    if (!sequenced.has_event || sequenced.event.outcome != SwitchOutcome::switched) return false;
    const double measured_v = sequenced.event.has_half_wave ? sequenced.event.half_wave_v : __builtin_nan("");
    return step(c.half_wave, s.half_wave, Volts{measured_v}).rejected;
}

PerimeterLoopOutput regulate(const GyroControlConfig& c, GyroControlState& s, const Observation& o, bool was_closed,
                             const ModeSwitchOutput& sequenced) noexcept {
    return step(c.loop, s.loop,
                {.was_closed = was_closed && o.loop_closed,
                 .close = sequenced.loop_closed,
                 .second_input = sequenced.set_point,
                 .usable = o.detuning_usable,
                 .detuning = o.light.detuning,
                 .piezo = o.piezo});
}

HealthReport reported(const SensorFrame& frame, const Observation& o, SwitchPhase phase) noexcept {
    HealthReport r;
    r.frame_missed = !o.received;
    r.sequence_error = o.sequence_error;
    r.sign_error = o.bias.sign_error;
    r.timer_error = o.bias.timer_error;
    r.echo_error = o.echo_error;
    r.light_lost = o.received && o.light.readable && !o.light.two_way;
    r.light_unusable = o.received && !o.light.readable;
    r.piezo_not_finite = o.received && !is_finite(frame.piezo_v);
    r.temperature_not_finite = o.received && !is_finite(frame.temperature_c);
    r.switching = phase == SwitchPhase::open || phase == SwitchPhase::settling;
    r.relock_failed = phase == SwitchPhase::returning || phase == SwitchPhase::searching;
    r.searching = phase == SwitchPhase::searching;
    r.counts = o.counts;
    return r;
}

void command(bool loop_closed, std::int8_t polarity, Volts set_point, ActuatorFrame& actuator) noexcept {
    actuator.loop_closed = loop_closed;
    actuator.polarity = polarity;
    actuator.n_set_points = 1;
    actuator.set_point_v[0] = set_point.value();
}

}  // namespace

GyroControlState initial_state(const GyroControlConfig& config, std::uint64_t counter) noexcept {
    GyroControlState s;
    s.loop = initial_state(config.loop, config.mode_switch.start_set_point);
    s.half_wave = initial_state(config.half_wave);
    s.schedule = initial_state(config.schedule);
    s.mode_switch = initial_state(config.mode_switch);
    s.counter = counter;
    s.piezo_v = config.mode_switch.start_set_point.value();
    s.temperature_c = config.presumed_temperature.value();
    return s;
}

ActuatorFrame initial_actuator(const GyroControlConfig& config) noexcept {
    ActuatorFrame actuator;
    command(true, config.mode_switch.start_polarity, config.mode_switch.start_set_point, actuator);
    return actuator;
}

GyroControlOutput step(const GyroControlConfig& config, GyroControlState& state, const SensorFrame& frame) noexcept {
    const SwitchPhase phase = state.mode_switch.phase;
    const bool was_closed = state.mode_switch.loop_closed;

    const Observation seen = observe(config, state, frame);
    GyroControlOutput out;
    out.record = recorded(state, seen);

    const ModeSwitchOutput sequenced = sequence(config, state, seen);
    out.has_event = sequenced.has_event;
    out.event = sequenced.event;
    const bool half_wave_rejected = learn_half_wave(config, state, sequenced);
    const PerimeterLoopOutput regulated = regulate(config, state, seen, was_closed, sequenced);
    command(sequenced.loop_closed, sequenced.polarity, regulated.set_point, out.actuator);
    out.actuator.edge_offset_ticks = seen.bias.edge_offset_ticks;

    HealthReport report = reported(frame, seen, phase);
    report.detuning_over_limit = regulated.over_limit;
    report.piezo_near_range_end = regulated.near_range_end;
    report.half_wave_rejected = half_wave_rejected;
    out.health = health_bits(config.health, report);

    ++state.half;
    return out;
}

}  // namespace zlg::core
