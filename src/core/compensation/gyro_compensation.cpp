#include <zlg/core/gyro_compensation.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// Beyond this a sum of two halves could not be told from its neighbours as a double.
constexpr std::int64_t max_counts = std::int64_t{1} << 52;

EdgeShiftConfig edges_of(const GyroCompensationConfig& c) noexcept {
    return {.timer = c.timer, .plateau_ratio = c.plateau_ratio, .tick = c.relock.tick, .scale = c.relock.scale};
}

void make_sane(const GyroCompensationConfig& config, GyroCompensationState& state, HalfRecord& half) noexcept {
    if (half.counts > max_counts || half.counts < -max_counts) {
        half.counts = 0;
        half.valid = false;
    }
    const bool end_unknown = half.edge_offset_ticks != 0 && !is_possible(edges_of(config), half.edge_offset_ticks);
    if (end_unknown) half.edge_offset_ticks = 0;
    if (state.start_unknown || end_unknown) half.valid = false;
    state.start_unknown = end_unknown;
    half.bias_sign = half.bias_sign < 0 ? std::int8_t{-1} : std::int8_t{1};
    half.mode = half.mode < 0 ? std::int8_t{-1} : std::int8_t{1};
    if (half.span < 1) half.span = 1;
}

EdgeShiftInput edge_input(const RelockDriftConfig& config, const HalfRecord& first, const HalfRecord& second) noexcept {
    return {.counts = first.counts + second.counts,
            .sign_first = first.bias_sign * first.mode,
            .sign_second = second.bias_sign * second.mode,
            .offset_middle_ticks = first.edge_offset_ticks,
            .offset_end_ticks = second.edge_offset_ticks,
            .bias = bias_at(config, Celsius{first.temperature_c})};
}

TickInput assemble(const GyroCompensationConfig& config, const HalfRecord& first, const HalfRecord& second,
                   double value_arcsec) noexcept {
    const double count = config.relock.scale.value();
    const double walk = config.random_walk.value();
    TickInput tick;
    tick.measured = is_measured(first, second);
    tick.value_arcsec = value_arcsec;
    // The difference of two counter readings, each rounded uniformly: count^2/6.
    tick.variance_arcsec2 = count * count / 6.0 + walk * walk * config.relock.tick.value();
    tick.mode = second.mode;
    tick.sign = static_cast<std::int8_t>(first.bias_sign * first.mode);
    if (!(first.loop_closed && second.loop_closed)) tick.flags |= flag_loop_unlocked;
    if (!(first.valid && second.valid)) tick.flags |= flag_invalid;
    if (tick.measured && first.mode != second.mode) {
        tick.flags |= flag_mode_mixed;
        tick.variance_arcsec2 = infinity;
    }
    return tick;
}

RelockTick relock_tick(int sign, const HalfRecord& first, const HalfRecord& second,
                       double known_excess_counts) noexcept {
    return {.sign = sign,
            .counts_first = first.counts,
            .counts_second = second.counts,
            .known_excess_counts = known_excess_counts,
            .detuning_first_lambda = first.detuning_lambda,
            .detuning_second_lambda = second.detuning_lambda,
            .detuning_sq_first_lambda2 = first.detuning_sq_lambda2,
            .detuning_sq_second_lambda2 = second.detuning_sq_lambda2,
            // Sampled at the end of the first half: the middle of the tick.
            .temperature_c = first.temperature_c};
}

void apply(const RelockDriftOutput& relock, TickInput& tick) noexcept {
    tick.settled = !relock.due;
    if (relock.tick.known) {
        tick.value_arcsec -= relock.tick.value_arcsec;
        tick.relock_arcsec = relock.tick.value_arcsec;
        tick.variance_arcsec2 += relock.tick.variance_arcsec2;
        tick.relock_variance_arcsec2 = relock.tick.variance_arcsec2;
        tick.flags |= flag_relock_corrected;
    } else if (relock.due && !relock.waiting) {
        tick.flags |= flag_relock_uncorrected;
        tick.variance_arcsec2 += relock.tick.variance_arcsec2;
    }
    if (!relock.first_due) return;
    tick.amend_previous = true;
    tick.amend_arcsec = -relock.first.value_arcsec;
    tick.amend_variance_arcsec2 = relock.first.variance_arcsec2;
    tick.amend_flags = relock.first.known ? flag_relock_corrected : flag_relock_uncorrected;
}

// The start of a log is no gap, and its first ticks are not corrected. Where they say of themselves that the loop still
// settled, beyond what their light's noise can say, sigma holds that.
constexpr double certain_sq = 9.0;

