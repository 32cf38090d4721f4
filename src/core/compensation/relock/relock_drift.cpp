#include <zlg/core/compensation/relock_drift.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// No perimeter is detuned by a thousand wavelengths: such a number is damage, and would overflow further on.
constexpr double max_detuning_lambda = 1e3;

// No rotation is that large, whatever the scale; its square and any sum of such angles are still numbers.
constexpr double max_false_angle_arcsec = 1e30;

// Within these a tick's counts make an angle whose square is a number.
constexpr double min_tick_s = 1e-9;
constexpr double max_tick_s = 1e9;
constexpr double max_scale_arcsec = 1e9;
constexpr double max_bias_hz = 1e15;

bool is_within(double x, double min, double max) noexcept { return x >= min && x <= max; }

double square(double x) noexcept { return x * x; }

double bias_at_hz(const RelockDriftConfig& c, double temperature_c) noexcept {
    return bias_at(c, Celsius{temperature_c}).value();
}

// The false angle of one tick from its false rate, with the sign of the first half.
FalseAngle false_angle(const RelockDriftConfig& c, int sign, double rate_hz, double variance_hz2) noexcept {
    const double arcsec_per_hz = sign * c.scale.value() * c.tick.value();
    const FalseAngle angle{true, arcsec_per_hz * rate_hz, square(arcsec_per_hz) * variance_hz2};
    const bool possible = is_within(angle.value_arcsec, -max_false_angle_arcsec, max_false_angle_arcsec);
    return possible && is_finite(angle.variance_arcsec2) ? angle : FalseAngle{};
}

FalseAngle missing(const RelockDriftConfig& c, double rate_hz) noexcept {
    FalseAngle angle = false_angle(c, 1, 0.0, square(rate_hz));
    angle.known = false;
    return angle;
}

// The square falls from tick to tick like q^(4 i): its part (1 - q^2) q^(4 (n - 1)) in tick n is at most 1/(2 n - 1).
//
// before  the state when this tick began: what its own second half shows is what is left after it.
double max_missing_hz(const RelockDriftConfig& c, const RelockDriftState& before, const RelockTick& t) noexcept {
    const bool seen = before.last_sq_lambda2 >= 0.0;
    const double max_sq = seen ? before.last_sq_lambda2 : 0.5 * square(max_detuning.value());
    const double n = static_cast<double>(before.n_unknown + 1);
    return 0.5 * c.chi * bias_at_hz(c, t.temperature_c) * max_sq / (2.0 * n - 1.0);
}

struct TrueTick {
    TrueMoments first;
    TrueMoments second;
};

// The tick as the curve sees it. `detuning` alone does not need the mean square: NaN then stands for no motion.
TrueTick true_tick(const RelockDriftConfig& c, const RelockTick& t) noexcept {
    const double s2 = square(c.light_noise.value());
    return {true_moments(c.curve, t.detuning_first_lambda, t.detuning_sq_first_lambda2, s2),
            true_moments(c.curve, t.detuning_second_lambda, t.detuning_sq_second_lambda2, s2)};
}

// Of the variance of a sample's noise: by the slope of the curve that the detuning has come through, here or in the control.
double noise_gain(const RelockDriftConfig& c, const TrueMoments& seen) noexcept {
    if (c.curve.n_nodes != 0 || c.control_curve.n_nodes == 0) return square(seen.slope);
    return square(slope_behind(c.control_curve, seen.mean_lambda));
}

FalseAngle by_mean_square(const RelockDriftConfig& c, const RelockTick& t) noexcept {
    const TrueTick seen = true_tick(c, t);
    const double first = about(c.centre, seen.first);
    const double second = about(c.centre, seen.second);
    if (!(first >= 0.0 && second >= 0.0 && first + second > 0.0)) return {};
    if (!(first + second < square(max_detuning_lambda))) return {};
    const double half_chi_f0 = 0.5 * c.chi * bias_at_hz(c, t.temperature_c);
    // Mean of n squares (dl + e)^2: variance (4 dl^2 s^2 + 2 s^4)/n; the measured mean holds dl^2 + s^2.
    const double s2 = square(c.light_noise.value()) * 0.5 * (noise_gain(c, seen.first) + noise_gain(c, seen.second));
    const double above = first + second - 2.0 * s2;
    const double variance = (4.0 * (above > 0.0 ? above : 0.0) * s2 + 4.0 * s2 * s2) / c.light_samples;
    return false_angle(c, t.sign, half_chi_f0 * (second - first), square(half_chi_f0) * variance);
}

