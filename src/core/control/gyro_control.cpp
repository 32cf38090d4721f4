#include <zlg/core/gyro_control.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "monitors.hpp"

namespace zlg::core {
namespace {

// A piezo near an end of its range for 4 halves in a row is led to another mode; where that does not happen, again
// every 509 halves.
constexpr std::int32_t near_end_debounce = 4;
constexpr std::int32_t near_end_retry = 512;

// The gyro warms up (or cools) where its temperature differs by more than this from its running mean.
constexpr double warming_c = 0.05;

// The piezo is at rest where what is still to come of its move, and the distance of the reading from the set-point, are
// at most this much perimeter. The second includes the error of the reading.
constexpr double rest_lambda = 0.006;

HalfRecord recorded(const GyroControlState& s, const Observation& o) noexcept {
    // Not recorded: counts that the next valid half will contain, and counts over several halves that are not valid.
    const bool has_counts = o.valid || (o.reading.span == 1 && !o.left_to_next);
    return {.half = s.half,
            .counts = has_counts ? o.reading.counts : 0,
            .detuning_lambda = o.light.usable ? o.light.detuning.value() : 0.0,
            .detuning_sq_lambda2 = o.has_mean_square ? o.light.mean_sq_lambda2 : 0.0,
            .piezo_v = s.piezo_v,
            .temperature_c = s.temperature_c,
            .bias_sign = o.commuted.sign,
            .mode = o.polarity,
            .loop_closed = o.loop_closed,
            .valid = o.valid,
            .edge_offset_ticks = s.commutator.dither.end_ticks,
            .span = has_counts ? o.reading.span : 1,
            .fringe = o.fringe.fringe,
            .lit = o.steady};
}

// Whether the piezo has been near an end of its range for so long that it should be led back towards the middle, and a
// neighbouring mode lies there. Counts the halves near an end, so it is called in every half that tracks a mode; true
// in two halves in a row, of which one ends a tick, and again after `near_end_retry` where the piezo is still there.
bool count_near_end(const GyroControlConfig& c, GyroControlState& s, const Observation& o) noexcept {
    const Volts now = is_finite(o.piezo.value()) ? o.piezo : Volts{s.loop.set_point_v};
    if (!near_end(c.loop.range, now)) {
        s.n_near_end = 0;
        return false;
    }
    s.n_near_end = s.n_near_end < near_end_retry ? s.n_near_end + 1 : near_end_debounce;
    const bool due = s.n_near_end >= near_end_debounce && s.n_near_end <= near_end_debounce + 1;
    return due && !choose_direction(c.loop.range, now, half_wave(s)).out_of_range;
}

void decide_switch(const GyroControlConfig& c, GyroControlState& s, const Observation& o, const SwitchAdvice& advice,
                   ModeSwitchInput& in) noexcept {
    // Without usable light the outcome of a switch would be unknown, and the rotation in its gap would be lost.
    const bool ready = s.mode_switch.phase == SwitchPhase::tracking && !s.light_spoilt && o.order.fresh;
    if (in.tick_border) {
        in.due =
            step(c.schedule, s.schedule, {.tick = in.next_tick, .ready = ready, .mode = o.polarity, .advice = advice});
    }
    // In a switch, a return or a search the ends of the range are not watched.
    if (s.mode_switch.phase != SwitchPhase::tracking) return;
    in.recentre = count_near_end(c, s, o) && ready && in.tick_border;
    if (in.recentre || in.due) s.recentring = in.recentre;
}

// The moves up and down from where the loop opens.
void predict_moves(const GyroControlConfig& c, GyroControlState& s) noexcept {
    const auto move_v = [&](std::int8_t sign) {
        return predicted_move(c.half_wave, s.half_wave, sign, Volts{s.piezo_v}, Celsius{s.temperature_c}).value();
    };
    s.up_v = move_v(1);
    s.down_v = move_v(-1);
}

// Where the stage has brought the piezo by the end of an open half, and whether the reading agrees.
void read_flight(const GyroControlConfig& c, const GyroControlState& s, const Observation& o,
                 ModeSwitchInput& in) noexcept {
    const double lambda_per_v = 0.5 / c.loop.half_wave.value();
    const double to_come = lambda_per_v * (s.loop.set_point_v - s.loop.end_v);
    const double off = lambda_per_v * (s.loop.set_point_v - o.piezo.value());
    in.in_flight = Wavelengths{lambda_per_v * (s.loop.set_point_v - s.loop.mean_v)};
    in.at_rest = size(to_come) <= rest_lambda && size(off) <= rest_lambda;  // false for NaN
}

std::optional<SwitchEvent> sequence(const GyroControlConfig& c, GyroControlState& s, const Observation& o,
                                    const SwitchAdvice& advice) noexcept {
    ModeSwitchInput in;
    in.tick_border = s.half % 2 != 0;
    in.next_tick = (s.half + 1) / 2;
    decide_switch(c, s, o, advice, in);
    if (in.due || in.recentre) predict_moves(c, s);
    in.reversed = o.bias.reversed && o.lit;
    in.light_known = o.order.fresh && (o.light.readable || o.lit);
    in.two_way = o.lit;
    in.usable = o.light.usable;
    in.detuning = o.light.detuning;
    in.piezo = o.piezo;
    in.set_point = Volts{s.loop.set_point_v};
    in.half_wave = half_wave(s);
    in.offset = Volts{0.5 * (s.up_v + s.down_v)};
    if (!s.mode_switch.loop_closed) read_flight(c, s, o, in);
    return step(c.mode_switch, s.mode_switch, in);
}

// Hands the stroke model the detuning at the moment of closing. The first closed half shows its mean detuning dl at a
// known mean voltage; at closing it was dl + (v at closing - mean v of the half)/(2 half-wave voltage). Under fast
// re-lock the voltage leaps within the half: its mean is the reading at the end plus (mean - end) of the model of the
// stage. Otherwise it moves evenly, and its mean is that of both ends.
void read_arrival(const GyroControlConfig& c, GyroControlState& s, const Observation& o) noexcept {
    const bool fast_relock = c.loop.kind == LoopKind::digital && c.loop.relock_halves > 0;
    const double mean_v =
        fast_relock ? o.piezo.value() + (s.loop.mean_v - s.loop.end_v) : 0.5 * (s.closed_at_v + o.piezo.value());
    const double beyond_v = s.closed_at_v - mean_v;
    if (!s.closed_read || !o.light.usable || !o.loop_closed || !is_finite(beyond_v)) return;
    const auto sign = static_cast<std::int8_t>(s.closed_at_v > s.mode_switch.good_v ? 1 : -1);
    const Wavelengths detuning{o.light.detuning.value() + 0.5 * beyond_v / c.half_wave.half_wave.value()};
    arrive(c.half_wave, s.half_wave, sign, Volts{s.closed_at_v}, detuning, Celsius{s.temperature_c});
}

// Follow the piezo through a switch: its start, its arrival, its lock.
void learn_stroke(const GyroControlConfig& c, GyroControlState& s, Observation& o, bool was_closed,
                  const std::optional<SwitchEvent>& event) noexcept {
    const ModeSwitchState& m = s.mode_switch;
    const bool arrived = was_closed && m.phase == SwitchPhase::settling && m.switching && m.n_halves == 1;
    // Before the plays follow the voltages of the closed loop.
    if (arrived) read_arrival(c, s, o);
    follow(c.half_wave, s.half_wave, o.piezo);
    if (!was_closed && m.loop_closed) {
        s.closed_read = plausible(c.loop.range, o.piezo);
        if (s.closed_read) s.closed_at_v = o.piezo.value();
    }
    if (was_closed && !m.loop_closed && m.phase == SwitchPhase::open)
        begin_move(c.half_wave, s.half_wave, Volts{m.good_v});
    if (!event) return;
    const bool switched = event->outcome == SwitchOutcome::switched;
    const bool learnt = confirm(s.half_wave, switched && event->has_half_wave);
    o.half_wave_rejected = switched && !(event->has_half_wave && learnt);
}

PerimeterLoopOutput regulate(const GyroControlConfig& c, GyroControlState& s, const Observation& o,
                             bool was_closed) noexcept {
    return step(c.loop, s.loop,
                {.was_closed = was_closed && o.loop_closed,
                 .close = s.mode_switch.loop_closed,
                 .second_input = Volts{s.mode_switch.set_point_v},
                 .usable = o.light.usable,
                 .detuning = o.light.detuning,
                 .piezo = o.piezo});
}

// Follows the temperature by one half. Returns whether the gyro warms up.
bool track_warming(GyroControlState& s) noexcept {
    // Limited, so that a damaged reading does not pull the mean far away.
    const double change_c = limited(s.temperature_c - s.mean_temperature_c, 10.0);
    s.mean_temperature_c += temperature_weight * change_c;
    return change_c > warming_c || change_c < -warming_c;
}

void command(const ModeSwitchState& m, const PerimeterLoopOutput& regulated, ActuatorFrame& actuator) noexcept {
    actuator.loop_closed = m.loop_closed;
    actuator.polarity = m.polarity;
    actuator.n_set_points = static_cast<std::uint8_t>(regulated.n_set_points);
    for (std::size_t k = 0; k < actuator.n_set_points; ++k) actuator.set_point_v[k] = regulated.set_point_v[k];
}

}  // namespace

GyroControlState initial_state(const GyroControlConfig& config, std::uint64_t counter) noexcept {
    GyroControlState s;
    s.loop = initial_state(config.loop, config.mode_switch.start_set_point);
    s.half_wave = initial_state(config.half_wave, config.mode_switch.start_set_point);
    s.up_v = config.half_wave.half_wave.value();
    s.down_v = -s.up_v;
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
    command(initial_state(config.mode_switch), {.set_point_v = {config.mode_switch.start_set_point.value()}}, actuator);
    return actuator;
}

GyroControlOutput step(const GyroControlConfig& config, GyroControlState& state, const SensorFrame& frame,
                       const SwitchAdvice& advice) noexcept {
    const bool was_closed = state.mode_switch.loop_closed;
    Observation seen;
    seen.phase = state.mode_switch.phase;
    observe(config, state, frame, seen);
    const std::optional<SwitchEvent> event = sequence(config, state, seen, advice);
    learn_stroke(config, state, seen, was_closed, event);
    // Not kept in the observation: a copy of all its set-points would cost more than the loop.
    const PerimeterLoopOutput regulated = regulate(config, state, seen, was_closed);
    seen.over_limit = regulated.over_limit;
    seen.near_range_end = regulated.near_range_end;
    seen.warms_up = track_warming(state);

    GyroControlOutput out{
        .record = recorded(state, seen), .health = health_word(config, state, seen), .has_event = event.has_value()};
    if (event) out.event = *event;
    out.switch_waits = state.schedule.waiting;
    state.was_beyond = seen.beyond;
    command(state.mode_switch, regulated, out.actuator);
    const bool counted = seen.valid && seen.loop_closed && seen.reading.span == 1;
    out.actuator.edge_offset_ticks =
        next_edge(config.commutator, state.commutator, {counted, seen.counts, seen.polarity});
    ++state.half;
    return out;
}

}  // namespace zlg::core