void allow_for_start(const RelockDriftConfig& config, const RelockDriftState& relock, const RelockTick& read,
                     std::int64_t tick_number, TickInput& tick) noexcept {
    const bool by_light = config.method != RelockMethod::none && config.method != RelockMethod::frequency;
    if (!by_light || relock.armed || relock.since_gap > 0 || tick_number >= config.ticks) return;
    RelockDriftState closing{.armed = true};
    const FalseAngle left = step(config, closing, read).tick;
    const double sq = left.value_arcsec * left.value_arcsec;
    if (left.known && sq > certain_sq * left.variance_arcsec2) tick.variance_arcsec2 += sq;
}

// Tick 1 of `frequency` whose tick 2 does not exist stays as it is.
void give_up_first(TickInput& tick) noexcept {
    tick.amend_previous = true;
    tick.amend_flags = flag_relock_uncorrected;
}

// Mean square of the detuning, through the curve; 0 where there is none.
double detuning_sq(const RelockDriftConfig& c, const HalfRecord& half) noexcept {
    if (!(half.detuning_sq_lambda2 > 0.0)) return 0.0;
    const double noise = c.light_noise.value();
    return about(c.centre, true_moments(c.curve, half.detuning_lambda, half.detuning_sq_lambda2, noise * noise));
}

HalfRecord with_true_detuning(const RelockDriftConfig& c, HalfRecord half) noexcept {
    half.detuning_sq_lambda2 = detuning_sq(c, half);
    return half;
}

// The sum over ticks up to this one, if the counter has it. What the detuning may have added since the last measured
// tick is at most what its mean square has fallen by; where that is more than the rounding, as in a re-lock, the motion
// is the better guide.
void find_known(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& first,
                const HalfRecord& second, const EdgeShiftState& edges_before, TickInput& tick) noexcept {
    const Hertz bias = bias_at(config.relock, Celsius{first.temperature_c});
    const CountedStretch known = step(edges_of(config), state.stretch, with_true_detuning(config.relock, first),
                                      with_true_detuning(config.relock, second), bias, edges_before, state.edges);
    if (known.n_ticks == 0) return;
    const double count = config.relock.scale.value();
    const double walk = config.random_walk.value();
    const double tick_s = config.relock.tick.value();
    const double drift_hz = 0.5 * config.relock.chi * bias.value() * known.fall_lambda2;
    const double drift_arcsec = count * tick_s * drift_hz;
    const double rounding = count * count / 6.0;
    const double drift_variance = drift_arcsec * drift_arcsec;
    if (!(drift_variance <= rounding)) return break_off(state.edges);
    tick.known_ticks = known.n_ticks;
    tick.known_arcsec = known.angle_arcsec;
    tick.known_drift_arcsec2 = drift_variance;
    tick.known_variance_arcsec2 = rounding + walk * walk * tick_s * as_double(known.n_ticks) + drift_variance;
}

bool is_joint(const GyroCompensationConfig& config) noexcept {
    return config.relock.method == RelockMethod::joint && is_estimated(config.bridge) && config.bridge.optimal.halves;
}

// Ticks over which the bias is averaged: it changes with the temperature.
constexpr double bias_ticks = 256.0;

// The first half over the second, less the bias: the sign of its first half, and the slow mean of what it adds.
void take_excess(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& first,
                 const HalfRecord& second, double known_excess_counts, TickInput& tick) noexcept {
    const double difference = as_double(first.counts - second.counts) - known_excess_counts;
    const double excess = config.relock.scale.value() * difference;
    if (tick.settled) {
        const double bias = 0.5 * tick.sign * excess;
        state.bias_arcsec += state.bias_arcsec == 0.0 ? bias : (bias - state.bias_arcsec) / bias_ticks;
    }
    tick.half_excess_arcsec = excess - 2.0 * tick.sign * state.bias_arcsec;
}

void take_profile(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& half) noexcept {
    if (!is_due(state.joint) || needs_profile(state.bridge)) return;
    const Celsius temperature{half.temperature_c};
    tell(config.relock, state.joint, temperature, state.bridge.joint);
}

// Switches over which their errors are averaged.
constexpr std::int32_t remembered_switches = 8;

void remember(SwitchErrors& errors, const AngleSample& sample) noexcept {
    const double sq = sample.gap.sigma_sum_arcsec * sample.gap.sigma_sum_arcsec;
    if (!(sample.has_gap && sample.gap.mode_changed && is_finite(sq))) return;
    if (errors.n < remembered_switches) ++errors.n;
    errors.mean_sq_arcsec2 += (sq - errors.mean_sq_arcsec2) / static_cast<double>(errors.n);
}