FalseAngle by_detuning(const RelockDriftConfig& c, const RelockTick& t) noexcept {
    const TrueTick seen = true_tick(c, t);
    const double first = seen.first.mean_lambda;
    const double second = seen.second.mean_lambda;
    const double rho = second / first;
    if (!(rho > 0.0 && rho < 1.0 && first < max_detuning_lambda && first > -max_detuning_lambda)) return {};
    const double quarter_chi_f0 = 0.25 * c.chi * bias_at_hz(c, t.temperature_c);
    const double sum = first + second;
    const double log_rho = natural_log(rho);
    const double centre = 4.0 * c.centre.value();
    const double by_first = seen.first.slope * (sum * (2.0 * log_rho - sum / first) + centre);
    const double by_second = seen.second.slope * (sum * (2.0 * log_rho + sum / second) - centre);
    const double s2 = square(c.light_noise.value()) / c.light_samples;
    return false_angle(c, t.sign, quarter_chi_f0 * (log_rho * sum * sum - centre * (second - first)),
                       square(quarter_chi_f0) * (square(by_first) + square(by_second)) * s2);
}

double deficit_hz(const RelockDriftConfig& c, const RelockTick& t) noexcept {
    const double difference = as_double(t.counts_first) - as_double(t.counts_second);
    return t.sign * (difference - t.known_excess_counts) / c.tick.value() - bias_at_hz(c, t.temperature_c);
}

// Variance of a false rate by counter rounding, from its slopes by the two deficits that make it.
//
// The rounding of c_first - c_second is 2 e1 - e0 - e2, each e uniform over a count: variance 1/2 count^2. Neighbouring
// ticks share a reading: covariance 1/12 count^2.
double rounding_variance(const RelockDriftConfig& c, double by_own, double by_other, bool neighbours) noexcept {
    const double shared = neighbours ? by_own * by_other / 6.0 : 0.0;
    return (0.5 * (square(by_own) + square(by_other)) + shared) / square(c.tick.value());
}

struct Decay {
    bool usable = false;
    double q = 0.0;  // from one half to the next
};

// From the deficits of tick 1 and of tick i >= 2.
Decay decay(double deficit, double first_deficit, double i) noexcept {
    const double ratio = deficit / first_deficit;
    if (!(ratio > 0.0 && ratio < 1.0)) return {};
    return {true, exponential(natural_log(ratio) / (2.0 * (i - 1.0)))};
}

// Tick i >= 2 from its own deficit and that of tick 1.
FalseAngle by_frequency(const RelockDriftConfig& c, const RelockDriftState& s, const RelockTick& t, double deficit,
                        double q) noexcept {
    const double root = 2.0 * static_cast<double>(s.since_gap - 1);
    const double slope = 2.0 * q / square(1.0 + q) / root;  // of (1 - q)/(1 + q) by minus the logarithm of the ratio
    const double part = (1.0 - q) / (1.0 + q);
    const double by_first = slope * deficit / s.first_deficit_hz;
    return false_angle(c, t.sign, deficit * part, rounding_variance(c, part - slope, by_first, s.since_gap == 2));
}

// Tick 1 with the q of tick 2.
FalseAngle first_by_frequency(const RelockDriftConfig& c, const RelockDriftState& s, const RelockTick& t,
                              double deficit, double q) noexcept {
    const double slope = q / square(1.0 + q);
    const double part = (1.0 - q) / (1.0 + q);
    const double by_second = -slope * s.first_deficit_hz / deficit;
    return false_angle(c, t.sign, s.first_deficit_hz * part, rounding_variance(c, part + slope, by_second, true));
}

// Of a tick by its deficit alone: a false rate is no larger. Within its rounding it is none.
FalseAngle or_deficit(const RelockDriftConfig& c, FalseAngle found, double deficit, double max_hz) noexcept {
    if (found.known) return found;
    const double above = square(deficit) - 2.0 * rounding_variance(c, 1.0, 0.0, false);
    if (!(above > 0.0)) return missing(c, 0.0);
    return missing(c, above < square(max_hz) ? deficit : max_hz);
}

RelockDriftOutput frequency_step(const RelockDriftConfig& c, RelockDriftState& s, const RelockDriftState& before,
                                 const RelockTick& t) noexcept {
    RelockDriftOutput out{.due = s.since_gap <= c.ticks};
    if (s.since_gap == 1) {
        s.first_deficit_hz = deficit_hz(c, t);
        s.first_most_hz = max_missing_hz(c, before, t);
        out.waiting = true;
        return out;
    }
    const double deficit = deficit_hz(c, t);
    const Decay d = decay(deficit, s.first_deficit_hz, static_cast<double>(s.since_gap));
    out.first_due = s.since_gap == 2;
    if (d.usable && out.due) out.tick = by_frequency(c, s, t, deficit, d.q);
    if (d.usable && out.first_due) out.first = first_by_frequency(c, s, t, deficit, d.q);
    const double max_hz = max_missing_hz(c, before, t);
    if (out.due) out.tick = or_deficit(c, out.tick, deficit, max_hz);
    if (out.first_due) out.first = or_deficit(c, out.first, s.first_deficit_hz, s.first_most_hz);
    return out;
}

