#include <zlg/core/compensation/magnetic_drift.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "magnetic_filter.hpp"

namespace zlg::core {
namespace {

// Between two predictions of the filter.
constexpr std::int32_t block_ticks = 1024;

// A correction of the past is spread over some such blocks: 31 arcsec are then no more than a count in a hundred ticks.
constexpr double catch_up = 1.0 / 1024.0;

// Shorter segments are not worth an update.
constexpr std::int64_t min_ticks = 100;

// No gyro turns faster.
constexpr double fastest_arcsec_s = 1e7;

// Of the drift, at which it begins to act.
constexpr double min_sigmas = 4.0;

bool is_known(double sigma, double drift_arcsec_s) noexcept { return min_sigmas * sigma < size(drift_arcsec_s); }

void start(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    const double tau_s = c.thermal_time.value();
    s.started = true;
    s.estimate[of_drift] = c.presumed_arcsec_s;
    s.estimate[of_trend] = c.warming_arcsec_s / tau_s;
    s.covariance[of_drift][of_drift] = c.presumed_sigma_arcsec_s * c.presumed_sigma_arcsec_s;
    s.covariance[of_trend][of_trend] = (c.warming_sigma_arcsec_s / tau_s) * (c.warming_sigma_arcsec_s / tau_s);
    s.scatter_arcsec_s = presumed_scatter_arcsec_s;
}

void weigh(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    const double drift = s.estimate[of_drift];
    const double variance = s.covariance[of_drift][of_drift];
    const bool acts = c.method == MagneticMethod::estimate && is_known(square_root(variance), drift);
    s.trust = acts ? 1.0 - min_sigmas * min_sigmas * variance / (drift * drift) : 0.0;
    s.due_arcsec = s.trust * s.estimate[of_angle];
}

// Bring the estimate to the present.
void catch_time_up(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    if (s.pending_ticks == 0) return;
    predict(s, static_cast<double>(s.pending_ticks) * c.tick.value(), c.thermal_time.value());
    s.pending_ticks = 0;
    weigh(c, s);
}

void end_segment(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    catch_time_up(c, s);
    if (s.mode != 0 && s.segment.n_ticks >= min_ticks) {
        const double tick_s = c.tick.value();
        update(s, {.mode = static_cast<double>(s.mode),
                   .length_s = static_cast<double>(s.segment.n_ticks) * tick_s,
                   .rate = rate_of(s.segment, tick_s),
                   .variance = mean_rate_variance(s.segment, tick_s, c.walk.value(), c.count.value())});
        weigh(c, s);
    }
    s.segment = {};
    s.mode = 0;
}

bool is_credible(const MagneticDriftConfig& c, const MagneticTick& tick) noexcept {
    return size(tick.angle_arcsec) <= fastest_arcsec_s * c.tick.value();
}

double subtract(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    if (c.method != MagneticMethod::estimate) return 0.0;
    const double tick_s = c.tick.value();
    // Bounded however short the thermal time; what it lacks, the next prediction makes good.
    const double pending_s = static_cast<double>(s.pending_ticks) * tick_s;
    const double grown_s = pending_s / (1.0 + pending_s / c.thermal_time.value());
    const double drift = s.estimate[of_drift] + s.estimate[of_trend] * grown_s;
    const double now = s.trust * static_cast<double>(s.mode) * drift * tick_s;
    const double past = catch_up * (s.due_arcsec - s.subtracted_arcsec);
    s.due_arcsec += now;
    s.subtracted_arcsec += now + past;
    return now + past;
}

}  // namespace

MagneticDriftFault check(const MagneticDriftConfig& c) noexcept {
    const auto is_sigma = [](double x) { return x >= 0.0 && x <= 1e6; };
    const auto is_time = [](double x) { return x >= 1e-9 && x <= 1e12; };
    if (c.method == MagneticMethod::none) return MagneticDriftFault::none;
    if (!is_time(c.tick.value())) return MagneticDriftFault::tick;
    if (!(is_sigma(c.walk.value()) && c.count.value() >= 0.0 && c.count.value() <= 1e9))
        return MagneticDriftFault::noise;
    if (!(size(c.presumed_arcsec_s) <= 1e6 && is_sigma(c.presumed_sigma_arcsec_s))) return MagneticDriftFault::presumed;
    const bool warming = size(c.warming_arcsec_s) <= 1e6 && is_sigma(c.warming_sigma_arcsec_s);
    if (!(warming && is_time(c.thermal_time.value()))) return MagneticDriftFault::warming;
    return MagneticDriftFault::none;
}

double step(const MagneticDriftConfig& config, MagneticDriftState& state, const MagneticTick& tick) noexcept {
    if (config.method == MagneticMethod::none) return 0.0;
    if (!state.started) start(config, state);
    const bool credible = is_credible(config, tick);
    if (!credible) state.segment = {};
    const std::int8_t mode = tick.measured && credible ? tick.mode : std::int8_t{0};
    if (mode != state.mode) end_segment(config, state);
    state.mode = mode;
    if (++state.pending_ticks >= block_ticks) catch_time_up(config, state);
    if (mode == 0) return 0.0;
    take(state.segment, tick.angle_arcsec);
    return subtract(config, state);
}

double sigma_arcsec_s(const MagneticDriftState& state) noexcept {
    return square_root(state.covariance[of_drift][of_drift]);
}

double remaining_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept {
    const double drift = state.estimate[of_drift];
    const double sigma = sigma_arcsec_s(state);
    if (config.method == MagneticMethod::none || !state.started || !is_known(sigma, drift)) return 0.0;
    const double left = (1.0 - state.trust) * drift;
    const double wrong = state.trust * sigma;
    return square_root(left * left + wrong * wrong);
}

}  // namespace zlg::core
