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

// sigma_p of (3) from what was presumed up to which the estimate is trusted in full, and from which on not at all.
constexpr double near_sigmas = 2.0;
constexpr double far_sigmas = 3.0;

// The drift as presumed, without what the segments have shown.
struct Presumed {
    double drift_arcsec_s = 0.0;
    double variance = 0.0;
};

Presumed presumed_at(const MagneticDriftConfig& c, double age_s) noexcept {
    const double warmed = 1.0 - maths::exp(-age_s / c.thermal_time.value());
    const double sigma = c.presumed_sigma_arcsec_s, warming = c.warming_sigma_arcsec_s * warmed;
    return {.drift_arcsec_s = c.presumed_arcsec_s + c.warming_arcsec_s * warmed,
            .variance = sigma * sigma + warming * warming + wander_variance(age_s, c.thermal_time.value())};
}

void start(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    const double tau_s = c.thermal_time.value();
    s.started = true;
    s.filter.estimate[of_drift] = c.presumed_arcsec_s;
    s.filter.estimate[of_trend] = c.warming_arcsec_s / tau_s;
    s.filter.covariance[of_drift][of_drift] = c.presumed_sigma_arcsec_s * c.presumed_sigma_arcsec_s;
    s.filter.covariance[of_trend][of_trend] = (c.warming_sigma_arcsec_s / tau_s) * (c.warming_sigma_arcsec_s / tau_s);
}

// Variance of the drift by the motion in step that the segments show.
double motion_variance(const MagneticFilterState& f) noexcept {
    const double interval_s = f.in_step.interval_s;
    return seen_in_step(f.in_step, f.covariance[of_trend][of_trend] * interval_s * interval_s);
}

// sigma^2 of (3).
double shown_variance(const MagneticFilterState& f) noexcept {
    return f.covariance[of_drift][of_drift] + mismatch_sq(f.in_step) + motion_variance(f);
}

// 0..1: how far the drift contradicts what was presumed.
double contradiction(const Presumed& presumed, double drift) noexcept {
    const double distance = drift - presumed.drift_arcsec_s;
    const double over = distance * distance - near_sigmas * near_sigmas * presumed.variance;
    const double range = (far_sigmas * far_sigmas - near_sigmas * near_sigmas) * presumed.variance;
    if (!(over > 0.0)) return 0.0;
    return over < range ? over / range : 1.0;
}

// (3), as far as the segments go.
double share_of(const MagneticDriftState& s) noexcept {
    const double drift_sq = s.filter.estimate[of_drift] * s.filter.estimate[of_drift];
    const double unknown = min_sigmas * min_sigmas * shown_variance(s.filter);
    return unknown < drift_sq ? 1.0 - unknown / drift_sq : 0.0;
}

void update_trust(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    const double drift = s.filter.estimate[of_drift];
    s.share = share_of(s);
    const bool acts = c.method == MagneticMethod::estimate && s.share > 0.0;
    s.trust = acts ? s.share * (1.0 - contradiction(presumed_at(c, s.age_s), drift)) : 0.0;
    s.due_arcsec = s.trust * s.filter.estimate[of_angle];
}

// Predict up to the present tick.
void predict_to_now(const CompensationConstants& gyro, const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    if (s.pending_ticks == 0) return;
    const double time_s = static_cast<double>(s.pending_ticks) * gyro.tick.value();
    predict(s.filter, s.mode, time_s, c.thermal_time.value());
    s.age_s += time_s;
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

void begin_segment(MagneticDriftState& s, std::int8_t mode) noexcept {
    if (s.last_mode == -mode) {
        if (s.switched_s > 0.0) note_switch(s.filter.in_step, s.age_s - s.switched_s);
        s.switched_s = s.age_s;
    }
    s.last_mode = mode;
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
    const std::int8_t mode = measured ? tick.mode : std::int8_t{0};
    if (mode != state.mode) {
        end_segment(gyro, config, state);
        if (mode != 0) begin_segment(state, mode);
    }
    state.mode = mode;
    if (++state.pending_ticks >= block_ticks) predict_to_now(gyro, config, state);
    if (mode == 0) return 0.0;
    accumulate(state.segment, tick.angle_arcsec);
    return subtract(gyro, config, state);
}

double trusted_arcsec_s(const MagneticDriftState& state) noexcept {
    const double drift = state.filter.estimate[of_drift];
    const double unknown = min_sigmas * min_sigmas * state.filter.covariance[of_drift][of_drift];
    return state.started && unknown < drift * drift ? drift - unknown / drift : 0.0;
}

double sigma_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept {
    const MagneticFilterState& f = state.filter;
    const Presumed presumed = presumed_at(config, state.age_s);
    const double distance = f.estimate[of_drift] - presumed.drift_arcsec_s;
    // All that motion can have done to a drift that was presumed rightly, and what is open where the two contradict.
    const double most = presumed.variance + distance * distance;
    const double least = contradiction(presumed, f.estimate[of_drift]) * most;
    const double motion = motion_variance(f) + unseen_in_step(f.in_step);
    const double open = motion < most ? motion : most;
    return square_root(f.covariance[of_drift][of_drift] + mismatch_sq(f.in_step) + (open > least ? open : least));
}

double remaining_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept {
    if (config.method == MagneticMethod::none || state.share == 0.0) return 0.0;
    const double residual = (1.0 - state.trust) * state.filter.estimate[of_drift];
    const double wrong_sq = state.trust * state.trust * shown_variance(state.filter);
    return square_root(residual * residual + wrong_sq);
}

}  // namespace zlg::core
