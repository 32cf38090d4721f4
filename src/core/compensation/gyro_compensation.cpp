#include <zlg/core/gyro_compensation.hpp>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Beyond this the sum of two halves is no longer exact as a double.
constexpr std::int64_t max_counts = std::int64_t{1} << 52;

// Makes a record from outside one that every module below accepts.
void sanitise(const GyroCompensationConfig& config, GyroCompensationState& state, HalfRecord& half) noexcept {
    if (half.counts > max_counts || half.counts < -max_counts) {
        half.counts = 0;
        half.valid = false;
    }
    const bool end_unknown = half.edge_offset_ticks != 0 && !is_possible(config.gyro, half.edge_offset_ticks);
    if (end_unknown) half.edge_offset_ticks = 0;
    if (state.start_unknown || end_unknown) half.valid = false;
    state.start_unknown = end_unknown;
    half.bias_sign = half.bias_sign < 0 ? std::int8_t{-1} : std::int8_t{1};
    half.mode = half.mode < 0 ? std::int8_t{-1} : std::int8_t{1};
    if (half.span < 1) half.span = 1;
}

// The readings at both ends of a tick, and between its halves.
struct Borders {
    Border start{};
    Border middle{};
    Border end{};
};

void assemble(const CompensationConstants& gyro, const HalfRecord& first, const HalfRecord& second,
              const Borders& borders, double value_arcsec, TickInput& tick) noexcept {
    tick.late = first.late || second.late;
    tick.value_arcsec = value_arcsec;
    tick.variance_arcsec2 = rounding_arcsec2(gyro, borders.start, borders.end) + walk_arcsec2(gyro);
    tick.mode = second.mode;
    tick.half[0].sign = tick.sign = static_cast<std::int8_t>(first.bias_sign * first.mode);
    tick.half[1].sign = static_cast<std::int8_t>(second.bias_sign * second.mode);
    if (!tick.measured) {
        if (!(first.loop_closed && second.loop_closed)) tick.flags |= flag_loop_unlocked;
        if (!(first.valid && second.valid)) tick.flags |= flag_invalid;
    } else if (first.mode != second.mode) {
        tick.flags |= flag_mode_mixed;
        tick.variance_arcsec2 = infinity;
    }
}

std::uint32_t flag_of(const FalseAngle& angle) noexcept {
    return angle.known ? flag_relock_corrected : flag_relock_uncorrected;
}

void apply(const RelockDriftConfig& config, const RelockDriftOutput& relock, TickInput& tick) noexcept {
    // With nothing but a presumption the motion is learnt from all ticks.
    tick.settled = !relock.due || config.presumes;
    if (relock.due && !relock.waiting) {
        tick.relock_arcsec = relock.tick.value_arcsec;
        tick.value_arcsec -= tick.relock_arcsec;
        tick.relock_variance_arcsec2 = relock.tick.variance_arcsec2;
        const double part = tick.with_phase && config.method == RelockMethod::frequency ? other_loop_part : 0.0;
        tick.variance_arcsec2 += tick.relock_variance_arcsec2 + square(part * tick.relock_arcsec);
        tick.flags |= flag_of(relock.tick);
    }
    if (!relock.first_due) return;
    tick.amend_previous = true;
    tick.amend_arcsec = -relock.first.value_arcsec;
    tick.amend_variance_arcsec2 = relock.first.variance_arcsec2;
    tick.amend_flags = flag_of(relock.first);
}

// A half that was read, and refused: not one that was missed, or waits for a judgement, whose counts are in a later
// one.
bool is_refused(const HalfRecord& half) noexcept { return half.loop_closed && !half.valid && half.counts != 0; }

