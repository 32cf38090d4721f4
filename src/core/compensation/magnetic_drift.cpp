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

// Q of the filter: Om is a random walk of 0.02 arcsec/s in an hour, and its trend v one that changes by 0.3 arcsec/s in
// 3000 s over 3000 s. Set by hand and judged on the bases of docs/drift.md.
constexpr double drift_noise = 0.02 * 0.02 / 3600.0;
constexpr double trend_noise = (0.3 / 3000.0) * (0.3 / 3000.0) / 3000.0;

// Segments over which the scatter of the base is averaged.
constexpr double scatter_memory = 12.0;

// Beyond this motion a segment holds no information on a drift of some arcsec/s.
constexpr double max_motion_arcsec_s = 300.0;

// Variance of the curvature over that of the mean, for a walk.
constexpr double curvature_noise = 21.0;

// Of (3).
constexpr double fading = 1.0 - 1.0 / 32.0;
constexpr double gate_sq = 16.0;
constexpr double shape_sq = 16.0;

// Of (4). docs/drift.md has the bases on which they were judged.
constexpr double known_sq = 16.0;
constexpr double near_sq = 4.0;
constexpr double far_sq = 9.0;

// Growth of the variance of what was presumed, (arcsec/s)^2 a second: by Q 0.2 arcsec/s in an hour.
constexpr double wander = 1e-5;

// h^T x of the states; M is not observed.
template <class Vector> double product(const MagneticVector& h, const Vector& x) noexcept {
    return h[of_base] * x[of_base] + h[of_drift] * x[of_drift] + h[of_trend] * x[of_trend];
}

void start(const MagneticDriftConfig& c, MagneticDriftState& s) noexcept {
    const double tau_s = c.thermal_time.value();
    s.started = true;
    s.estimate = {0.0, c.presumed_arcsec_s, c.warming_arcsec_s / tau_s, 0.0};
    s.covariance[of_drift][of_drift] = square(c.presumed_sigma_arcsec_s);
    s.covariance[of_trend][of_trend] = square(c.warming_sigma_arcsec_s / tau_s);
}

// Up to the present tick. The trend fades, its integral goes into Om, the integral of that into M.
void predict(const MagneticDriftConfig& c, MagneticDriftState& s, double tick_s) noexcept {
    const double time_s = s.pending_ticks * tick_s, tau_s = c.thermal_time.value();
    const double lost = -maths::expm1(-time_s / tau_s), gained_s = tau_s * lost;
    const double signed_s = s.mode * time_s, gained_s2 = s.mode * tau_s * (time_s - gained_s);
    auto& x = s.estimate;
    auto& p = s.covariance;
    x[of_angle] += signed_s * x[of_drift] + gained_s2 * x[of_trend];
    x[of_drift] += gained_s * x[of_trend];
    x[of_trend] -= lost * x[of_trend];
    for (unsigned i = 0; i < magnetic_states; ++i) {
        p[of_angle][i] += signed_s * p[of_drift][i] + gained_s2 * p[of_trend][i];
        p[of_drift][i] += gained_s * p[of_trend][i];
        p[of_trend][i] -= lost * p[of_trend][i];
    }
    for (MagneticVector& row : p) {
        row[of_drift] += gained_s * row[of_trend];
        row[of_trend] -= lost * row[of_trend];
    }
    p[of_drift][of_drift] += drift_noise * time_s;
    p[of_trend][of_trend] += trend_noise * time_s;
    s.age_s += time_s;
    s.pending_ticks = 0;
}

// With the segment that has just ended.
void update(const CompensationConstants& gyro, MagneticDriftState& s) noexcept {
    const double tick_s = gyro.tick.value(), m = s.mode;
    const SegmentRate rate = rate_of(s.segment, tick_s);
    const double noise = mean_rate_variance(s.segment, tick_s, gyro.random_walk.value(), gyro.scale.value());
    const double length_s = static_cast<double>(s.segment.n_ticks) * tick_s;
    const MagneticVector h{s.base_known ? 1.0 : 0.0, m, -0.5 * m * length_s};
    std::array<double, magnetic_parts> ph{};
    for (unsigned i = 0; i < magnetic_parts; ++i) ph[i] = product(h, s.covariance[i]);
    const double innovation = rate.mean_arcsec_s - product(h, s.estimate);
    const double explained = product(h, ph) + noise;
    if (!s.base_known) {
        s.base_known = true;
        s.estimate[of_base] = innovation;
        for (unsigned i = of_drift; i < magnetic_parts; ++i) s.covariance[i][of_base] = -ph[i];
        for (unsigned i = of_drift; i < magnetic_states; ++i) s.covariance[of_base][i] = -ph[i];
        s.covariance[of_base][of_base] = explained;
        return;
    }
    const double between = square(innovation) - explained;
    const double within = square(rate.curvature_arcsec_s) - curvature_noise * noise;
    const double motion_sq = larger(larger(between, within), 0.0), motion = square_root(motion_sq);
    s.base_known = motion < max_motion_arcsec_s;
    if (!s.base_known) return;
    // A single turn of the base is no scatter: only its own segment is discounted.
    const double most = 5.0 * s.scatter_arcsec_s + 0.1;
    if (s.n_compared < scatter_memory) s.n_compared += 1.0;
    s.scatter_arcsec_s += ((motion < most ? motion : most) - s.scatter_arcsec_s) / s.n_compared;
    const double base = 2.0 * larger(motion_sq, square(s.scatter_arcsec_s));
    // What the segment says by its innovation and by its shape on motion in step.
    const std::array<double, 2> c{0.5 * m * innovation, m * rate.curvature_arcsec_s};
    const double weight = 1.0 / noise;
    s.weight = fading * s.weight + weight;
    for (unsigned i = 0; i < c.size(); ++i) {
        s.sum[i] = fading * s.sum[i] + weight * c[i];
        s.square_sum[i] = square(fading) * s.square_sum[i] + square(weight * c[i]);
    }
    s.covariance[of_base][of_base] += base;
    ph[of_base] += base;
    for (unsigned i = 0; i < magnetic_parts; ++i) {
        const double gain = ph[i] / (explained + base);
        s.estimate[i] += gain * innovation;
        for (unsigned j = 0; j < magnetic_states; ++j) s.covariance[i][j] -= gain * ph[j];
    }
}

