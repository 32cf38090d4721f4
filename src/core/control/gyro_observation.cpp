#include "gyro_observation.hpp"

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr bool is_sign(std::int8_t x) noexcept { return x == 1 || x == -1; }

void read_order(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    o.received = (frame.status & frame_missed) == 0;
    // Only a number out of order is judged by its time.
    const bool on_time =
        frame.sequence != s.order.expected && is_on_time(c.commutator, s.commutator, frame.timer_ticks);
    const FrameOrderOutput order = step(s.order, o.received, frame.sequence, on_time);
    o.sequence_error = order.error;
    o.fresh = order.fresh;
    o.follows = order.follows;
    o.counted = order.follows && !s.counter_stale;
    s.counter_stale = !o.fresh;
}

// Of the half just latched over the nominal one, from reversal to reversal.
double length_ratio(const BiasCommutatorConfig& c, const BiasCommutatorState& s) noexcept {
    const std::int32_t longer_ticks = s.dither.end_ticks - s.dither.start_ticks;
    return longer_ticks == 0 ? 1.0 : 1.0 + longer_ticks / static_cast<double>(c.half_ticks);
}

// The count, from the side that the phase names. Apart, so that a gyro of whole counts need not save its registers.
[[gnu::noinline]] void read_fringe(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame,
                                   Observation& o) noexcept {
    o.fringe = step(c.fringe, s.fringe,
                    {.present = o.fresh && frame.has_fringe,
                     .c = frame.fringe_c,
                     .s = frame.fringe_s,
                     .quarter = frame.fringe_quarter,
                     .counter = frame.counter,
                     .settled = o.settled,
                     .sign = o.commuted.sign * o.polarity,
                     .rotation_counts = s.bias_monitor.counts + s.bias_monitor.counts_before});
}

void read_counter(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    if (o.counted) o.counts = static_cast<std::int64_t>(o.fringe.counter - s.counter);
    if (o.fresh) s.counter = o.fringe.counter;
    o.max_counts = max_counts(c.health, length_ratio(c.commutator, s.commutator));
    o.beyond = is_beyond(o.counts, o.max_counts);
}

void read_echoes(const GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    o.polarity = s.mode_switch.polarity;
    o.loop_closed = s.mode_switch.loop_closed;
    if (o.fresh) {
        o.polarity_error = !is_sign(frame.polarity);
        o.echo_error = frame.polarity != o.polarity || frame.loop_closed != o.loop_closed;
        if (!o.polarity_error) o.polarity = frame.polarity;
        o.loop_closed = frame.loop_closed;
    }
    o.settled = o.loop_closed && s.mode_switch.phase == SwitchPhase::tracking;
}

void read_bias(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    const bool good = o.counted && !o.beyond && !o.commuted.sign_error && !o.polarity_error;
    o.bias = step(c.bias_monitor, s.bias_monitor,
                  {.counted = good,
                   .counts = o.counts,
                   .beat_sign = static_cast<std::int8_t>(o.commuted.sign * o.polarity),
                   .settled = o.settled && s.was_lit});
    // A half without light makes the difference to the next one meaningless.
    const bool was_lit = s.was_lit || (o.loop_closed && s.was_steady);
    o.bias_wrong = o.bias.judged && !o.bias.in_band && was_lit;
    if (!o.fresh) return;
    o.coil = step(c.coil_monitor, s.coil_monitor, o.commuted.sign, frame.coil_current_a);
}

// Of one half; more than noise, and .03 wavelength of the paper's gyro.
constexpr double unsure_signal = 0.01;