// What lock-in takes from the halves, given back to the tick. The counter shows the beat of each half.
void give_back_lock_in(const GyroCompensationConfig& config, const HalfRecord& first, const HalfRecord& second,
                       const Borders& borders, TickInput& tick) noexcept {
    const double scale = config.gyro.scale.value();
    const LostCounts lost = lost_to_lock_in(
        config.gyro, config.lock_in, counts_and_parts(first.counts, parts_between(borders.start, borders.middle)),
        counts_and_parts(second.counts, parts_between(borders.middle, borders.end)));
    tick.value_arcsec += scale * lost.value;
    tick.common_arcsec2 = scale * scale * lost.variance;
    tick.variance_arcsec2 += tick.common_arcsec2;
}

void take_light(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& half,
                LightSamples light, int k) noexcept {
    if (!is_estimated(config.bridge) || config.relock.method != RelockMethod::joint || config.relock.ticks < 1) return;
    step(config.gyro, config.profile, state.bridge.light, half, light, is_measured(half),
         2 * state.bridge.next_tick + k, static_cast<int>(2 * config.relock.ticks));
}

// Time constant of the mean of the bias, which follows the temperature, in ticks.
constexpr double bias_memory_ticks = 256.0;

// The false angle of a half by its record.
void read_record(const GyroCompensationConfig& config, const HalfRecord& half, HalfReading& reading) noexcept {
    const RecordedSquare recorded = recorded_square(config.gyro, half);
    if (!recorded.known) return;
    const double unit = arcsec_per_lambda2(config.gyro, bias_at(config.gyro, Celsius{half.temperature_c}));
    const double over = config.relock.method == RelockMethod::joint ? recorded.over_trapezoid_lambda2 : 0.0;
    const double angle = -reading.sign * unit * (recorded.mean_sq_lambda2 - over);
    const auto variance = static_cast<float>(square(unit) * recorded.variance_lambda4);
    if (!is_finite(angle + variance)) return;
    reading.false_arcsec = angle;
    reading.false_arcsec2 = variance;
}

// The halves of a measured tick: what it turned, and half of what the first one turned more.
void read_halves(const GyroCompensationConfig& config, const HalfRecord& first, const HalfRecord& second,
                 double half_excess_arcsec, TickInput& tick) noexcept {
    const bool squares = !tick.settled && (config.relock.method == RelockMethod::joint ||
                                           config.relock.method == RelockMethod::mean_square);
    for (int k = 0; k < 2; ++k) {
        HalfReading& reading = tick.half[static_cast<unsigned>(k)];
        reading.read = true;
        reading.angle_arcsec =
            0.5 * (tick.value_arcsec + tick.relock_arcsec + (k == 0 ? half_excess_arcsec : -half_excess_arcsec));
        if (squares) read_record(config, k == 0 ? first : second, reading);
    }
}

// A lit half of a gap, where its counts are an angle. Its light is that of the new mode before the loop is closed. In
// closing the detuning jumps, and no spline goes through that: these halves are read by their records.
void read_lit_half(const GyroCompensationConfig& config, const GyroCompensationState& state, const HalfRecord& half,
                   const Border& from, const Border& to, HalfReading& reading) noexcept {
    const bool is_lit = half.lit && !half.loop_closed && half.valid && half.span == 1;
    if (!is_lit || half.edge_offset_ticks != 0 || !(state.n_bias > 0.0)) return;
    if (state.bridge.with_phase && !(from.is_known() && to.is_known())) return;
    reading.read = reading.lit = true;
    reading.angle_arcsec = config.gyro.scale.value() * counts_and_parts(half.counts, parts_between(from, to)) -
                           reading.sign * state.bias_arcsec;
    read_record(config, half, reading);
}

// Measured ticks, more with the place within the count than without, after which the readings are taken to be such; and
// as many the other way: longer than what a gap leaves without.
constexpr std::int32_t phase_debounce = 32;

void note_phase(GyroCompensationState& state, bool with_phase) noexcept {
    std::int32_t& n = state.n_with_phase;
    n += with_phase ? (n < phase_debounce) : -(n > 0);
    bool& by_phase = state.bridge.with_phase;
    if (n != (by_phase ? 0 : phase_debounce)) return;
    by_phase = !by_phase;
    state.bridge.spread = {};
    // At rest the mean of whole counts is off by up to half of one, and by phase that is much: it weighs as the others.
    if (by_phase && state.n_bias > phase_debounce) state.n_bias = phase_debounce;
}