// What each tick shows of where the detuning is, whether or not it is to be corrected.
void observe_detuning(const RelockDriftConfig& c, RelockDriftState& s, const RelockTick& t) noexcept {
    const TrueMoments seen =
        true_moments(c.curve, t.detuning_second_lambda, t.detuning_sq_second_lambda2, square(c.light_noise.value()));
    const bool squared = t.detuning_sq_second_lambda2 > 0.0;
    // A mean that falls to a thirtieth within the half has half of its mean square as its own square.
    const double by_mean = 2.0 * square(seen.mean_lambda - c.centre.value());
    const double second = squared ? about(c.centre, seen) : by_mean;
    const bool measured = squared || t.detuning_second_lambda != 0.0;
    const bool is_seen = measured && second >= 0.0 && second < square(max_detuning.value());
    if (is_seen) s.last_sq_lambda2 = second;
    s.n_unknown = is_seen ? 0 : s.n_unknown + (s.n_unknown < c.ticks);
}

FalseAngle or_missing(const RelockDriftConfig& c, const RelockDriftState& before, const RelockTick& t,
                      FalseAngle found) noexcept {
    return found.known ? found : missing(c, max_missing_hz(c, before, t));
}

}  // namespace

RelockDriftFault check(const RelockDriftConfig& c) noexcept {
    if (!(c.ticks >= 0)) return RelockDriftFault::ticks;
    if (!is_within(c.tick.value(), min_tick_s, max_tick_s)) return RelockDriftFault::tick;
    if (!(c.scale.value() > 0.0 && c.scale.value() <= max_scale_arcsec)) return RelockDriftFault::scale;
    if (!(c.bias.value() > 0.0 && c.bias.value() <= max_bias_hz)) return RelockDriftFault::bias;
    if (!(c.chi >= 0.0 && is_finite(c.chi))) return RelockDriftFault::chi;
    if (!is_finite(c.temperature_coefficient_per_c) || !is_finite(c.reference_temperature.value()))
        return RelockDriftFault::temperature;
    if (!(c.light_noise.value() >= 0.0 && is_finite(c.light_noise.value()))) return RelockDriftFault::light_noise;
    if (!(c.light_samples >= 1)) return RelockDriftFault::light_samples;
    if (!(is_within(c.centre.value(), -max_centre.value(), max_centre.value()))) return RelockDriftFault::centre;
    if (check(c.curve) != CurveFault::none || check(c.control_curve) != CurveFault::none)
        return RelockDriftFault::curve;
    return RelockDriftFault::none;
}

Hertz bias_at(const RelockDriftConfig& config, Celsius temperature) noexcept {
    if (!is_finite(temperature.value())) return config.bias;
    const double above_c = temperature.value() - config.reference_temperature.value();
    return (1.0 + config.temperature_coefficient_per_c * above_c) * config.bias;
}

void enter_gap(RelockDriftState& state, bool moves) noexcept {
    const RelockDriftState before = state;
    state = RelockDriftState{.armed = true};
    if (moves) return;
    state.last_sq_lambda2 = before.last_sq_lambda2;
    state.n_unknown = before.n_unknown;
}

RelockDriftOutput step(const RelockDriftConfig& config, RelockDriftState& state, const RelockTick& tick) noexcept {
    const RelockDriftState before = state;
    observe_detuning(config, state, tick);
    // Tick 1 of `frequency` needs tick 2 even where only one tick is to be corrected.
    const std::int64_t last = config.method == RelockMethod::frequency && config.ticks == 1 ? 2 : config.ticks;
    if (config.method == RelockMethod::none || !state.armed || state.since_gap >= last) return {};
    ++state.since_gap;
    switch (config.method) {
        case RelockMethod::frequency:
            return frequency_step(config, state, before, tick);
        case RelockMethod::detuning:
            return {.due = true, .tick = or_missing(config, before, tick, by_detuning(config, tick))};
        case RelockMethod::mean_square:
        case RelockMethod::joint:  // what is known before the halves around the gap are weighed together
            return {.due = true, .tick = or_missing(config, before, tick, by_mean_square(config, tick))};
        case RelockMethod::none:
            break;
    }
    return {};
}

}  // namespace zlg::core
