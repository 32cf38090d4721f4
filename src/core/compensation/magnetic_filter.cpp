#include "magnetic_filter.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// What the drift does besides warming: it wanders by 0.02 arcsec/s in an hour, and its trend by as much as changes it by
// 0.3 arcsec/s in the time of 3000 s.
constexpr double drift_noise = 0.02 * 0.02 / 3600.0;
constexpr double trend_noise = (0.3 / 3000.0) * (0.3 / 3000.0) / 3000.0;

// Nor is the thermal time the presumed one: meanwhile the trend may change by a third of itself.
constexpr double trend_noise_ratio = 0.1;

// Segments over which the scatter is averaged.
constexpr std::int32_t scatter_memory = 12;

// Beyond this scatter a segment says nothing of the drift.
constexpr double max_scatter_arcsec_s = 300.0;

// Variance of change and bend over that of the mean.
constexpr double within_noise = 21.0;

double min_of(double a, double b) noexcept { return a < b ? a : b; }

MagneticVector product(const MagneticCovariance& p, const MagneticVector& h) noexcept {
    MagneticVector result{};
    for (unsigned i = 0; i < magnetic_parts; ++i)
        for (unsigned j = 0; j < magnetic_parts; ++j) result[i] += p[i][j] * h[j];
    return result;
}

double product(const MagneticVector& a, const MagneticVector& b) noexcept {
    double result = 0.0;
    for (unsigned i = 0; i < magnetic_parts; ++i) result += a[i] * b[i];
    return result;
}

// The rate of a segment in terms of the state at its end, without the base.
MagneticVector seen_part(const Segment& segment) noexcept {
    MagneticVector h{};
    h[of_drift] = segment.mode;
    h[of_trend] = -0.5 * segment.mode * segment.length_s;
    return h;
}

void meet_base(MagneticDriftState& s, const Segment& segment) noexcept {
    const MagneticVector h = seen_part(segment);
    const MagneticVector ph = product(s.covariance, h);
    s.estimate[of_base] = segment.rate.mean_arcsec_s - product(h, s.estimate);
    for (unsigned i = of_drift; i < magnetic_parts; ++i) s.covariance[of_base][i] = s.covariance[i][of_base] = -ph[i];
    s.covariance[of_base][of_base] = segment.variance + product(h, ph);
    s.base_known = true;
}

void forget_base(MagneticDriftState& s) noexcept {
    s.base_known = false;
    s.estimate[of_base] = 0.0;
    for (unsigned i = 0; i < magnetic_parts; ++i) s.covariance[of_base][i] = s.covariance[i][of_base] = 0.0;
}

// How far the base moved, squared, beyond what noise explains: since the last segment, or within this one. A sway in step
// with the switches looks like drift from segment to segment, but not within one.
double excess_sq(const MagneticDriftState& s, const Segment& segment, double innovation_sq, double explained) noexcept {
    const double warming = segment.mode * s.estimate[of_trend] * segment.length_s;
    const double change = segment.rate.change_arcsec_s - warming;
    const double bend = segment.rate.bend_arcsec_s;
    const double trend_sq = s.covariance[of_trend][of_trend] * segment.length_s * segment.length_s;
    const double within =
        (change * change > bend * bend ? change * change : bend * bend) - within_noise * segment.variance - trend_sq;
    const double between = innovation_sq - explained;
    const double larger = within > between ? within : between;
    return larger > 0.0 ? larger : 0.0;
}

void follow_scatter(MagneticDriftState& s, double excess) noexcept {
    const bool settled = s.n_compared >= scatter_memory - 2;
    if (!settled) ++s.n_compared;
    // One turn is no scatter: its own segment is enough to meet it.
    const double most = settled ? min_of(5.0 * s.scatter_arcsec_s + 0.1, max_scatter_arcsec_s) : max_scatter_arcsec_s;
    s.scatter_arcsec_s += (min_of(excess, most) - s.scatter_arcsec_s) / static_cast<double>(s.n_compared + 2);
}

void correct(MagneticDriftState& s, const MagneticVector& ph, double innovation, double variance) noexcept {
    for (unsigned i = 0; i < magnetic_parts; ++i) s.estimate[i] += ph[i] / variance * innovation;
    for (unsigned i = 0; i < magnetic_parts; ++i)
        for (unsigned j = 0; j < magnetic_parts; ++j) s.covariance[i][j] -= ph[i] / variance * ph[j];
}

}  // namespace

void predict(MagneticDriftState& s, double time_s, double thermal_time_s) noexcept {
    // v fades as exp(-t/tau): its integral over the time, and the integral of that.
    const double faded = time_s / thermal_time_s;
    const double remaining = exponential(-faded);
    const bool brief = faded < 1e-3;
    const double grown_s = brief ? time_s * (1.0 - faded * (0.5 - faded / 6.0)) : thermal_time_s * (1.0 - remaining);
    const double turned_s2 =
        brief ? time_s * time_s * (0.5 - faded * (1.0 / 6.0 - faded / 24.0)) : thermal_time_s * (time_s - grown_s);
    const double turned = static_cast<double>(s.mode) * time_s;
    MagneticCovariance f{};
    for (unsigned i = 0; i < magnetic_parts; ++i) f[i][i] = 1.0;
    f[of_drift][of_trend] = grown_s;
    f[of_trend][of_trend] = remaining;
    f[of_angle][of_drift] = turned;
    f[of_angle][of_trend] = static_cast<double>(s.mode) * turned_s2;

    s.estimate = product(f, s.estimate);
    MagneticCovariance fp{};
    for (unsigned j = 0; j < magnetic_parts; ++j) fp[j] = product(f, s.covariance[j]);
    for (unsigned i = 0; i < magnetic_parts; ++i)
        for (unsigned j = 0; j <= i; ++j) {
            MagneticVector column{};
            for (unsigned k = 0; k < magnetic_parts; ++k) column[k] = fp[k][i];
            s.covariance[i][j] = s.covariance[j][i] = product(f[j], column);
        }
    s.covariance[of_drift][of_drift] += drift_noise * time_s;
    const double trend = s.estimate[of_trend];
    s.covariance[of_trend][of_trend] += (trend_noise + trend_noise_ratio * trend * trend / thermal_time_s) * time_s;
}

void update(MagneticDriftState& s, const Segment& segment) noexcept {
    if (!s.base_known) return meet_base(s, segment);
    MagneticVector h = seen_part(segment);
    h[of_base] = 1.0;
    const double innovation = segment.rate.mean_arcsec_s - product(h, s.estimate);
    const double explained = product(h, product(s.covariance, h)) + segment.variance;
    const double sq = excess_sq(s, segment, innovation * innovation, explained);
    follow_scatter(s, square_root(sq));

    // Twice a square that is a mean of excesses only, and never less than of this segment: rather more than the variance.
    const double mean_sq = s.scatter_arcsec_s * s.scatter_arcsec_s;
    const double base = 2.0 * (sq > mean_sq ? sq : mean_sq);
    if (!(base < max_scatter_arcsec_s * max_scatter_arcsec_s)) return forget_base(s);
    s.covariance[of_base][of_base] += base;
    const double noise = segment.variance + 0.5 * base;
    const MagneticVector ph = product(s.covariance, h);
    correct(s, ph, innovation, product(h, ph) + noise);
}

}  // namespace zlg::core