// Number of recent switches over which the mean square of their errors is taken.
constexpr std::int32_t remembered_switches = 8;

// Magnetic drift to subtract from this tick. With the fringe phase read, a switch is known well enough for the step of
// the drift there to matter, so the drift is estimated whatever the method; what the method leaves in the values is
// handed to the bridge. Advances the estimator.
double magnetic_arcsec(const GyroCompensationConfig& config, GyroCompensationState& state,
                       const TickInput& tick) noexcept {
    const bool by_phase = state.bridge.with_phase;
    const MagneticMethod method = config.magnetic.method;
    if (method == MagneticMethod::none && !by_phase && !state.magnetic.started) return 0.0;
    const double subtracted =
        step(config.gyro, config.magnetic, state.magnetic, {tick.measured, tick.mode, tick.value_arcsec});
    if (!tick.measured) {
        // In the angle of a tick.
        const double tick_s = by_phase ? config.gyro.tick.value() : 0.0;
        const double left = 1.0 - taken_out(config.magnetic, state.magnetic);
        state.bridge.magnetic_arcsec = left * state.magnetic.estimate[of_drift] * tick_s;
        state.bridge.magnetic_variance_arcsec2 = drift_variance(state.magnetic) * square(tick_s);
    }
    return subtracted;
}

// What a half may hold of a fault that begins or ends in it, over the bias: a change of the current is seen from 1.2 %
// of it on, darkness from one sample's time.
constexpr double unseen_part = 0.01;

// What the half before or behind those that a monitor refused may hold of their fault.
double unseen_arcsec2(const CompensationConstants& gyro) noexcept {
    return square(unseen_part * 0.5 * gyro.tick.value() * gyro.bias.value() * gyro.scale.value());
}

// Part of the false angle of a stretch, at its most, by which the constants err: the quartic term of the bias, chi f0
// and the reading of a large detuning.
constexpr double law_part = 0.03;

// The counted angle of the gap's ticks up to this one, where the counter knows it (counted_stretch.hpp). The false
// drift in it is at most that of the fall of the mean square of the detuning since the last measured tick. Where this
// exceeds the rounding of the counter, as in a re-lock, it is subtracted if the light was read throughout, and in any
// case the sum is rough.
void set_known_sum(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& first,
                   const HalfRecord& second, const Borders& borders, TickInput& tick) noexcept {
    const CompensationConstants& gyro = config.gyro;
    // The stretch sets them where it knows the sum.
    const EdgeShiftState edges_before = state.edges;
    state.edges = {.offset_ticks = second.edge_offset_ticks};
    const Hertz bias = bias_at(gyro, Celsius{first.temperature_c});
    const CountedStretch known =
        step(gyro, state.stretch, first, second, bias, edges_before, state.edges, borders.start);
    if (known.n_ticks == 0) return;
    const double unit = arcsec_per_lambda2(gyro, bias);
    const double drift_arcsec = unit * known.fall_lambda2;
    const double rounding = rounding_arcsec2(gyro, state.stretch.start_border, borders.end);
    double drift_variance = drift_arcsec * drift_arcsec;
    // More are a stretch of months.
    tick.known.ticks = known.n_ticks < INT32_MAX ? static_cast<std::int32_t>(known.n_ticks) : 0;
    tick.known.arcsec = known.angle_arcsec;
    const bool settles = !(drift_variance <= rounding_arcsec2(gyro));
    if (settles && state.stretch.seen) {
        tick.known.arcsec += unit * state.stretch.deficit_lambda2;
        drift_variance = law_part * law_part * drift_variance + unit * unit * state.stretch.deficit_variance_lambda4;
    }
    tick.known.is_rough = settles;
    tick.known_drift_arcsec2 = drift_variance;
    tick.known.variance_arcsec2 = rounding + walk_arcsec2(gyro) * as_double(known.n_ticks) + drift_variance;
    // What lock-in takes from the ticks at their mean rate is given back.
    const double turn = 0.5 * state.edges.turn_counts, of_bias = 0.5 * bias.value() * gyro.tick.value();
    const LostCounts lost = lost_to_lock_in(gyro, config.lock_in, turn + of_bias, turn - of_bias);
    const double scale = gyro.scale.value(), arcsec = scale * as_double(known.n_ticks);
    tick.variance_arcsec2 += scale * scale * lost.variance;
    tick.known.arcsec += arcsec * lost.value;
    tick.known.variance_arcsec2 += arcsec * arcsec * lost.variance;
    // What `step` has concluded from the sum about the edges holds for an even bias.
    if (settles) break_off(state.edges);
}

