#include "gyro_observation.hpp"

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "monitors.hpp"

namespace zlg::core {
namespace {

constexpr bool is_sign(std::int8_t x) noexcept { return x == 1 || x == -1; }

void read_order(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    o.received = (frame.status & frame_missed) == 0;
    // Only a number out of order is judged by its time.
    const bool on_time =
        frame.sequence != s.order.expected && is_on_time(c.commutator, s.commutator, frame.timer_ticks);
    o.order = step(s.order, o.received, frame.sequence, on_time);
    o.counted = o.order.follows && !s.counter_stale;
    s.counter_stale = !o.order.fresh;
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
                    {.present = o.order.fresh && frame.has_fringe,
                     .c = frame.fringe_c,
                     .s = frame.fringe_s,
                     .quarter = frame.fringe_quarter,
                     .counter = frame.counter,
                     .settled = o.settled,
                     .sign = o.beat_sign,
                     .rotation_counts = s.bias_monitor.counts + s.bias_monitor.counts_before});
}

void read_counter(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    if (o.counted) o.counts = static_cast<std::int64_t>(o.fringe.counter - s.counter);
    if (o.order.fresh) s.counter = o.fringe.counter;
    o.max_counts = length_ratio(c.commutator, s.commutator) * as_double(c.limits.counts);
    o.real_counts = as_double(o.counts);
    o.beyond = size(o.real_counts) > o.max_counts;
}

void read_echoes(const GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    o.polarity = s.mode_switch.polarity;
    o.loop_closed = s.mode_switch.loop_closed;
    if (o.order.fresh) {
        o.polarity_error = !is_sign(frame.polarity);
        o.echo_error = frame.polarity != o.polarity || frame.loop_closed != o.loop_closed;
        if (!o.polarity_error) o.polarity = frame.polarity;
        o.loop_closed = frame.loop_closed;
    }
    o.beat_sign = static_cast<std::int8_t>(o.commuted.sign * o.polarity);
    o.settled = o.loop_closed && s.mode_switch.phase == SwitchPhase::tracking;
}

void read_bias(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    const bool good = o.counted && !o.beyond && !o.commuted.sign_error && !o.polarity_error;
    o.bias = step(c.limits, s.bias_monitor, good, o.real_counts, o.beat_sign, o.settled && s.was_lit);
    // A half without light makes the difference to the next one meaningless.
    const bool was_lit = s.was_lit || (o.loop_closed && s.was_steady);
    o.bias_wrong = o.bias.judged && !o.bias.in_band && was_lit;
    if (!o.order.fresh) return;
    o.coil = step(c.limits, s.coil_monitor, o.commuted.sign, frame.coil_current_a);
}

// What is known of the offset, from half to half of a re-lock that contradicts it: in 40 halves an eighth is left.
constexpr double forgotten_by_a_fault = 0.95;

void balance_light(const GyroControlConfig& c, GyroControlState& s, const Observation& o, BalancedHalf half) noexcept {
    half.is_read = half.is_read && !o.monitored.stuck && !o.monitored.noisy;
    // The jump of a beam that has faded is not that of an offset; but one in switch after switch was no fading.
    if (o.monitored.has_jump && half.is_read) {
        if (s.light_monitor.is_unbalanced) {
            s.light_balance.jumps *= forgotten_by_a_fault;
            s.light_balance.weights *= forgotten_by_a_fault;
        } else
            learn_offset(s.light_balance, half, s.light_monitor.jump, c.detector.discriminator_per_lambda);
    }
    half.has_faded = s.light_monitor.is_unbalanced;
    follow(c.limits, s.light_balance, half);
}

// Of one half; more than noise, and .03 wavelength of the paper's gyro.
constexpr double unsure_signal = 0.01;

void read_light(const GyroControlConfig& c, GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    if (!o.order.fresh) {
        s.light_monitor.has_last = false;
        return;
    }
    const std::size_t n = frame.n_light <= max_light_samples ? frame.n_light : 0;
    const std::span light_a = std::span{frame.light_a}.first(n);
    const std::span light_b = frame.has_light_b ? std::span{frame.light_b}.first(n) : std::span<const float>{};
    const SyncDetectorInput light{light_a,
                                  light_b,
                                  o.beat_sign,
                                  o.settled && !s.light_spoilt,
                                  o.bias.judged && o.bias.in_band,
                                  weight_of(s.light_balance)};
    o.light = step(c.detector, s.detector, light);
    o.light.usable = o.light.usable && !o.commuted.sign_error && !o.polarity_error;
    const BalancedHalf half{.is_first = s.half % 2 == 0,
                            .is_read = o.loop_closed && o.order.follows && o.light.usable && !light_b.empty(),
                            .settles = !o.settled,
                            .signal = o.light.signal,
                            .light = o.light.light};
    const double per_lambda = c.detector.discriminator_per_lambda;
    const double unknown_lambda2 = o.settled ? 0.0 : unknown_jump_lambda2(s.light_balance, half, per_lambda);
    o.monitored = step(c.limits, s.light_monitor,
                       {c.detector, light, o.light, o.loop_closed, o.settled, o.bias.deficit_ratio, unknown_lambda2});
    // Where the balance of the beams is not known, one half alone does not tell it from a detuning.
    const bool begins = !o.settled && !light_b.empty() && s.light_balance.n_ticks == 0.0 && !s.light_balance.has_last &&
                        size(half.signal) > unsure_signal;
    // Of a settled gyro two ticks in eight tell enough.
    if (!o.settled || s.half % 16 >= 12) balance_light(c, s, o, half);
    if (begins) o.light.usable = false;
    o.lit = o.light.two_way || o.monitored.contradicted;
    o.lased = o.lit && o.loop_closed;
    s.light_spoilt = loses<Loses::light>(c, s, o);
}

void read_slow(GyroControlState& s, const SensorFrame& frame, Observation& o) noexcept {
    if (!o.order.fresh) return;
    o.piezo = Volts{frame.piezo_v};
    o.temperature_c = frame.temperature_c;
    if (is_finite(frame.piezo_v)) s.piezo_v = frame.piezo_v;
    if (!is_finite(frame.temperature_c)) return;
    s.temperature_c = frame.temperature_c;
    if (!s.temperature_known) s.mean_temperature_c = s.temperature_c;
    s.temperature_known = true;
}

// Half of the bias is gone, or it is that of the other helicity: b by the last two halves. A wrong reading seldom looks
// so. Asked only while a reading waits for its judgement.
bool is_lost_or_reversed(const BiasMonitorState& s) noexcept {
    const double b = 0.5 * s.beat_sign * (s.counts - s.counts_before);
    return b < 0.5 * s.bias_counts && b > -1.25 * s.bias_counts;
}

void read_span(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    // What does not follow begins anew, whether or not it can be read: so many halves lie between.
    const bool found = !o.order.fresh || (o.order.follows && o.lit && !o.coil.off && !o.coil.unbalanced);
    const bool is_echoed = !o.commuted.sign_error && !o.polarity_error && !o.commuted.latch_error;
    const BiasMonitorState& bias = s.bias_monitor;
    o.reading =
        step(s.reading_monitor, {.read = o.order.fresh && is_echoed && !o.bit_stuck,
                                 .follows = o.order.follows,
                                 .countable = o.loop_closed && found,
                                 .mode = o.polarity,
                                 .suspicious = o.beyond || o.bias_wrong,
                                 .agrees = o.counted && !o.beyond && !(o.bias.judged && !o.bias.in_band),
                                 .bias_lost = s.reading_monitor.suspected && o.bias.judged && is_lost_or_reversed(bias),
                                 .reading = o.fringe.counter,
                                 .max_counts = o.max_counts,
                                 .bias_counts = bias.bias_counts > 0.0 ? bias.bias_counts : c.limits.bias_counts,
                                 .beat_sign = o.beat_sign});
}

// A re-lock is corrected by both halves of a tick: one without the other would be worse than none.
void match_halves(GyroControlState& s, Observation& o) noexcept {
    o.has_mean_square = o.light.usable && o.monitored.has_mean_square;
    if (s.half % 2 == 0) {
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

void decide_valid(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    if (o.lased && (o.bias.lost || o.bias.reversed)) o.bias_wrong = true;
    o.valid = o.reading.trusted && !loses<Loses::counts>(c, s, o);
    match_halves(s, o);
    // Away from a lock the detuning moves: without its mean square the false angle would stay unnoticed. A gyro that
    // starts at the centre has none to speak of, however unequal its beams turn out to be: two halves together show it.
    const bool starts_centred = is_learning(s.light_balance) && !o.monitored.withheld &&
                                size(c.detector.discriminator_per_lambda * o.light.detuning.value()) < unsure_signal;
    if ((s.light_spoilt || o.monitored.withheld) && !o.has_mean_square && !o.settled && !starts_centred)
        o.valid = false;
    o.unsteady = step(c.limits, s.detuning_monitor, s.half % 2 != 0, o.valid && o.loop_closed, o.settled,
                      o.has_mean_square, o.light.mean_sq_lambda2);
    if (o.unsteady) o.valid = false;
    s.was_lit = o.lased && o.counted;
}

// Change of the detuning within a half, rms, up to which it counts as steady.
constexpr double steady_lambda = 0.05;

// In an open loop the record has the mode that is sent for, but at first the light is still that of the one before: the
// way between them is dark, or else the bias must be that of the new mode.
void find_steadiness(const GyroControlConfig& c, GyroControlState& s, Observation& o) noexcept {
    s.was_dark = !o.loop_closed && (s.was_dark || (o.order.fresh && !o.light.two_way));
    if (!o.valid || !o.has_mean_square || o.reading.span != 1) return;
    if (!o.loop_closed && !s.was_dark && !(o.bias.judged && o.bias.in_band)) return;
    const double mean = o.light.detuning.value();
    const double noise = c.limits.light_noise.value();
    o.steady = o.light.mean_sq_lambda2 - mean * mean <= steady_lambda * steady_lambda + noise * noise;
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
    seen.commuted = step(config.commutator, state.commutator, seen.order.fresh, frame.bias_sign, frame.timer_ticks);
    read_echoes(state, frame, seen);
    seen.fringe.counter = frame.counter;
    if (config.fringe.reads) read_fringe(config, state, frame, seen);
    read_counter(config, state, seen);
    read_bias(config, state, frame, seen);
    read_light(config, state, frame, seen);
    read_slow(state, frame, seen);
    // The counter is judged only by counts of a gyro that lases in its mode; by phase as one of half counts, whose bit
    // 0 is no longer within every sigma.
    std::uint64_t reading = frame.counter;
    if (config.fringe.reads) reading = 2 * reading + (seen.fringe.fringe >= 0.5f ? 1 : 0);
    seen.bit_stuck = step(state.counter_monitor, seen.counted && seen.lased && state.was_lit, reading);
    read_span(config, state, seen);
    decide_valid(config, state, seen);
    find_steadiness(config, state, seen);
    state.was_steady = seen.steady;
    leave_counts(state, seen);
}

}  // namespace zlg::core