void read_light(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    if (!o.fresh) {
        s.light_monitor.has_last = false;
        return;
    }
    const std::size_t n = frame.n_light <= max_light_samples ? frame.n_light : 0;
    const std::span light_a = std::span{frame.light_a}.first(n);
    const std::span light_b = frame.has_light_b ? std::span{frame.light_b}.first(n) : std::span<const float>{};
    const BeamWeight weight_b = weight_of(s.light_balance);
    const int sign = o.commuted.sign * o.polarity;
    const bool beats = o.bias.judged && o.bias.in_band;
    o.light = step(c.detector, s.detector, {light_a, light_b, sign, weight_b, o.settled && !s.light_spoilt, beats});
    BalancedHalf half{.is_first = s.half % 2 == 0,
                      .is_read = o.loop_closed && o.follows && o.light.usable && !light_b.empty() &&
                                 !o.commuted.sign_error && !o.polarity_error,
                      .signal = o.light.signal,
                      .light = o.light.light};
    const double per_lambda = c.detector.discriminator_per_lambda;
    o.monitored = step(c.light_monitor, s.light_monitor,
                       {.light_a = light_a,
                        .light_b = light_b,
                        .weight_b = weight_b,
                        .sign = sign,
                        .closed = o.loop_closed,
                        .settled = o.settled,
                        .beats = beats,
                        .deficit_ratio = o.bias.deficit_ratio,
                        .two_way = o.light.two_way,
                        .dark = o.light.dark,
                        .light = o.light.light,
                        .signal_per_lambda = per_lambda,
                        .curve = &c.detector.curve,
                        .unknown_lambda2 = o.settled ? 0.0 : unknown_jump_lambda2(s.light_balance, half, per_lambda),
                        .usable = o.light.usable && !o.commuted.sign_error && !o.polarity_error,
                        .detuning = o.light.detuning,
                        .mean_sq_lambda2 = o.light.mean_sq_lambda2});
    half.is_read = half.is_read && !o.monitored.stuck && !o.monitored.noisy;
    // The jump of a beam that has faded is not that of an offset.
    if (o.monitored.has_jump && half.is_read && !s.light_monitor.is_unbalanced)
        learn_offset(s.light_balance, half, s.light_monitor.jump, per_lambda);
    // Where the balance of the beams is not known, one half alone does not tell it from a detuning.
    const bool is_first = !light_b.empty() && s.light_balance.n_ticks == 0.0 && !s.light_balance.has_last &&
                          size(o.light.signal) > unsure_signal;
    follow(c.light_balance, s.light_balance, half);
    o.detuning_usable = o.monitored.usable && !is_first;
    o.lit = o.light.two_way || o.monitored.contradicted;
    s.light_spoilt = o.monitored.stuck || o.monitored.noisy || o.monitored.unbalanced || o.monitored.contradicted;
}

void read_slow(GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    if (!o.fresh) return;
    o.piezo = Volts{frame.piezo_v};
    if (is_finite(frame.piezo_v)) s.piezo_v = frame.piezo_v;
    if (!is_finite(frame.temperature_c)) return;
    s.temperature_c = frame.temperature_c;
    if (!s.temperature_known) s.mean_temperature_c = s.temperature_c;
    s.temperature_known = true;
}

// The counter is judged only by counts of a gyro that lases in its mode.
void read_bits(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    const bool beats = o.counted && o.lit && o.loop_closed && s.was_lit;
    o.bit_stuck = step(c.counter_monitor, s.counter_monitor, beats, frame.counter);
}

// Good signs, and latched in time.
bool is_echoed(const Observation& o) noexcept {
    return !o.commuted.sign_error && !o.polarity_error && !o.commuted.latch_error;
}

// Half of the bias is gone, or it is that of the other helicity: b by the last two halves. A wrong reading seldom looks
// so. Asked only while a reading waits for its judgement.
bool is_lost_or_reversed(const BiasMonitorState& s) noexcept {
    const double b = 0.5 * s.beat_sign * as_double(s.counts - s.counts_before);
    return b < 0.5 * s.bias_counts && b > -1.25 * s.bias_counts;
}

void read_span(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    // What does not follow begins anew, whether or not it can be read: so many halves lie between.
    const bool found = !o.fresh || (o.follows && o.lit && !o.coil.off && !o.coil.unbalanced);
    const BiasMonitorState& bias = s.bias_monitor;
    o.reading = step(s.reading_monitor,
                     {.read = o.fresh && is_echoed(o) && !o.bit_stuck,
                      .follows = o.follows,
                      .countable = o.loop_closed && found,
                      .mode = o.polarity,
                      .suspicious = o.beyond || o.bias_wrong,
                      .agrees = o.counted && !o.beyond && !(o.bias.judged && !o.bias.in_band),
                      .bias_lost = s.reading_monitor.suspected && o.bias.judged && is_lost_or_reversed(bias),
                      .reading = o.fringe.counter,
                      .max_counts = o.max_counts,
                      .bias_counts = bias.bias_counts > 0.0 ? bias.bias_counts : c.bias_monitor.presumed_counts,
                      .beat_sign = static_cast<std::int8_t>(o.commuted.sign * o.polarity)});
}

