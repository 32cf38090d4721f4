#include <zlg/core/compensation/magnetic_filter.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Q of (4), besides warming: Om is a random walk of 0.02 arcsec/s in an hour, and its trend v one that changes by 0.3
// arcsec/s in 3000 s over 3000 s. Set by hand and judged on the bases of docs/long_runs.md.
constexpr double drift_noise = 0.02 * 0.02 / 3600.0;
constexpr double trend_noise = (0.3 / 3000.0) * (0.3 / 3000.0) / 3000.0;

// The thermal time is presumed: during it the trend may change by a third of itself (a variance of 0.1).
constexpr double trend_noise_ratio = 0.1;

// Segments over which the scatter of the innovations is averaged. Set by hand and judged on the same bases.
constexpr std::int32_t scatter_memory = 12;

// Beyond this scatter a segment holds no information on a drift of some arcsec/s.
constexpr double max_scatter_arcsec_s = 300.0;

// Bounds the weight of a segment without noise, (arcsec/s)^2.
constexpr double least_noise = 1e-12;

// Variance of change and curvature over that of the mean, at most (segment_rate.hpp).
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

// h of (5), without the base: the rate of a segment in terms of the state at its end.
MagneticVector observation_without_base(const Segment& segment) noexcept {
    MagneticVector h{};
    h[of_drift] = segment.mode;
    h[of_trend] = -0.5 * segment.mode * segment.length_s;
    return h;
}

// The first segment: b = y - h^T x, with its covariances.
void initialise_base(MagneticFilterState& s, const Segment& segment) noexcept {
    const MagneticVector h = observation_without_base(segment);
    const MagneticVector ph = product(s.covariance, h);
    s.estimate[of_base] = segment.rate.mean_arcsec_s - product(h, s.estimate);
    for (unsigned i = of_drift; i < magnetic_parts; ++i) s.covariance[of_base][i] = s.covariance[i][of_base] = -ph[i];
    s.covariance[of_base][of_base] = segment.variance + product(h, ph);
    s.base_known = true;
}

void drop_base(MagneticFilterState& s) noexcept {
    s.base_known = false;
    s.estimate[of_base] = 0.0;
    for (unsigned i = 0; i < magnetic_parts; ++i) s.covariance[of_base][i] = s.covariance[i][of_base] = 0.0;
}

// Square of the motion of the base beyond the noise: from the last segment to this one (the innovation), or within this
// one (change and curvature of its rate). An oscillation in step with the switches looks like drift from segment to
// segment, but not within one.
double excess_sq(const MagneticFilterState& s, const Segment& segment, double innovation_sq,
                 double explained) noexcept {
    const double warming = segment.mode * s.estimate[of_trend] * segment.length_s;
    const double change = segment.rate.change_arcsec_s - warming;
    const double curvature = segment.rate.curvature_arcsec_s;
    const double trend_sq = s.covariance[of_trend][of_trend] * segment.length_s * segment.length_s;
    const double within = (change * change > curvature * curvature ? change * change : curvature * curvature) -
                          within_noise * segment.variance - trend_sq;
    const double between = innovation_sq - explained;
    const double larger = within > between ? within : between;
    return larger > 0.0 ? larger : 0.0;
}

// Running mean of the excess over the last segments.
void update_scatter(MagneticFilterState& s, double excess) noexcept {
    const bool settled = s.n_compared >= scatter_memory - 2;
    if (!settled) ++s.n_compared;
    // A single turn of the base is no scatter: only its own segment is discounted.
    const double most = settled ? min_of(5.0 * s.scatter_arcsec_s + 0.1, max_scatter_arcsec_s) : max_scatter_arcsec_s;
    s.scatter_arcsec_s += (min_of(excess, most) - s.scatter_arcsec_s) / static_cast<double>(s.n_compared + 2);
}

// The gain of (5) applied to estimate and covariance.
void correct(MagneticFilterState& s, const MagneticVector& ph, double innovation, double variance) noexcept {
    for (unsigned i = 0; i < magnetic_parts; ++i) s.estimate[i] += ph[i] / variance * innovation;
    for (unsigned i = 0; i < magnetic_parts; ++i)
        for (unsigned j = 0; j < magnetic_parts; ++j) s.covariance[i][j] -= ph[i] / variance * ph[j];
}

}  // namespace

void predict(MagneticFilterState& s, std::int8_t mode, double time_s, double thermal_time_s) noexcept {
    // F: v decays as exp(-t/tau); its integral over the time goes into Om, the integral of that into M. Short times by
    // series.
    const double elapsed_ratio = time_s / thermal_time_s;
    const double remaining = maths::exp(-elapsed_ratio);
    const bool brief = elapsed_ratio < 1e-3;
    const double integral_s =
        brief ? time_s * (1.0 - elapsed_ratio * (0.5 - elapsed_ratio / 6.0)) : thermal_time_s * (1.0 - remaining);
    const double double_integral_s2 = brief
                                          ? time_s * time_s * (0.5 - elapsed_ratio * (1.0 / 6.0 - elapsed_ratio / 24.0))
                                          : thermal_time_s * (time_s - integral_s);
    const double signed_time_s = static_cast<double>(mode) * time_s;
    MagneticCovariance f{};
    for (unsigned i = 0; i < magnetic_parts; ++i) f[i][i] = 1.0;
    f[of_drift][of_trend] = integral_s;
    f[of_trend][of_trend] = remaining;
    f[of_angle][of_drift] = signed_time_s;
    f[of_angle][of_trend] = static_cast<double>(mode) * double_integral_s2;

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

double wander_variance(double time_s, double thermal_time_s) noexcept {
    const double lasting_s = min_of(time_s, thermal_time_s);
    return (drift_noise + trend_noise * lasting_s * lasting_s / 3.0) * time_s;
}

void update(MagneticFilterState& s, const Segment& segment) noexcept {
    if (!s.base_known) return initialise_base(s, segment);
    MagneticVector h = observation_without_base(segment);
    h[of_base] = 1.0;
    const double innovation = segment.rate.mean_arcsec_s - product(h, s.estimate);
    const double explained = product(h, product(s.covariance, h)) + segment.variance;
    const double sq = excess_sq(s, segment, innovation * innovation, explained);
    update_scatter(s, square_root(sq));

    // The step of b: twice the mean square of the excesses, or that of this segment if larger. Overestimated on
    // purpose: the estimate then acts later than it could, but not on base motion.
    const double mean_sq = s.scatter_arcsec_s * s.scatter_arcsec_s;
    const double base = 2.0 * (sq > mean_sq ? sq : mean_sq);
    if (!(base < max_scatter_arcsec_s * max_scatter_arcsec_s)) return drop_base(s);
    s.covariance[of_base][of_base] += base;
    const double noise = segment.variance + 0.5 * base;
    note_segment(s.in_step, 1.0 / (noise + least_noise),
                 {segment.mode * 0.5 * innovation,
                  segment.mode * segment.rate.change_arcsec_s - s.estimate[of_trend] * segment.length_s,
                  segment.mode * segment.rate.curvature_arcsec_s});
    const MagneticVector ph = product(s.covariance, h);
    correct(s, ph, innovation, product(h, ph) + noise);
}

}  // namespace zlg::core