// 0 where the drift is what was presumed, 1 and more where it is not.
double contradiction(const MagneticDriftConfig& c, const MagneticDriftState& s) noexcept {
    const double warmed = -maths::expm1(-s.age_s / c.thermal_time.value());
    const double distance = s.estimate[of_drift] - c.presumed_arcsec_s - c.warming_arcsec_s * warmed;
    const double variance =
        square(c.presumed_sigma_arcsec_s) + square(c.warming_sigma_arcsec_s * warmed) + wander * s.age_s;
    const double beyond = square(distance) - near_sq * variance;
    return beyond > 0.0 ? beyond / ((far_sq - near_sq) * variance) : 0.0;
}

// A prediction, and how far it is trusted.
void renew(const MagneticDriftConfig& config, MagneticDriftState& state, double tick_s) noexcept {
    predict(config, state, tick_s);
    const double unknown = known_sq * drift_variance(state) / square(state.estimate[of_drift]);
    const double trust = 1.0 - unknown - contradiction(config, state);
    state.trust = trust > 0.0 ? trust : 0.0;
}

// What is subtracted in so many ticks between two predictions: their drift, and of what is due above that of one tick
// such a part.
double subtract(MagneticDriftState& s, double tick_s, std::int32_t ticks, double part) noexcept {
    const double rate = s.mode * s.estimate[of_drift], now = s.trust * tick_s * rate;
    const double angle = s.estimate[of_angle] + s.pending_ticks * tick_s * rate;
    const double due = ticks * now + part * (s.trust * angle - now - s.subtracted_arcsec);
    s.subtracted_arcsec += due;
    return due;
}

}  // namespace

bool is_allowed(const MagneticDriftConfig& c) noexcept {
    const auto is_known = [](double drift, double sigma) { return size(drift) <= 1e6 && is_within(sigma, 0.0, 1e6); };
    return is_known(c.presumed_arcsec_s, c.presumed_sigma_arcsec_s) &&
           is_known(c.warming_arcsec_s, c.warming_sigma_arcsec_s) && is_within(c.thermal_time.value(), 1e-9, 1e12);
}

double step(const CompensationConstants& gyro, const MagneticDriftConfig& config, MagneticDriftState& state,
            const MagneticTick& tick) noexcept {
    if (!state.started) start(config, state);
    const double tick_s = gyro.tick.value();
    const bool credible = size(tick.angle_arcsec) <= fastest_arcsec_s * tick_s;
    if (!credible) state.segment = {};
    const std::int8_t mode = tick.measured && credible ? tick.mode : std::int8_t{0};
    const bool ends = mode != state.mode;
    if (ends) {
        predict(config, state, tick_s);
        if (state.segment.n_ticks >= min_ticks) update(gyro, state);
        state.segment = {};
        state.mode = mode;
    }
    if (++state.pending_ticks >= block_ticks || ends) renew(config, state, tick_s);
    if (mode == 0) return 0.0;
    accumulate(state.segment, tick.angle_arcsec);
    return config.method == MagneticMethod::estimate ? subtract(state, tick_s, 1, past_correction_gain) : 0.0;
}

double leap(const CompensationConstants& gyro, const MagneticDriftConfig& config, MagneticDriftState& state,
            std::int64_t ticks, double angle_arcsec) noexcept {
    const double tick_s = gyro.tick.value();
    double subtracted = 0.0;
    // As `step`, a tick that completes a block is subtracted by what is renewed in it.
    for (std::int64_t left = ticks; left > 0;) {
        if (++state.pending_ticks >= block_ticks) renew(config, state, tick_s);
        const std::int64_t to_block = block_ticks - state.pending_ticks;
        const auto part = static_cast<std::int32_t>(left < to_block ? left : to_block);
        // What is due falls by the gain from tick to tick.
        const double gained = -maths::expm1(part * maths::log(1.0 - past_correction_gain));
        if (config.method == MagneticMethod::estimate) subtracted += subtract(state, tick_s, part, gained);
        state.pending_ticks += part - 1;
        left -= part;
    }
    accumulate(state.segment, angle_arcsec, ticks);
    return subtracted;
}

double drift_variance(const MagneticDriftState& s) noexcept {
    double seen = 0.0;
    for (unsigned i = 0; i < s.sum.size(); ++i) seen += larger(square(s.sum[i]) - gate_sq * s.square_sum[i], 0.0);
    return s.covariance[of_drift][of_drift] + (seen > 0.0 ? shape_sq * seen / square(s.weight) : 0.0);
}

double remaining_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept {
    if (config.method == MagneticMethod::none || state.trust == 0.0) return 0.0;
    const double taken = taken_out(config, state);
    return square_root(square((1.0 - taken) * state.estimate[of_drift]) + square(taken) * drift_variance(state));
}

}  // namespace zlg::core