// A re-lock is corrected by both halves of a tick: one without the other would be worse than none.
void match_halves(GyroControlState& s, Observation& o) noexcept {
    o.has_mean_square = o.detuning_usable && o.monitored.has_mean_square;
    const bool is_first = s.half % 2 == 0;
    if (is_first) {
        s.first_was_blind = o.valid && !o.has_mean_square;
        s.first_was_seen = o.valid && o.has_mean_square;
        return;
    }
    if (s.first_was_blind) {
        o.has_mean_square = false;
    } else if (s.first_was_seen && !o.has_mean_square) {
        o.valid = false;
    }
}

void judge(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    const bool countable = o.reading.trusted && is_echoed(o) && !o.beyond && !o.bit_stuck && !o.coil.unbalanced;
    const bool lased = o.lit && o.loop_closed;
    if (lased && (o.bias.lost || o.bias.reversed)) o.bias_wrong = true;
    o.valid = countable && o.lit && !o.bias_wrong && !o.monitored.returns;
    match_halves(s, o);
    // Away from a lock the detuning moves: without its mean square the false angle would stay unnoticed.
    if ((s.light_spoilt || o.monitored.withheld) && !o.has_mean_square && !o.settled) o.valid = false;
    o.unsteady = step(c.detuning_monitor, s.detuning_monitor,
                      {.is_second = s.half % 2 != 0,
                       .is_good = o.valid && o.loop_closed,
                       .is_settled = o.settled,
                       .is_known = o.has_mean_square,
                       .mean_sq_lambda2 = o.monitored.mean_sq_lambda2});
    if (o.unsteady) o.valid = false;
    s.was_lit = o.lit && o.loop_closed && o.counted;
}

// Change of the detuning within a half, rms, up to which it counts as steady.
constexpr double steady_lambda = 0.05;

// In an open loop the record has the mode that is sent for, but at first the light is still that of the one before: the
// way between them is dark, or else the bias must be that of the new mode.
void judge_steadiness(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    s.was_dark = !o.loop_closed && (s.was_dark || (o.fresh && !o.light.two_way));
    if (!o.valid || !o.has_mean_square || o.reading.span != 1) return;
    if (!o.loop_closed && !s.was_dark && !(o.bias.judged && o.bias.in_band)) return;
    const double mean = o.monitored.detuning.value();
    const double noise = c.light_monitor.noise.value();
    o.steady = o.monitored.mean_sq_lambda2 - mean * mean <= steady_lambda * steady_lambda + noise * noise;
}

// The counts of a half that is not valid are good all the same. But where the detuning moves they hold a false angle:
// such a half is bridged, unless it covers others, too.
void leave_counts(GyroControlState& s, Observation& o) noexcept {
    const bool is_false = o.unsteady || !o.settled;
    o.left_to_next = o.reading.continues && !o.valid && (o.reading.span > 1 || !is_false);
    if (o.left_to_next) leave_to_next(s.reading_monitor, o.reading);
}

}  // namespace

void observe(const GyroControlConfig& config, GyroControlState& state, const SensorFrame& frame,
             Observation& seen) noexcept {
    read_order(config, state, frame, seen);
    seen.commuted = step(config.commutator, state.commutator,
                         {.received = seen.fresh, .bias_sign = frame.bias_sign, .timer_ticks = frame.timer_ticks});
    read_echoes(state, frame, seen);
    seen.fringe.counter = frame.counter;
    if (config.fringe.reads) read_fringe(config, state, frame, seen);
    read_counter(config, state, seen);
    read_bias(config, state, frame, seen);
    read_light(config, state, frame, seen);
    read_slow(state, frame, seen);
    read_bits(config, state, frame, seen);
    read_span(config, state, seen);
    judge(config, state, seen);
    judge_steadiness(config, state, seen);
    state.was_steady = seen.steady;
    leave_counts(state, seen);
}

}  // namespace zlg::core
