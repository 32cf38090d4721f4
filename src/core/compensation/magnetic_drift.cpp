#include <zlg/core/compensation/magnetic_drift.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Ticks between two predictions of the filter: 5 s, short against every thermal time, and cheap.
constexpr std::int32_t block_ticks = 1024;

// Gain a tick of the correction of the past, an exponential of 1024 ticks: 31 arcsec come as a count in a hundred
// ticks.
constexpr double past_correction_gain = 1.0 / 1024.0;

// Shorter segments, half a second, are not worth an update.
constexpr std::int64_t min_ticks = 100;

// No gyro turns faster.
constexpr double fastest_arcsec_s = 1e7;

// Standard deviations of the drift at which the method begins to act: (3). docs/long_runs.md has the bases on which it
// was judged.
constexpr double min_sigmas = 4.0;

bool is_known(double sigma, double drift_arcsec_s) noexcept { return min_sigmas * sigma < size(drift_arcsec_s); }

void start(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    const double tau_s = c.thermal_time.value();
    s.started = true;
    s.filter.estimate[of_drift] = c.presumed_arcsec_s;
    s.filter.estimate[of_trend] = c.warming_arcsec_s / tau_s;
    s.filter.covariance[of_drift][of_drift] = c.presumed_sigma_arcsec_s * c.presumed_sigma_arcsec_s;
    s.filter.covariance[of_trend][of_trend] = (c.warming_sigma_arcsec_s / tau_s) * (c.warming_sigma_arcsec_s / tau_s);
}

// (3).
double trust_of(const MagneticFilterState& filter) noexcept {
    const double drift = filter.estimate[of_drift];
    const double variance = filter.covariance[of_drift][of_drift];
    if (!is_known(square_root(variance), drift)) return 0.0;
    return 1.0 - min_sigmas * min_sigmas * variance / (drift * drift);
}

void update_trust(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    s.trust = c.method == MagneticMethod::estimate ? trust_of(s.filter) : 0.0;
    s.due_arcsec = s.trust * s.filter.estimate[of_angle];
}

// Predict up to the present tick.
void predict_to_now(const CompensationConstants& gyro, const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    if (s.pending_ticks == 0) return;
    predict(s.filter, s.mode, static_cast<double>(s.pending_ticks) * gyro.tick.value(), c.thermal_time.value());
    s.pending_ticks = 0;
    update_trust(c, s);
}

void end_segment(const CompensationConstants& gyro, const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    predict_to_now(gyro, c, s);
    if (s.mode != 0 && s.segment.n_ticks >= min_ticks) {
        const double tick_s = gyro.tick.value();
        update(s.filter,
               {.mode = static_cast<double>(s.mode),
                .length_s = static_cast<double>(s.segment.n_ticks) * tick_s,
                .rate = rate_of(s.segment, tick_s),
                .variance = mean_rate_variance(s.segment, tick_s, gyro.random_walk.value(), gyro.scale.value())});
        update_trust(c, s);
    }
    s.segment = {};
    s.mode = 0;
}

bool is_credible(const CompensationConstants& gyro, const MagneticTick& tick) noexcept {
    return size(tick.angle_arcsec) <= fastest_arcsec_s * gyro.tick.value();
}

double subtract(const CompensationConstants& gyro, const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    if (c.method != MagneticMethod::estimate) return 0.0;
    const double tick_s = gyro.tick.value();
    // First-order growth since the last prediction, bounded however short the thermal time; the next prediction
    // corrects the rest.
    const double pending_s = static_cast<double>(s.pending_ticks) * tick_s;
    const double effective_s = pending_s / (1.0 + pending_s / c.thermal_time.value());
    const double drift = s.filter.estimate[of_drift] + s.filter.estimate[of_trend] * effective_s;
    const double now = s.trust * static_cast<double>(s.mode) * drift * tick_s;
    const double past = past_correction_gain * (s.due_arcsec - s.subtracted_arcsec);
    s.due_arcsec += now;
    s.subtracted_arcsec += now + past;
    return now + past;
}

// Take the steps of the field out of a tick, and see to it that the filter learns nothing from what was not yet taken out.
double without_steps(const CompensationConstants& gyro, const MagneticDriftConfig& c, MagneticDriftState& s,
                     const MagneticTick& tick, bool measured) noexcept {
    s.variance_arcsec2 = 0.0;
    if (c.method != MagneticMethod::estimate) return 0.0;
    const FieldStepPrior prior{.drift_arcsec_s = c.presumed_arcsec_s,
                               .drift_variance = c.presumed_sigma_arcsec_s * c.presumed_sigma_arcsec_s,
                               .sway_arcsec_s = s.filter.scatter_arcsec_s};
    if (!measured) {
        if (s.mode != 0 && pause(gyro, prior, s.field, tick.with_phase)) s.segment = {};
        return 0.0;
    }
    const FieldStepOutput found =
        step(gyro, prior, s.field, {tick.mode, tick.angle_arcsec, tick.settled, tick.with_phase});
    s.variance_arcsec2 = found.variance_arcsec2;
    if (s.field.change_variance > 0.0) {
        s.segment = {};
        s.filter.covariance[of_drift][of_drift] += s.field.change_variance;
        update_trust(c, s);
    }
    return found.subtract_arcsec;
}

}  // namespace

MagneticDriftFault check(const MagneticDriftConfig& c) noexcept {
    const auto is_sigma = [](double x) { return x >= 0.0 && x <= 1e6; };
    const auto is_time = [](double x) { return x >= 1e-9 && x <= 1e12; };
    if (!(size(c.presumed_arcsec_s) <= 1e6 && is_sigma(c.presumed_sigma_arcsec_s))) return MagneticDriftFault::presumed;
    const bool warming = size(c.warming_arcsec_s) <= 1e6 && is_sigma(c.warming_sigma_arcsec_s);
    if (!(warming && is_time(c.thermal_time.value()))) return MagneticDriftFault::warming;
    return MagneticDriftFault::none;
}

double step(const CompensationConstants& gyro, const MagneticDriftConfig& config, MagneticDriftState& state,
            const MagneticTick& tick) noexcept {
    if (!state.started) start(config, state);
    const bool credible = is_credible(gyro, tick);
    if (!credible) state.segment = {};
    const bool measured = tick.measured && credible && tick.mode != 0;
    const double of_steps = without_steps(gyro, config, state, tick, measured);
    const std::int8_t mode = measured ? tick.mode : std::int8_t{0};
    if (mode != state.mode) end_segment(gyro, config, state);
    state.mode = mode;
    if (++state.pending_ticks >= block_ticks) predict_to_now(gyro, config, state);
    if (mode == 0) return 0.0;
    const double of_field = state.field.field_arcsec_s * gyro.tick.value() * static_cast<double>(mode);
    accumulate(state.segment, tick.angle_arcsec - of_field);
    return of_steps + subtract(gyro, config, state);
}

double trusted_arcsec_s(const MagneticDriftState& state) noexcept {
    return state.started ? trust_of(state.filter) * state.filter.estimate[of_drift] : 0.0;
}

double sigma_arcsec_s(const MagneticDriftState& state) noexcept {
    return square_root(state.filter.covariance[of_drift][of_drift]);
}

double remaining_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept {
    const double drift = state.filter.estimate[of_drift];
    const double sigma = sigma_arcsec_s(state);
    if (config.method == MagneticMethod::none || !state.started || !is_known(sigma, drift)) return 0.0;
    const double residual = (1.0 - state.trust) * drift;
    const double wrong = state.trust * sigma;
    return square_root(residual * residual + wrong * wrong);
}

}  // namespace zlg::core