// What is known of a tick is applied in the order in which it acts: edges and lock-in on the counts, a push of the
// perimeter or the re-lock, the edges of faults, the magnetic drift. What remains goes to the gap interpolation.
AngleSample complete_tick(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& second,
                          LightSamples light) noexcept {
    TickInput tick;
    const HalfRecord& first = state.first;
    state.has_first = false;

    const Borders borders{state.border, border_of(first), border_of(second)};
    state.border = borders.end;
    const std::int32_t parts = parts_between(borders.start, borders.end);
    tick.measured = is_measured(first, second);
    const bool is_bridged = !tick.measured && config.bridge.method != BridgeMethod::none;
    EdgeShiftOutput shifted;
    if (!is_bridged) shifted = step(config.gyro, state.edges, first, second, parts);
    assemble(config.gyro, first, second, borders, shifted.value_arcsec, tick);
    take_light(config, state, second, light, 1);
    double half_excess = 0.0;
    if (tick.measured) {
        tick.with_phase = borders.start.is_known() && borders.middle.is_known() && borders.end.is_known();
        note_phase(state, tick.with_phase);
        give_back_lock_in(config, first, second, borders, tick);
        // Counts of the first half minus those of the second that are not the bias: by the unequal lengths of shifted
        // halves, minus the difference of their places within the count.
        const std::int32_t unequal =
            parts_between(borders.start, borders.middle) - parts_between(borders.middle, borders.end);
        const double excess = shifted.known_excess_counts - counts_and_parts(0, unequal);
        const RelockTick read{first, second, excess, tick.with_phase};
        tick.variance_arcsec2 += pushed_arcsec2(config.gyro, config.relock, state.relock, read, tick.variance_arcsec2);
        state.first_waits = false;
        if (state.relock.armed && state.relock.since_gap <= config.relock.ticks) {
            const RelockDriftOutput relock = step(config.gyro, config.relock, state.relock, read);
            apply(config.relock, relock, tick);
            state.first_waits = relock.waiting;
        }
        if (state.refused) {
            // The fault may have ended in its first half.
            tick.variance_arcsec2 += unseen_arcsec2(config.gyro);
            tick.relock_variance_arcsec2 += unseen_arcsec2(config.gyro);
        }
        half_excess = config.gyro.scale.value() * (as_double(first.counts - second.counts) - excess);
        if (tick.settled) {
            // The mean of what the bias adds to a half, each tick taken with the sign of its first half.
            if (state.n_bias < bias_memory_ticks) state.n_bias += 1.0;
            state.bias_arcsec += (0.5 * tick.sign * half_excess - state.bias_arcsec) / state.n_bias;
        }
        half_excess -= 2.0 * tick.sign * state.bias_arcsec;
        begin_anew(state.stretch, detuning_sq(config.gyro, second));
    } else {
        const bool moves = !(first.loop_closed && second.loop_closed);
        // What is not corrected is uncertain only where the perimeter may have moved.
        if (!config.relock.presumes || moves || is_refused(first) || is_refused(second)) enter_gap(state.relock);
        if (is_bridged) set_known_sum(config, state, first, second, borders, tick);
        // The fault may have begun in the last half before the one in which a monitor saw it.
        const bool may_have_begun = is_refused(first) && !state.bridge.gap.open;
        if (may_have_begun) tick.amend_variance_arcsec2 = unseen_arcsec2(config.gyro);
        // `frequency` corrects tick 1 with the help of tick 2. Where there is none, tick 1 stays uncorrected.
        if (state.first_waits) tick.amend_flags = flag_relock_uncorrected;
        tick.amend_previous = may_have_begun || state.first_waits;
        state.first_waits = false;
    }
    // The counts of a half that was missed go over into the next one, which then is not measured.
    state.refused = second.loop_closed && !second.valid;
    tick.value_arcsec -= magnetic_arcsec(config, state, tick);
    if (is_estimated(config.bridge)) {
        if (tick.measured) {
            read_halves(config, first, second, half_excess, tick);
        } else {
            read_lit_half(config, state, first, borders.start, borders.middle, tick.half[0]);
            read_lit_half(config, state, second, borders.middle, borders.end, tick.half[1]);
        }
    }
    AngleSample sample = step(config.gyro, bridge_of(config), state.bridge, tick);
    const GapReport& gap = sample.gap;
    if (sample.has_gap && gap.mode_changed && is_finite(square(gap.sigma_sum_arcsec))) {
        if (state.n_switches < remembered_switches) ++state.n_switches;
        state.switch_error_arcsec2 += (square(gap.sigma_sum_arcsec) - state.switch_error_arcsec2) / state.n_switches;
    }
    const std::int64_t counted = tick.measured ? first.counts + second.counts : 0;
    state.angle.add(counted, config.gyro.scale.value(), sample.dtheta_arcsec, tick.measured ? parts : 0);
    return sample;
}

}  // namespace

