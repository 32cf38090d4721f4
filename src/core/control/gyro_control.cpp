#include <zlg/core/gyro_control.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "gyro_observation.hpp"

namespace zlg::core {
namespace {

// Readings in a row near an end of the range that call for another mode, and after how many to try again.
constexpr std::int32_t near_proven = 4;
constexpr std::int32_t near_again = 512;

// A temperature that has moved by more than this over the time in which it is followed, some ten thousand halves.
constexpr double warming_c = 0.05;
// A piezo that is so near to its set-point is there; the reading's error is a part of it.
constexpr double rest_lambda = 0.006;
constexpr double temperature_followed = 1.0 / 8192.0;

HalfRecord recorded(const GyroControlState& s, const Observation& o) noexcept {
    // What was found wrong since is of no half's own.
    const bool is_whole = o.valid || (o.reading.span == 1 && !o.left_to_next);
    return {.half = s.half,
            .counts = is_whole ? o.reading.counts : 0,
            .detuning_lambda = o.detuning_usable ? o.monitored.detuning.value() : 0.0,
            .detuning_sq_lambda2 = o.has_mean_square ? o.monitored.mean_sq_lambda2 : 0.0,
            .piezo_v = s.piezo_v,
            .temperature_c = s.temperature_c,
            .bias_sign = o.commuted.sign,
            .mode = o.polarity,
            .loop_closed = o.loop_closed,
            .valid = o.valid,
            .edge_offset_ticks = o.commuted.edge_offset_ticks,
            .span = is_whole ? o.reading.span : 1};
}

// Whether to leave for the middle of the range before it ends. The reading must have come from there since the last try.
bool wants_middle(const GyroControlConfig& c, GyroControlState& s, const Observation& o) noexcept {
    const Volts now = is_finite(o.piezo.value()) ? o.piezo : Volts{s.loop.set_point_v};
    if (!near_end(c.loop.range, now)) {
        s.n_near_end = 0;
        return false;
    }
    if (s.n_near_end < near_again) {
        ++s.n_near_end;
    } else {
        s.n_near_end = near_proven;
    }
    const bool due = s.n_near_end >= near_proven && s.n_near_end <= near_proven + 1;
    return due && !choose_direction(c.loop.range, now, Volts{s.half_wave.estimate_v}).out_of_range;
}

void time_switch(const GyroControlConfig& c, GyroControlState& s, const Observation& o, const SwitchAdvice& advice,
                 ModeSwitchInput& in) noexcept {
    // Blind it would be a switch of unknown outcome, and the rotation would be lost with it.
    const bool ready = s.mode_switch.phase == SwitchPhase::tracking && !s.light_spoilt && o.fresh;
    if (in.tick_border) {
        in.due =
            step(c.schedule, s.schedule, {.tick = in.next_tick, .ready = ready, .mode = o.polarity, .advice = advice})
                .open;
    }
    // A gyro that is not in its mode looks for it instead.
    if (s.mode_switch.phase != SwitchPhase::tracking) return;
    in.recentre = wants_middle(c, s, o) && ready && in.tick_border;
    if (in.recentre || in.due) s.recentring = in.recentre;
}

// Both moves from here, in turn, in halves that end no tick: the next opening finds them two ticks old at most.
void note_start(GyroControlState& s) noexcept {
    if (s.half % 2 != 0 || s.mode_switch.phase != SwitchPhase::tracking) return;
    MoveStart& start = s.half % 4 == 0 ? s.up : s.down;
    start.known = false;
    start.play = s.stroke.play;
    start.piezo_v = s.piezo_v;
    start.temperature_c = s.temperature_c;
}

void predict_move(const GyroControlConfig& c, const StrokeModelState& stroke, std::int8_t sign,
                  MoveStart& start) noexcept {
    if (start.known) return;
    start.known = true;
    start.move_v =
        predicted_move(c.stroke, stroke, start.play, sign, Volts{start.piezo_v}, Celsius{start.temperature_c}).value();
}

// Moves are needed where the loop opens. What they are predicted from is learnt after that, before a mode is tracked again.
void predict_moves(const GyroControlConfig& c, GyroControlState& s, bool opens) noexcept {
    if (!opens && s.mode_switch.phase == SwitchPhase::tracking) return;
    predict_move(c, s.stroke, 1, s.up);
    predict_move(c, s.stroke, -1, s.down);
}

// Where the stage has brought the piezo by the end of an open half, and whether the reading agrees.
void read_flight(const GyroControlConfig& c, const GyroControlState& s, const Observation& o,
                 ModeSwitchInput& in) noexcept {
    const double lambda_per_v = 0.5 / c.loop.half_wave.value();
    const double to_come = lambda_per_v * (s.loop.set_point_v - s.loop.end_v);
    const double off = lambda_per_v * (s.loop.set_point_v - o.piezo.value());
    in.in_flight = Wavelengths{lambda_per_v * (s.loop.set_point_v - s.loop.mean_v)};
    in.at_rest = limited(to_come, rest_lambda) == to_come && limited(off, rest_lambda) == off;
}

ModeSwitchOutput sequence(const GyroControlConfig& c, GyroControlState& s, const Observation& o,
                          const SwitchAdvice& advice) noexcept {
    ModeSwitchInput in;
    in.tick_border = s.half % 2 != 0;
    in.next_tick = (s.half + 1) / 2;
    time_switch(c, s, o, advice, in);
    predict_moves(c, s, in.due || in.recentre);
    in.reversed = o.bias.reversed && o.lit;
    in.light_known = o.fresh && (o.light.readable || o.lit);
    in.two_way = o.lit;
    in.usable = o.detuning_usable;
    in.detuning = o.monitored.detuning;
    in.piezo = o.piezo;
    in.set_point = Volts{s.loop.set_point_v};
    in.half_wave = Volts{0.5 * (s.up.move_v - s.down.move_v)};
    in.offset = Volts{0.5 * (s.up.move_v + s.down.move_v)};
    if (!s.mode_switch.loop_closed) read_flight(c, s, o, in);
    return step(c.mode_switch, s.mode_switch, in);
}

// Says whether the switch taught nothing about the half-wave voltage.
bool learn_half_wave(const GyroControlConfig& c, GyroControlState& s, const ModeSwitchOutput& sequenced) noexcept {
    if (!sequenced.has_event || sequenced.event.outcome != SwitchOutcome::switched) return false;
    const double measured_v = sequenced.event.has_half_wave ? sequenced.event.half_wave_v : __builtin_nan("");
    return step(c.half_wave, s.half_wave, Volts{measured_v}).rejected;
}

// What the move of a switch has come to, as the first closed half shows: mean detuning over a known voltage.
//
// At the closing itself it was dl + kp (v at closing - mean v of the half).
void read_arrival(const GyroControlConfig& c, GyroControlState& s, const Observation& o) noexcept {
    const bool follows = c.loop.kind == LoopKind::digital && c.loop.relock_halves > 0;
    const double mean_v =
        follows ? o.piezo.value() + (s.loop.mean_v - s.loop.end_v) : 0.5 * (s.closed_at_v + o.piezo.value());
    const double beyond_v = s.closed_at_v - mean_v;
    if (!s.closed_read || !o.detuning_usable || !o.loop_closed || !is_finite(beyond_v)) return;
    const double moved_v = s.closed_at_v - s.mode_switch.good_v;
    arrive(c.stroke, s.stroke,
           {.sign = static_cast<std::int8_t>(moved_v > 0.0 ? 1 : -1),
            .piezo = Volts{s.closed_at_v},
            .detuning = Wavelengths{o.monitored.detuning.value() + 0.5 * beyond_v / c.stroke.half_wave.value()},
            .temperature = Celsius{s.temperature_c}});
}

// Follow the piezo through a switch: its start, its arrival, its lock.
void learn_stroke(const GyroControlConfig& c, GyroControlState& s, const Observation& o, bool was_closed,
                  const ModeSwitchOutput& sequenced) noexcept {
    const ModeSwitchState& m = s.mode_switch;
    const bool arrived = was_closed && m.phase == SwitchPhase::settling && m.switching && m.n_halves == 1;
    // The plays must not yet know what the closed loop did.
    if (arrived) read_arrival(c, s, o);
    follow(c.stroke, s.stroke, o.piezo);
    if (!was_closed && sequenced.loop_closed) {
        s.closed_read = plausible(c.loop.range, o.piezo);
        if (s.closed_read) s.closed_at_v = o.piezo.value();
    }
    const bool opens = was_closed && !sequenced.loop_closed && m.phase == SwitchPhase::open;
    if (opens) begin_move(c.stroke, s.stroke, Volts{m.good_v});
    if (!sequenced.has_event) return;
    (void)confirm(c.stroke, s.stroke,
                  sequenced.event.outcome == SwitchOutcome::switched && sequenced.event.has_half_wave);
}

PerimeterLoopOutput regulate(const GyroControlConfig& c, GyroControlState& s, const Observation& o, bool was_closed,
                             const ModeSwitchOutput& sequenced) noexcept {
    return step(c.loop, s.loop,
                {.was_closed = was_closed && o.loop_closed,
                 .close = sequenced.loop_closed,
                 .second_input = sequenced.set_point,
                 .usable = o.detuning_usable,
                 .detuning = o.monitored.detuning,
                 .piezo = o.piezo});
}

bool is_warming_up(GyroControlState& s) noexcept {
    // A reading that is damage does not lead far away.
    const double change_c = limited(s.temperature_c - s.temperature_before_c, 10.0);
    s.temperature_before_c += temperature_followed * change_c;
    return change_c > warming_c || change_c < -warming_c;
}

void report_frame(const SensorFrame& frame, const Observation& o, HealthWord& word) noexcept {
    word.set(health_frame_missed, !o.received);
    word.set(health_sequence_error, o.sequence_error);
    word.set(health_sign_error, o.commuted.sign_error);
    word.set(health_timer_error, o.commuted.timer_error);
    word.set(health_echo_error, o.echo_error);
    word.set(health_piezo_not_finite, o.fresh && !is_finite(frame.piezo_v));
    word.set(health_temperature_not_finite, o.fresh && !is_finite(frame.temperature_c));
}

void report_light(const Observation& o, HealthWord& word) noexcept {
    word.set(health_light_lost, o.fresh && o.light.readable && !o.light.two_way);
    word.set(health_light_unusable, o.fresh && !o.light.readable);
    word.set(health_light_stuck, o.monitored.stuck);
    word.set(health_light_noisy, o.monitored.noisy || o.monitored.withheld);
    word.set(health_light_unbalanced, o.monitored.unbalanced);
    word.set(health_light_contradicted, o.monitored.contradicted);
    word.set(health_detuning_unsteady, o.unsteady);
}

void report_counts(GyroControlState& s, const Observation& o, HealthWord& word) noexcept {
    word.set(health_counter_jump, o.beyond);
    word.set(health_rate_over_range, o.beyond && s.was_beyond);
    s.was_beyond = o.beyond;
    word.set(health_counter_bit_stuck, o.bit_stuck);
    const bool lased = o.lit && o.loop_closed;
    word.set(health_bias_lost, o.bias_wrong);
    word.set(health_helicity_reversed, lased && o.bias.reversed);
    word.set(health_rate_near_bias, lased && o.bias.near_rate);
    word.set(health_coil_current, o.coil.off);
}

void report_phase(const GyroControlState& s, SwitchPhase phase, HealthWord& word) noexcept {
    word.set(health_switching, phase == SwitchPhase::open || phase == SwitchPhase::settling);
    word.set(health_relock_failed, phase == SwitchPhase::returning || phase == SwitchPhase::searching);
    word.set(health_searching, phase == SwitchPhase::searching);
    word.set(health_recentring, s.recentring);
}

void command(bool loop_closed, std::int8_t polarity, const PerimeterLoopOutput& regulated,
             ActuatorFrame& actuator) noexcept {
    actuator.loop_closed = loop_closed;
    actuator.polarity = polarity;
    actuator.n_set_points = static_cast<std::uint8_t>(regulated.n_set_points);
    actuator.set_point_v[0] = regulated.set_point_v[0];
    for (std::size_t k = 1; k < actuator.n_set_points; ++k) actuator.set_point_v[k] = regulated.set_point_v[k];
}

}  // namespace

GyroControlState initial_state(const GyroControlConfig& config, std::uint64_t counter) noexcept {
    GyroControlState s;
    s.loop = initial_state(config.loop, config.mode_switch.start_set_point);
    s.half_wave = initial_state(config.half_wave);
    s.stroke = initial_state(config.stroke, config.mode_switch.start_set_point);
    s.up.move_v = config.stroke.half_wave.value();
    s.down.move_v = -s.up.move_v;
    s.schedule = initial_state(config.schedule);
    s.mode_switch = initial_state(config.mode_switch);
    s.counter = counter;
    s.reading_monitor.good = s.reading_monitor.last = counter;
    s.reading_monitor.mode = config.mode_switch.start_polarity;
    s.piezo_v = config.mode_switch.start_set_point.value();
    s.temperature_c = config.presumed_temperature.value();
    return s;
}

ActuatorFrame initial_actuator(const GyroControlConfig& config) noexcept {
    ActuatorFrame actuator;
    const double start_v = config.mode_switch.start_set_point.value();
    command(true, config.mode_switch.start_polarity, {.set_point_v = {start_v}}, actuator);
    return actuator;
}

GyroControlOutput step(const GyroControlConfig& config, GyroControlState& state, const SensorFrame& frame,
                       const SwitchAdvice& advice) noexcept {
    const SwitchPhase phase = state.mode_switch.phase;
    const bool was_closed = state.mode_switch.loop_closed;

    Observation seen;
    observe(config, state, frame, seen);
    note_start(state);
    const ModeSwitchOutput sequenced = sequence(config, state, seen, advice);
    const bool half_wave_rejected = learn_half_wave(config, state, sequenced);
    learn_stroke(config, state, seen, was_closed, sequenced);
    const PerimeterLoopOutput regulated = regulate(config, state, seen, was_closed, sequenced);

    GyroControlOutput out{.record = recorded(state, seen), .has_event = sequenced.has_event};
    if (sequenced.has_event) out.event = sequenced.event;
    command(sequenced.loop_closed, sequenced.polarity, regulated, out.actuator);
    out.actuator.edge_offset_ticks =
        next_edge(config.commutator, state.commutator,
                  {seen.valid && seen.loop_closed && seen.reading.span == 1, seen.counts, seen.polarity});

    HealthWord word;
    report_frame(frame, seen, word);
    report_light(seen, word);
    report_counts(state, seen, word);
    report_phase(state, phase, word);
    word.set(health_detuning_over_limit, regulated.over_limit);
    word.set(health_piezo_near_range_end, regulated.near_range_end);
    word.set(health_half_wave_rejected, half_wave_rejected);
    word.set(health_warming_up, is_warming_up(state));
    word.set(health_edges_shifted, config.commutator.dither.method != DitherMethod::none);
    out.health = word.bits;

    ++state.half;
    return out;
}

}  // namespace zlg::core
