#include <zlg/noise/noise_units.hpp>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <zlg/deviations/series.hpp>

namespace zlg::noise {
namespace {

constexpr double arcsec_in_rad = std::numbers::pi / 648000.0;
// 1 h = 3600 s: sqrt(3600) = 60.
constexpr double root_of_hour = 60.0;
constexpr double hour_s = 3600.0;

}  // namespace

DataSheet data_sheet(const NoiseTerms& terms) {
    return {.quantisation_arcsec = terms.quantisation_arcsec,
            .angle_random_walk_deg_sqrt_h = terms.angle_random_walk_arcsec_sqrt_s * root_of_hour / hour_s,
            .bias_instability_deg_h = terms.bias_instability_arcsec_s,
            .rate_random_walk_deg_h_sqrt_h = terms.rate_random_walk_arcsec_s_sqrt_s * root_of_hour,
            .ramp_deg_h_h = terms.ramp_arcsec_s2 * hour_s};
}

NoiseTerms terms_of(const DataSheet& sheet) {
    return {.quantisation_arcsec = sheet.quantisation_arcsec,
            .angle_random_walk_arcsec_sqrt_s = sheet.angle_random_walk_deg_sqrt_h * hour_s / root_of_hour,
            .bias_instability_arcsec_s = sheet.bias_instability_deg_h,
            .rate_random_walk_arcsec_s_sqrt_s = sheet.rate_random_walk_deg_h_sqrt_h / root_of_hour,
            .ramp_arcsec_s2 = sheet.ramp_deg_h_h / hour_s,
            .markov = {},
            .sines = {}};
}

DiscreteNoise discrete_noise(const NoiseTerms& terms, double rate_hz) {
    if (!(rate_hz > 0.0) || !std::isfinite(rate_hz))
        throw deviations::SeriesError(fmt::format("discrete noise: rate {} Hz, allowed is a positive number", rate_hz));
    const double root = std::sqrt(rate_hz);
    DiscreteNoise d{.white_rate_arcsec_s = terms.angle_random_walk_arcsec_sqrt_s * root,
                    .white_increment_arcsec = terms.angle_random_walk_arcsec_sqrt_s / root,
                    .walk_step_arcsec_s = terms.rate_random_walk_arcsec_s_sqrt_s / root,
                    .angle_error_arcsec = terms.quantisation_arcsec,
                    .ramp_step_arcsec_s = terms.ramp_arcsec_s2 / rate_hz,
                    .markov_factor = {},
                    .markov_step_arcsec_s = {}};
    for (const MarkovNoise& m : terms.markov) {
        const double x = 1.0 / (rate_hz * m.time_s);
        d.markov_factor.push_back(std::exp(-x));
        d.markov_step_arcsec_s.push_back(m.deviation_arcsec_s * std::sqrt(-std::expm1(-2.0 * x)));
    }
    return d;
}

KalibrGyro kalibr_gyro(const NoiseTerms& terms, double rate_hz) {
    return {.noise_density_rad_s_sqrt_hz = terms.angle_random_walk_arcsec_sqrt_s * arcsec_in_rad,
            .random_walk_rad_s2_sqrt_hz = terms.rate_random_walk_arcsec_s_sqrt_s * arcsec_in_rad,
            .update_rate_hz = rate_hz};
}

}  // namespace zlg::noise