GyroCompensationFault check(const GyroCompensationConfig& config) noexcept {
    using Fault = GyroCompensationFault;
    const Fault of_gyro = check(config.gyro);
    if (of_gyro != Fault::none) return of_gyro;
    if (config.relock.ticks < 0) return Fault::relock;
    const GapBridgeConfig bridge = bridge_of(config);
    const bool bridged = is_allowed(bridge) && final_delay_ticks(config.gyro, bridge) <= most_final_delay_ticks;
    if (!bridged) return Fault::bridge;
    if (!is_allowed(config.profile)) return Fault::profile;
    if (!is_allowed(config.magnetic)) return Fault::magnetic;
    return is_allowed(config.lock_in) ? Fault::none : Fault::lock_in;
}

SwitchAdvice advice(const GyroCompensationConfig& config, const GyroCompensationState& state) noexcept {
    return {.switch_error_arcsec = square_root(state.switch_error_arcsec2),
            .magnetic_arcsec_s = remaining_arcsec_s(config.magnetic, state.magnetic)};
}

CompensationOutput step(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& half,
                        LightSamples light) noexcept {
    if (state.has_first) {
        HalfRecord second = half;
        sanitise(config, state, second);
        return {.has_sample = true,
                .sample = complete_tick(config, state, second, light),
                .angle_arcsec = state.angle.value_arcsec(config.gyro.scale.value())};
    }
    HalfRecord& first = state.first;
    first = half;
    sanitise(config, state, first);
    state.has_first = true;
    take_light(config, state, first, light, 0);
    return {};
}

void work(const GyroCompensationConfig& config, GyroCompensationState& state, Pause pause,
          std::span<const BankMember> bank) noexcept {
    work(config.gyro, bridge_of(config), state.bridge, pause, bank);
}

DrainOutput drain(const GyroCompensationConfig& config, GyroCompensationState& state) noexcept {
    if (state.first_waits) {
        // No tick 2 will come: flag the row of tick 1, which is still in the history.
        at(state.bridge, state.bridge.next_tick - 1).row.flags |= flag_relock_uncorrected;
        state.first_waits = false;
    }
    return drain(config.gyro, bridge_of(config), state.bridge);
}

}  // namespace zlg::core
