#include <zlg/core/compensation/relock_drift.hpp>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/switch_light.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Square of the number of standard deviations of a settled tick from which on a false angle is taken to be real.
constexpr double unsubtracted_gate_sq = 9.0;

// Part of the variance of a tick up to which a false angle is not looked for.
constexpr double hidden_part = 0.25;

// Of the sum of two mean squares, over the variance of the light's noise, of which it has two: above, the perimeter
// swings. Four deviations of that sum, of 16 samples a half.
constexpr double swinging_ratio = 4.0;

// What a settled perimeter may be off, rms, where the light does not tell.
constexpr double unseen_detuning_lambda = 0.01;

// No rotation is that large, whatever the scale; its square and any sum of such angles are still numbers.
constexpr double max_false_angle_arcsec = 1e30;

Hertz bias_of(const CompensationConstants& g, const RelockTick& t) noexcept {
    return bias_at(g, Celsius{t.first.temperature_c});
}

int sign_of(const RelockTick& t) noexcept { return t.first.bias_sign * t.first.mode; }

// s K T: the false angle of one tick from its false rate, with the sign of the first half.
double arcsec_per_hz(const CompensationConstants& g, const RelockTick& t) noexcept {
    return sign_of(t) * g.scale.value() * g.tick.value();
}

FalseAngle false_angle(double value_arcsec, double variance_arcsec2) noexcept {
    const bool possible = is_within(value_arcsec, -max_false_angle_arcsec, max_false_angle_arcsec);
    return possible && is_finite(variance_arcsec2) ? FalseAngle{true, value_arcsec, variance_arcsec2} : FalseAngle{};
}

// Eq (13) by the mean squares as they are recorded, and of `joint` as the bias weighs them.
FalseAngle by_mean_square(const CompensationConstants& g, const RelockTick& t, bool is_joint) noexcept {
    const RecordedSquare first = recorded_square(g, t.first), second = recorded_square(g, t.second);
    const double sum = t.first.detuning_sq_lambda2 + t.second.detuning_sq_lambda2;
    if (!(first.known && second.known && sum > 0.0 && sum < square(max_detuning_lambda))) return {};
    const double unit = sign_of(t) * arcsec_per_lambda2(g, bias_of(g, t));
    const double over = is_joint ? second.over_trapezoid_lambda2 - first.over_trapezoid_lambda2 : 0.0;
    return false_angle(unit * (second.mean_sq_lambda2 - first.mean_sq_lambda2 - over),
                       square(unit) * (first.variance_lambda4 + second.variance_lambda4));
}

FalseAngle by_detuning(const CompensationConstants& g, const RelockTick& t) noexcept {
    const TrueMoments first_seen = moments_of(g, t.first), second_seen = moments_of(g, t.second);
    const double first = first_seen.mean_lambda;
    const double second = second_seen.mean_lambda;
    const double rho = second / first;
    if (!(rho > 0.0 && rho < 1.0 && first < max_detuning_lambda && first > -max_detuning_lambda)) return {};
    const double sum = first + second;
    const double log_rho = maths::log(rho);
    const double centre = 4.0 * g.centre.value();
    const double by_first = first_seen.slope * (sum * (2.0 * log_rho - sum / first) + centre);
    const double by_second = second_seen.slope * (sum * (2.0 * log_rho + sum / second) - centre);
    const double s2 = square(g.light_noise.value()) / g.light_samples;
    const double unit = 0.5 * sign_of(t) * arcsec_per_lambda2(g, bias_of(g, t));
    const double bent = beyond_square(g, second_seen) - beyond_square(g, first_seen);
    return false_angle(unit * (log_rho * sum * sum - centre * (second - first) + 2.0 * bent),
                       square(unit) * (square(by_first) + square(by_second)) * s2);
}

// <dl^2> of the first half; negative where the light does not show it.
double seen_lambda2(const CompensationConstants& g, const RelockTick& t) noexcept {
    const TrueMoments seen = moments_of(g, t.first);
    const bool squared = t.first.detuning_sq_lambda2 > 0.0;
    // Where the detuning falls thirtyfold within the half, the square of its mean is about half of its mean square.
    const double sq = squared ? about(g.centre, seen) : 2.0 * square(seen.mean_lambda - g.centre.value());
    const bool measured = squared || t.first.detuning_lambda != 0.0;
    return measured && is_within(sq, 0.0, square(max_detuning.value())) ? sq : -1.0;
}

// What a tick can lack: no more than the <dl^2> of its first half can fall in it. Where that is not seen, the detuning
// was at most `max_detuning` when the loop was closed, and of a square that falls by rho^4 from tick to tick tick n has
// (1 - rho^2) rho^(4 (n - 1)), at most 1/(2 n - 1); half of that is likely.
double most_arcsec(const CompensationConstants& g, const RelockDriftState& s, const RelockTick& t) noexcept {
    const double seen = seen_lambda2(g, t);
    const double presumed = 0.5 * square(max_detuning.value()) / (2.0 * as_double(s.since_gap) - 1.0);
    const double lambda2 = seen >= 0.0 ? seen : presumed;
    return size(arcsec_per_lambda2(g, bias_of(g, t))) * most_loss(g.bend, lambda2);
}

FalseAngle or_missing(FalseAngle found, double most_arcsec) noexcept {
    return found.known ? found : FalseAngle{.variance_arcsec2 = square(most_arcsec)};
}