CompensationOutput complete_tick(const GyroCompensationConfig& config, GyroCompensationState& state,
                                 const HalfRecord& second, LightSamples light) noexcept {
    const HalfRecord& first = state.first;
    state.has_first = false;

    const EdgeShiftState edges_before = state.edges;
    const EdgeShiftOutput shifted = step(edges_of(config), state.edges, edge_input(config.relock, first, second));
    TickInput tick = assemble(config, first, second, shifted.value_arcsec);
    if (is_joint(config)) {
        take(config.profile, state.joint, second, light, tick.measured, state.bridge.next_tick);
        take_profile(config, state, second);
    }
    if (tick.measured) {
        const RelockTick read = relock_tick(tick.sign, first, second, shifted.known_excess_counts);
        allow_for_start(config.relock, state.relock, read, state.bridge.next_tick, tick);
        const auto relock = step(config.relock, state.relock, read);
        apply(relock, tick);
        if (is_joint(config)) take_excess(config, state, first, second, shifted.known_excess_counts, tick);
        state.first_waits = relock.waiting;
        begin_anew(state.stretch, detuning_sq(config.relock, second));
    } else {
        enter_gap(state.relock, !(first.loop_closed && second.loop_closed));
        if (config.bridge.method != BridgeMethod::none) {
            break_off(state.edges);
            find_known(config, state, first, second, edges_before, tick);
        }
        if (state.first_waits) give_up_first(tick);
        state.first_waits = false;
    }
    tick.bias_arcsec = state.bias_arcsec;
    tick.value_arcsec -= step(config.magnetic, state.magnetic, {tick.measured, tick.mode, tick.value_arcsec});
    CompensationOutput out{.has_sample = true, .sample = step(config.bridge, state.bridge, tick)};
    remember(state.switch_errors, out.sample);
    const std::int64_t counted = tick.measured ? first.counts + second.counts : 0;
    state.angle.add(counted, config.relock.scale.value(), out.sample.dtheta_arcsec);
    out.angle_arcsec = state.angle.value_arcsec(config.relock.scale.value());
    return out;
}

}  // namespace

GyroCompensationFault check(const GyroCompensationConfig& config) noexcept {
    if (check(config.relock) != RelockDriftFault::none) return GyroCompensationFault::relock;
    if (check(edges_of(config)) != EdgeShiftFault::none) return GyroCompensationFault::edges;
    if (check(config.bridge) != GapBridgeFault::none) return GyroCompensationFault::bridge;
    const double walk = config.random_walk.value();
    if (!(walk >= 0.0 && is_finite(walk))) return GyroCompensationFault::random_walk;
    if (check(config.profile) != RelockProfileFault::none) return GyroCompensationFault::profile;
    if (check(config.magnetic) != MagneticDriftFault::none) return GyroCompensationFault::magnetic;
    return GyroCompensationFault::none;
}

SwitchAdvice advice(const GyroCompensationConfig& config, const GyroCompensationState& state) noexcept {
    return {.switch_error_arcsec = square_root(state.switch_errors.mean_sq_arcsec2),
            .magnetic_arcsec_s = remaining_arcsec_s(config.magnetic, state.magnetic)};
}

CompensationOutput step(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& half,
                        LightSamples light) noexcept {
    if (state.has_first) {
        HalfRecord second = half;
        make_sane(config, state, second);
        return complete_tick(config, state, second, light);
    }
    HalfRecord& taken = state.first;
    taken = half;
    make_sane(config, state, taken);
    state.has_first = true;
    if (is_joint(config)) {
        take(config.profile, state.joint, taken, light, taken.loop_closed && taken.valid, state.bridge.next_tick);
        take_profile(config, state, taken);
    }
    // No angle is due in this half: there is room for the estimate of a gap.
    if (state.bridge.n_pending > 0 && is_estimated(config.bridge)) advance_estimate(config.bridge, state.bridge);
    return {};
}

DrainOutput drain(const GyroCompensationConfig& config, GyroCompensationState& state) noexcept {
    if (state.first_waits) {
        // No tick 2 will come: say so in the row of tick 1, which is still in the history.
        const auto last = static_cast<std::uint64_t>(state.bridge.next_tick - 1);
        state.bridge.history[last % history_ticks].row.flags |= flag_relock_uncorrected;
        state.first_waits = false;
    }
    return drain(config.bridge, state.bridge);
}

}  // namespace zlg::core
