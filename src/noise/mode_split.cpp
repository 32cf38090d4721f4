#include <zlg/noise/mode_split.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <zlg/deviations/series.hpp>

#include <zlg/numeric/minimum.hpp>

namespace zlg::noise {
namespace {

// The four constants of the warming and two degrees of freedom. The limits of A and tau are those of the calibration:
// near them both are skewed, and below them a straight growth explains the segments as well.
constexpr std::size_t min_segments = 6;
constexpr double min_bend_sigmas = 4.0;  // of A
constexpr double max_time_error = 0.2;   // of tau, relative

// Samples of one mode without a switch between them.
struct Stretch {
    std::size_t first, last;  // known ones
};

std::vector<Stretch> stretches_of(const ModeRecord& record) {
    std::vector<Stretch> all;
    for (std::size_t k = 0; k < record.rates_arcsec_s.size(); ++k) {
        if (!std::isfinite(record.rates_arcsec_s[k])) continue;
        if (all.empty() || record.mode[k] != record.mode[all.back().last])
            all.push_back({k, k});
        else
            all.back().last = k;
    }
    return all;
}

ModeSegment segment_of(const ModeRecord& record, const Stretch& s) {
    ModeSegment out{.mode = record.mode[s.first]};
    const double length = static_cast<double>(s.last - s.first + 1);
    double weights = 0.0, n = 0.0;
    for (std::size_t k = s.first; k <= s.last; ++k) {
        if (!std::isfinite(record.rates_arcsec_s[k])) continue;
        const double u = (static_cast<double>(k - s.first) + 0.5) / length;
        const double weight = u * u * (1.0 - u) * (1.0 - u);
        weights += weight;
        out.rate_arcsec_s += weight * (record.rates_arcsec_s[k] - out.rate_arcsec_s) / weights;
        n += 1.0;
    }
    out.time_s = (static_cast<double>(s.first) + 0.5 * length) / record.rate_hz;
    out.known_s = n / record.rate_hz;
    return out;
}

double warmed(double time_s, double tau_s) { return tau_s > 0.0 ? -std::expm1(-time_s / tau_s) : 0.0; }

// Weighted least squares over the segments; columns: 1, m, and further ones. The weight is the known time of a segment,
// as for white noise of the rate; the residuals set the scale of the covariance.
struct SegmentFit {
    Eigen::VectorXd coefficient;
    Eigen::MatrixXd covariance;
    double residual = 0.0;
};

SegmentFit fit_segments(const std::vector<ModeSegment>& segments, const Eigen::MatrixXd& laws) {
    const auto n = std::ssize(segments);
    Eigen::VectorXd y(n), root(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const ModeSegment& s = segments[static_cast<std::size_t>(k)];
        y[k] = s.rate_arcsec_s;
        root[k] = std::sqrt(s.known_s);
    }
    const Eigen::MatrixXd a = root.asDiagonal() * laws;
    const Eigen::MatrixXd inverse = (a.transpose() * a).ldlt().solve(Eigen::MatrixXd::Identity(a.cols(), a.cols()));
    SegmentFit fit{.coefficient = inverse * (a.transpose() * root.cwiseProduct(y)), .covariance = inverse};
    fit.residual = (root.cwiseProduct(y) - a * fit.coefficient).squaredNorm();
    fit.covariance *= fit.residual / static_cast<double>(n - a.cols());
    return fit;
}

Eigen::MatrixXd laws_of(const std::vector<ModeSegment>& segments, double tau_s, double a_for_tau) {
    const Eigen::Index n_laws = tau_s > 0.0 ? (a_for_tau != 0.0 ? 4 : 3) : 2;
    Eigen::MatrixXd m(std::ssize(segments), n_laws);
    for (Eigen::Index k = 0; k < m.rows(); ++k) {
        const ModeSegment& s = segments[static_cast<std::size_t>(k)];
        m(k, 0) = 1.0;
        m(k, 1) = s.mode;
        if (n_laws > 2) m(k, 2) = s.mode * warmed(s.time_s, tau_s);
        if (n_laws > 3) m(k, 3) = -s.mode * a_for_tau * s.time_s / (tau_s * tau_s) * std::exp(-s.time_s / tau_s);
    }
    return m;
}

double sigma(const SegmentFit& fit, Eigen::Index k) { return std::sqrt(fit.covariance(k, k)); }

void refuse(const std::string& why, ModeSplit& split) {
    split.nonmagnetic_arcsec_s = split.magnetic_arcsec_s = numeric::refused(why);
    split.magnetic_thermal_arcsec_s = split.thermal_time_s = numeric::refused(why);
}

void take_constant(ModeSplit& split) {
    const SegmentFit flat = fit_segments(split.segments, laws_of(split.segments, 0.0, 0.0));
    const auto dof = static_cast<double>(split.segments.size()) - 2.0;
    split.nonmagnetic_arcsec_s = numeric::estimated(flat.coefficient[0], numeric::widened(sigma(flat, 0), dof));
    split.magnetic_arcsec_s = numeric::estimated(flat.coefficient[1], numeric::widened(sigma(flat, 1), dof));
    split.fitted_magnetic = flat.coefficient[1];
    const std::string why = "the magnetic drift does not bend by more than its error";
    split.magnetic_thermal_arcsec_s = split.thermal_time_s = numeric::refused(why);
}

// Separable least squares: for each tau the other three constants follow linearly, so that the residual is searched
// along log tau alone, from 1/30 of the record, a bend at its very beginning, to 10 times it, where the growth is
// straight. The column of the derivative by tau then gives the covariance of all four.
void take_warming(ModeSplit& split) {
    const auto& s = split.segments;
    const double span_s = s.back().time_s;
    const auto residual = [&s](double log_tau) { return fit_segments(s, laws_of(s, std::exp(log_tau), 0.0)).residual; };
    const double tau_s =
        std::exp(numeric::scanned_minimum(residual, std::log(span_s / 30.0), std::log(span_s * 10.0), 40).at);
    const SegmentFit grown = fit_segments(s, laws_of(s, tau_s, 0.0));
    const double a = grown.coefficient[2];
    if (a == 0.0) return;
    // To be taken out a growth need not bend: it is better than none where less is left for each degree of freedom.
    // Its time was found too, and leaves one degree of freedom less than the three laws do.
    const double dof = static_cast<double>(s.size()) - 4.0;
    if (grown.residual / dof < fit_segments(s, laws_of(s, 0.0, 0.0)).residual / (dof + 2.0)) {
        split.fitted_magnetic = grown.coefficient[1];
        split.fitted_thermal = a;
        split.fitted_time_s = tau_s;
        const double error = numeric::widened(sigma(grown, 0) * std::sqrt((dof + 1.0) / dof), dof);
        if (std::isfinite(error)) split.nonmagnetic_arcsec_s = numeric::estimated(grown.coefficient[0], error);
    }
    const SegmentFit fit = fit_segments(s, laws_of(s, tau_s, a));
    if (!(std::abs(a) > min_bend_sigmas * sigma(fit, 2)) || !(sigma(fit, 3) < max_time_error * tau_s)) return;
    split.nonmagnetic_arcsec_s = numeric::estimated(fit.coefficient[0], numeric::widened(sigma(fit, 0), dof));
    split.magnetic_arcsec_s = numeric::estimated(fit.coefficient[1], numeric::widened(sigma(fit, 1), dof));
    split.magnetic_thermal_arcsec_s = numeric::estimated(fit.coefficient[2], numeric::widened(sigma(fit, 2), dof));
    split.thermal_time_s = numeric::estimated(tau_s, numeric::widened(sigma(fit, 3), dof));
}

std::vector<ModePoint> points_of(const std::vector<ModeSegment>& s) {
    std::vector<ModePoint> points;
    for (std::size_t k = 1; k + 1 < s.size(); ++k) {
        const double before = s[k - 1].rate_arcsec_s, here = s[k].rate_arcsec_s, after = s[k + 1].rate_arcsec_s;
        points.push_back({.time_s = s[k].time_s,
                          .magnetic_arcsec_s = 0.25 * s[k].mode * (2.0 * here - before - after),
                          .nonmagnetic_arcsec_s = 0.25 * (before + 2.0 * here + after)});
    }
    return points;
}

// Between two stretches: what was bridged, and the settling after it.
SwitchAngle switch_angle(const ModeRecord& record, const Stretch& before, const Stretch& after, double rate_before,
                         double rate_after, std::int64_t settling) {
    SwitchAngle s{.time_s = static_cast<double>(before.last + 1) / record.rate_hz,
                  .mode_after = record.mode[after.first]};
    const std::size_t end = std::min(after.last, after.first + static_cast<std::size_t>(settling)) + 1;
    for (std::size_t k = before.last + 1; k < end; ++k) {
        const double expected = record.mode[k] == s.mode_after ? rate_after : rate_before;
        if (std::isfinite(record.bridged_arcsec_s[k]))
            s.error_arcsec += (record.bridged_arcsec_s[k] - expected) / record.rate_hz;
    }
    return s;
}

SwitchStatistics statistics_of(const std::vector<SwitchAngle>& switches) {
    SwitchStatistics s;
    double squares = 0.0;
    for (const SwitchAngle& one : switches) {
        ++s.n;
        s.mean_arcsec += one.error_arcsec;
        s.mean_by_mode_arcsec += one.mode_after * one.error_arcsec;
        squares += one.error_arcsec * one.error_arcsec;
        s.max_arcsec = std::max(s.max_arcsec, std::abs(one.error_arcsec));
    }
    if (s.n == 0) return s;
    const auto n = static_cast<double>(s.n);
    s.mean_arcsec /= n;
    s.mean_by_mode_arcsec /= n;
    s.rms_arcsec = std::sqrt(squares / n);
    if (s.n > 1)
        s.mean_sigma_arcsec = std::sqrt(std::max(0.0, squares / n - s.mean_arcsec * s.mean_arcsec) / (n - 1.0));
    return s;
}

}  // namespace

double ModeSplit::magnetic_at(double time_s) const {
    return fitted_magnetic + fitted_thermal * warmed(time_s, fitted_time_s);
}

ModeSplit split_modes(const ModeRecord& record, std::int64_t settling) {
    const std::size_t n = record.rates_arcsec_s.size();
    if (record.mode.size() != n || (!record.bridged_arcsec_s.empty() && record.bridged_arcsec_s.size() != n))
        throw deviations::SeriesError(
            fmt::format("modes: {} rates, {} modes and {} bridged rates, allowed are as many of each", n,
                        record.mode.size(), record.bridged_arcsec_s.size()));
    ModeSplit split;
    const auto stretches = stretches_of(record);
    for (const Stretch& s : stretches) split.segments.push_back(segment_of(record, s));
    split.points = points_of(split.segments);
    if (!record.bridged_arcsec_s.empty())
        for (std::size_t k = 0; k + 1 < stretches.size(); ++k)
            split.switches.push_back(switch_angle(record, stretches[k], stretches[k + 1],
                                                  split.segments[k].rate_arcsec_s, split.segments[k + 1].rate_arcsec_s,
                                                  settling));
    split.statistics = statistics_of(split.switches);
    if (split.segments.size() < min_segments) {
        refuse(fmt::format("{} segments between switches; {} or more are needed", split.segments.size(), min_segments),
               split);
        return split;
    }
    take_constant(split);
    take_warming(split);
    return split;
}

void take_out_magnetic(const ModeSplit& split, std::span<const std::int8_t> mode, double rate_hz,
                       std::span<double> rates) {
    for (std::size_t k = 0; k < rates.size(); ++k)
        rates[k] -= mode[k] * split.magnetic_at((static_cast<double>(k) + 0.5) / rate_hz);
}

}  // namespace zlg::noise