// The false angle of a tick from its own deficit, with another's, by whose ratio q is found.
//
// slope  of (1 - q)/(1 + q) by minus the logarithm of the own deficit.
//
// The rounding of c_first - c_second is 2 e1 - e0 - e2, each e uniform over a count: variance 1/2 count^2, also where
// the phases are known. Neighbouring ticks share a reading: covariance 1/12 count^2.
FalseAngle by_frequency(const CompensationConstants& g, const RelockTick& t, double own, double other, double q,
                        double slope, bool neighbours) noexcept {
    const double part = (1.0 - q) / (1.0 + q);
    const double by_own = part - slope;
    const double by_other = slope * own / other;
    const double shared = neighbours ? by_own * by_other / 6.0 : 0.0;
    const double variance_counts2 = 0.5 * (square(by_own) + square(by_other)) + shared;
    return false_angle(arcsec_per_hz(g, t) * own * part, square(g.scale.value()) * variance_counts2);
}

// A false rate is no larger than the deficit either; by counts a deficit within its rounding, of one count, is none. By
// phase the light knows better where there is any, for an acceleration may hide the deficit.
double most_by_frequency(const CompensationConstants& g, const RelockDriftState& s, const RelockTick& t,
                         double deficit) noexcept {
    const double most = most_arcsec(g, s, t);
    const double shown = size(arcsec_per_hz(g, t) * deficit);
    if (!t.with_phase && shown <= g.scale.value()) return 0.0;
    return shown > most || (t.with_phase && seen_lambda2(g, t) >= 0.0) ? most : shown;
}

RelockDriftOutput frequency_step(const CompensationConstants& g, std::int64_t ticks, RelockDriftState& s,
                                 const RelockTick& t) noexcept {
    RelockDriftOutput out{.due = s.since_gap <= ticks, .waiting = s.since_gap == 1, .first_due = s.since_gap == 2};
    const double difference = as_double(t.first.counts) - as_double(t.second.counts);
    const double deficit = sign_of(t) * (difference - t.known_excess_counts) / g.tick.value() - bias_of(g, t).value();
    const double most = most_by_frequency(g, s, t, deficit);
    if (out.waiting) {
        s.first_deficit_hz = deficit;
        s.first_most_arcsec = most;
        return out;
    }
    const double n_halves = 2.0 * as_double(s.since_gap - 1);
    const double ratio = deficit / s.first_deficit_hz;
    if (ratio > 0.0 && ratio < 1.0) {
        const double q = maths::exp(maths::log(ratio) / n_halves);  // from one half to the next
        const double slope = 2.0 * q / square(1.0 + q) / n_halves;
        out.tick = by_frequency(g, t, deficit, s.first_deficit_hz, q, slope, out.first_due);
        if (out.first_due) out.first = by_frequency(g, t, s.first_deficit_hz, deficit, q, -slope, true);
    }
    out.tick = out.due ? or_missing(out.tick, most) : FalseAngle{};
    if (out.first_due) out.first = or_missing(out.first, s.first_most_arcsec);
    return out;
}

}  // namespace

void enter_gap(RelockDriftState& state) noexcept { state = {.armed = true}; }

RelockDriftOutput step(const CompensationConstants& gyro, const RelockDriftConfig& config, RelockDriftState& state,
                       const RelockTick& tick) noexcept {
    // Tick 1 of `frequency` needs tick 2 even where only one tick is to be corrected.
    const std::int64_t last = config.method == RelockMethod::frequency && config.ticks == 1 ? 2 : config.ticks;
    const bool is_idle = config.method == RelockMethod::none && !config.presumes;
    if (is_idle || !state.armed || state.since_gap >= last) return {};
    ++state.since_gap;
    if (config.method == RelockMethod::frequency) return frequency_step(gyro, config.ticks, state, tick);
    FalseAngle found;
    if (config.method == RelockMethod::detuning)
        found = by_detuning(gyro, tick);
    else if (config.method != RelockMethod::none)
        found = by_mean_square(gyro, tick, config.method == RelockMethod::joint);
    return {.due = true, .tick = or_missing(found, most_arcsec(gyro, state, tick))};
}

double pushed_arcsec2(const CompensationConstants& gyro, const RelockDriftConfig& config, const RelockDriftState& state,
                      const RelockTick& tick, double variance_arcsec2) noexcept {
    if (state.armed && state.since_gap < config.ticks) return 0.0;
    if (config.method == RelockMethod::none || config.method == RelockMethod::frequency) return 0.0;
    const double unit = arcsec_per_lambda2(gyro, gyro.bias);
    const double first_lambda2 = tick.first.detuning_sq_lambda2, second_lambda2 = tick.second.detuning_sq_lambda2;
    if (!(first_lambda2 > 0.0 && second_lambda2 > 0.0)) return square(unit) * square(square(unseen_detuning_lambda));
    const double change_lambda2 = loss_at(gyro.bend, second_lambda2).value - loss_at(gyro.bend, first_lambda2).value;
    // Variance of the difference of two mean squares of n samples: by noise alone, and of a perimeter that swings.
    const double s2 = square(gyro.light_noise.value());
    const double seen_lambda2 = first_lambda2 + second_lambda2;
    const double hidden_arcsec2 = hidden_part * variance_arcsec2;
    const bool is_hidden = square(unit * change_lambda2) <= hidden_arcsec2;
    if (is_hidden && 4.0 * square(unit) * s2 * seen_lambda2 <= hidden_arcsec2 * gyro.light_samples) return 0.0;
    const double settled_arcsec2 = 4.0 * square(unit * s2) / gyro.light_samples;
    const bool swings = seen_lambda2 > swinging_ratio * s2;
    RelockDriftState closing{.armed = true};
    const FalseAngle left = step(gyro, config, closing, tick).tick;
    const bool is_real = left.known && (swings || square(left.value_arcsec) > unsubtracted_gate_sq * settled_arcsec2);
    return is_real ? square(left.value_arcsec) + left.variance_arcsec2 : 0.0;
}

}  // namespace zlg::core
