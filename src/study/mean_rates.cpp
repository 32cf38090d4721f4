#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include <zlg/study/analyze.hpp>

namespace zlg::study {
namespace {

const noise::NoiseFit& describing_fit(const AxisResult& axis) {
    if (!axis.fit)
        throw deviations::SeriesError(fmt::format("imu.yaml: {}: no terms are fitted: {}", axis.name, axis.no_fit));
    if (!axis.fit->describes)
        throw deviations::SeriesError(
            fmt::format("imu.yaml: {}: the fitted terms do not describe it; it was moved, or has noise of another kind",
                        axis.name));
    return *axis.fit;
}

// 0: none.
double walk_limit(const noise::NoiseFit& fit) {
    for (const noise::FittedTerm& term : fit.fitted)
        if (term.kind == noise::NoiseKind::rate_random_walk && std::isfinite(term.limit)) return term.limit;
    return 0.0;
}

}  // namespace

std::vector<EarthLine> earth_lines(const std::vector<AxisResult>& axes) {
    std::map<std::string, EarthLine> groups;
    std::map<std::string, double> variance;
    for (const AxisResult& axis : axes) {
        if (axis.is_error) continue;
        EarthLine& line = groups[axis.group];
        line.group = axis.group;
        ++line.n_axes;
        line.norm_arcsec_s = std::hypot(line.norm_arcsec_s, axis.mean_arcsec_s);
        variance[axis.group] += std::pow(axis.mean_arcsec_s * axis.mean_sigma_arcsec_s, 2);
    }
    std::vector<EarthLine> lines;
    for (auto& [group, line] : groups) {
        if (line.n_axes != 3) continue;
        if (line.norm_arcsec_s > 0.0) line.sigma_arcsec_s = std::sqrt(variance[group]) / line.norm_arcsec_s;
        lines.push_back(line);
    }
    return lines;
}

noise::KalibrGyro kalibr_gyro(const std::vector<AxisResult>& axes) {
    noise::NoiseTerms most;
    double rate_hz = 0.0, limit = 0.0;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        if (k + 1 < axes.size() && axes[k + 1].is_error) continue;
        const noise::NoiseFit& fit = describing_fit(axes[k]);
        most.angle_random_walk_arcsec_sqrt_s =
            std::max(most.angle_random_walk_arcsec_sqrt_s, fit.terms.angle_random_walk_arcsec_sqrt_s);
        most.rate_random_walk_arcsec_s_sqrt_s =
            std::max(most.rate_random_walk_arcsec_s_sqrt_s, fit.terms.rate_random_walk_arcsec_s_sqrt_s);
        limit = std::max(limit, walk_limit(fit));
        rate_hz = axes[k].rate_hz;
    }
    if (most.angle_random_walk_arcsec_sqrt_s == 0.0)
        throw deviations::SeriesError(
            "imu.yaml: no angle random walk was found; Kalibr's model has nothing else to rest on");
    const bool is_limit = most.rate_random_walk_arcsec_s_sqrt_s == 0.0;
    if (is_limit) most.rate_random_walk_arcsec_s_sqrt_s = limit;
    if (most.rate_random_walk_arcsec_s_sqrt_s == 0.0)
        throw deviations::SeriesError(
            "imu.yaml: neither rate random walk was found nor a limit of it; Kalibr refuses 0");
    noise::KalibrGyro gyro = noise::kalibr_gyro(most, rate_hz);
    gyro.random_walk_is_limit = is_limit;
    return gyro;
}

double shown_rate(config::ShownRate unit, double arcsec_s) {
    switch (unit) {
        case config::ShownRate::deg_s: return arcsec_s / 3600.0;
        case config::ShownRate::rad_s: return arcsec_s * std::numbers::pi / 648000.0;
        case config::ShownRate::deg_h:
        case config::ShownRate::arcsec_s: break;
    }
    return arcsec_s;
}

std::string shown_unit(config::ShownRate unit) {
    constexpr std::array names{"deg/h", "arcsec/s", "deg/s", "rad/s"};
    return names[static_cast<std::size_t>(unit)];
}

}  // namespace zlg::study
