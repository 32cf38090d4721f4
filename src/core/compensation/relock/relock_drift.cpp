#include <zlg/core/compensation/relock_drift.hpp>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "relock_light.hpp"

namespace zlg::core {
namespace {

// No rotation is that large, whatever the scale; its square and any sum of such angles are still numbers.
constexpr double max_false_angle_arcsec = 1e30;

double bias_at_hz(const CompensationConstants& g, double temperature_c) noexcept {
    return bias_at(g, Celsius{temperature_c}).value();
}

// The false angle of one tick from its false rate, with the sign of the first half.
FalseAngle false_angle(const CompensationConstants& g, int sign, double rate_hz, double variance_hz2) noexcept {
    const double arcsec_per_hz = sign * g.scale.value() * g.tick.value();
    const FalseAngle angle{true, arcsec_per_hz * rate_hz, square(arcsec_per_hz) * variance_hz2};
    const bool possible = is_within(angle.value_arcsec, -max_false_angle_arcsec, max_false_angle_arcsec);
    return possible && is_finite(angle.variance_arcsec2) ? angle : FalseAngle{};
}

FalseAngle missing(const CompensationConstants& g, double rate_hz) noexcept {
    FalseAngle angle = false_angle(g, 1, 0.0, square(rate_hz));
    angle.known = false;
    return angle;
}

// With rho the ratio of the detuning from half to half, its square falls from tick to tick by rho^4: its change within
// tick n, (1 - rho^2) rho^(4 (n - 1)) of the first, is at most 1/(2 n - 1).
//
// before  the state when this tick began: its own second half shows the detuning that remains after it.
double max_missing_hz(const CompensationConstants& g, const RelockDriftState& before, const RelockTick& t) noexcept {
    const bool seen = before.last_sq_lambda2 >= 0.0;
    const double max_sq = seen ? before.last_sq_lambda2 : 0.5 * square(max_detuning.value());
    const double n = static_cast<double>(before.n_unknown + 1);
    return 0.5 * g.chi * bias_at_hz(g, t.temperature_c) * max_sq / (2.0 * n - 1.0);
}

struct TrueTick {
    TrueMoments first;
    TrueMoments second;
};

// The tick as the curve sees it. `detuning` alone does not need the mean square: NaN then stands for no motion.
TrueTick true_tick(const CompensationConstants& g, const RelockTick& t) noexcept {
    const double s2 = square(g.light_noise.value());
    return {true_moments(g.record_curve, t.detuning_first_lambda, t.detuning_sq_first_lambda2, s2),
            true_moments(g.record_curve, t.detuning_second_lambda, t.detuning_sq_second_lambda2, s2)};
}

FalseAngle by_mean_square(const CompensationConstants& g, const RelockTick& t) noexcept {
    const TrueTick seen = true_tick(g, t);
    const double first = about(g.centre, seen.first);
    const double second = about(g.centre, seen.second);
    if (!(first >= 0.0 && second >= 0.0 && first + second > 0.0)) return {};
    if (!(first + second < square(max_detuning_lambda))) return {};
    const double half_chi_f0 = 0.5 * g.chi * bias_at_hz(g, t.temperature_c);
    // Mean of n squares (dl + e)^2: variance (4 dl^2 s^2 + 2 s^4)/n; the measured mean holds dl^2 + s^2.
    const double s2 = square(g.light_noise.value()) * 0.5 * (noise_gain(g, seen.first) + noise_gain(g, seen.second));
    const double above = first + second - 2.0 * s2;
    const double variance = (4.0 * (above > 0.0 ? above : 0.0) * s2 + 4.0 * s2 * s2) / g.light_samples;
    return false_angle(g, t.sign, half_chi_f0 * (second - first), square(half_chi_f0) * variance);
}

FalseAngle by_detuning(const CompensationConstants& g, const RelockTick& t) noexcept {
    const TrueTick seen = true_tick(g, t);
    const double first = seen.first.mean_lambda;
    const double second = seen.second.mean_lambda;
    const double rho = second / first;
    if (!(rho > 0.0 && rho < 1.0 && first < max_detuning_lambda && first > -max_detuning_lambda)) return {};
    const double quarter_chi_f0 = 0.25 * g.chi * bias_at_hz(g, t.temperature_c);
    const double sum = first + second;
    const double log_rho = maths::log(rho);
    const double centre = 4.0 * g.centre.value();
    const double by_first = seen.first.slope * (sum * (2.0 * log_rho - sum / first) + centre);
    const double by_second = seen.second.slope * (sum * (2.0 * log_rho + sum / second) - centre);
    const double s2 = square(g.light_noise.value()) / g.light_samples;
    return false_angle(g, t.sign, quarter_chi_f0 * (log_rho * sum * sum - centre * (second - first)),
                       square(quarter_chi_f0) * (square(by_first) + square(by_second)) * s2);
}

double deficit_hz(const CompensationConstants& g, const RelockTick& t) noexcept {
    const double difference = as_double(t.counts_first) - as_double(t.counts_second);
    return t.sign * (difference - t.known_excess_counts) / g.tick.value() - bias_at_hz(g, t.temperature_c);
}

// Variance of a false rate by counter rounding, from its slopes by the two deficits that make it; that of whole counts, also
// where the phases are known.
//
// The rounding of c_first - c_second is 2 e1 - e0 - e2, each e uniform over a count: variance 1/2 count^2. Neighbouring
// ticks share a reading: covariance 1/12 count^2.
double rounding_variance(const CompensationConstants& g, double by_own, double by_other, bool neighbours) noexcept {
    const double shared = neighbours ? by_own * by_other / 6.0 : 0.0;
    return (0.5 * (square(by_own) + square(by_other)) + shared) / square(g.tick.value());
}

struct Decay {
    bool usable = false;
    double q = 0.0;  // from one half to the next
};

// From the deficits of tick 1 and of tick i >= 2.
Decay decay(double deficit, double first_deficit, double i) noexcept {
    const double ratio = deficit / first_deficit;
    if (!(ratio > 0.0 && ratio < 1.0)) return {};
    return {true, maths::exp(maths::log(ratio) / (2.0 * (i - 1.0)))};
}

// Tick i >= 2 from its own deficit and that of tick 1.
FalseAngle by_frequency(const CompensationConstants& g, const RelockDriftState& s, const RelockTick& t, double deficit,
                        double q) noexcept {
    const double root = 2.0 * static_cast<double>(s.since_gap - 1);
    const double slope = 2.0 * q / square(1.0 + q) / root;  // of (1 - q)/(1 + q) by minus the logarithm of the ratio
    const double part = (1.0 - q) / (1.0 + q);
    const double by_first = slope * deficit / s.first_deficit_hz;
    return false_angle(g, t.sign, deficit * part, rounding_variance(g, part - slope, by_first, s.since_gap == 2));
}

// Tick 1 with the q of tick 2.
FalseAngle first_by_frequency(const CompensationConstants& g, const RelockDriftState& s, const RelockTick& t,
                              double deficit, double q) noexcept {
    const double slope = q / square(1.0 + q);
    const double part = (1.0 - q) / (1.0 + q);
    const double by_second = -slope * s.first_deficit_hz / deficit;
    return false_angle(g, t.sign, s.first_deficit_hz * part, rounding_variance(g, part + slope, by_second, true));
}

// Of a tick by its deficit alone: a false rate is no larger. Within its rounding it is none.
FalseAngle or_deficit(const CompensationConstants& g, const RelockDriftState& before, const RelockTick& t,
                      FalseAngle found, double deficit, double max_hz) noexcept {
    if (found.known) return found;
    if (t.with_phase) {
        const bool is_bound = before.last_sq_lambda2 >= 0.0 || size(deficit) > max_hz;
        return missing(g, is_bound ? max_hz : deficit);
    }
    const double above = square(deficit) - 2.0 * rounding_variance(g, 1.0, 0.0, false);
    if (!(above > 0.0)) return missing(g, 0.0);
    return missing(g, above < square(max_hz) ? deficit : max_hz);
}

RelockDriftOutput frequency_step(const CompensationConstants& g, std::int64_t ticks, RelockDriftState& s,
                                 const RelockDriftState& before, const RelockTick& t) noexcept {
    RelockDriftOutput out{.due = s.since_gap <= ticks};
    if (s.since_gap == 1) {
        s.first_deficit_hz = deficit_hz(g, t);
        s.first_max_hz = max_missing_hz(g, before, t);
        out.waiting = true;
        return out;
    }
    const double deficit = deficit_hz(g, t);
    const Decay d = decay(deficit, s.first_deficit_hz, static_cast<double>(s.since_gap));
    out.first_due = s.since_gap == 2;
    if (d.usable && out.due) out.tick = by_frequency(g, s, t, deficit, d.q);
    if (d.usable && out.first_due) out.first = first_by_frequency(g, s, t, deficit, d.q);
    const double max_hz = max_missing_hz(g, before, t);
    if (out.due) out.tick = or_deficit(g, before, t, out.tick, deficit, max_hz);
    if (out.first_due) out.first = or_deficit(g, before, t, out.first, s.first_deficit_hz, s.first_max_hz);
    return out;
}

// What each tick shows of where the detuning is, whether or not it is to be corrected.
void observe_detuning(const CompensationConstants& g, std::int64_t ticks, RelockDriftState& s,
                      const RelockTick& t) noexcept {
    const TrueMoments seen = true_moments(g.record_curve, t.detuning_second_lambda, t.detuning_sq_second_lambda2,
                                          square(g.light_noise.value()));
    const bool squared = t.detuning_sq_second_lambda2 > 0.0;
    // Where the detuning falls thirtyfold within the half, the square of its mean is about half of its mean square.
    const double by_mean = 2.0 * square(seen.mean_lambda - g.centre.value());
    const double second = squared ? about(g.centre, seen) : by_mean;
    const bool measured = squared || t.detuning_second_lambda != 0.0;
    const bool is_seen = measured && second >= 0.0 && second < square(max_detuning.value());
    if (is_seen) s.last_sq_lambda2 = second;
    s.n_unknown = is_seen ? 0 : s.n_unknown + (s.n_unknown < ticks);
}

FalseAngle or_missing(const CompensationConstants& g, const RelockDriftState& before, const RelockTick& t,
                      FalseAngle found) noexcept {
    return found.known ? found : missing(g, max_missing_hz(g, before, t));
}

}  // namespace

void enter_gap(RelockDriftState& state, bool moves) noexcept {
    const RelockDriftState before = state;
    state = RelockDriftState{.armed = true};
    if (moves) return;
    state.last_sq_lambda2 = before.last_sq_lambda2;
    state.n_unknown = before.n_unknown;
}

RelockDriftOutput step(const CompensationConstants& gyro, const RelockDriftConfig& config, RelockDriftState& state,
                       const RelockTick& tick) noexcept {
    // Tick 1 of `frequency` needs tick 2 even where only one tick is to be corrected.
    const std::int64_t last = config.method == RelockMethod::frequency && config.ticks == 1 ? 2 : config.ticks;
    const bool is_idle = config.method == RelockMethod::none && !config.presumes;
    if (is_idle || !state.armed || state.since_gap >= last) {
        observe_detuning(gyro, config.ticks, state, tick);
        return {};
    }
    const RelockDriftState before = state;
    observe_detuning(gyro, config.ticks, state, tick);
    ++state.since_gap;
    switch (config.method) {
        case RelockMethod::frequency:
            return frequency_step(gyro, config.ticks, state, before, tick);
        case RelockMethod::detuning:
            return {.due = true, .tick = or_missing(gyro, before, tick, by_detuning(gyro, tick))};
        case RelockMethod::mean_square:
        case RelockMethod::joint:  // what is known before the halves around the gap are weighed together
            return {.due = true, .tick = or_missing(gyro, before, tick, by_mean_square(gyro, tick))};
        case RelockMethod::none:
            break;
    }
    return {.due = true, .tick = or_missing(gyro, before, tick, {})};
}

}  // namespace zlg::core
