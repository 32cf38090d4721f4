#include <zlg/rig/laser_calibration.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/discriminator_curve.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/discriminator_curve.hpp>
#include <zlg/twin/four_wave.hpp>

namespace zlg::rig {
namespace {

// Nodes up to the detuning at which a third wave bends the curve, and beyond, closest at the bend on both sides; 31 in
// all is what the core holds.
constexpr int n_before_kink = 20;
constexpr int n_beyond_kink = 11;

std::vector<double> nodes(double kink_lambda, double most_lambda) {
    const double first = std::min(kink_lambda, most_lambda);
    std::vector<double> at;
    for (int k = 1; k <= n_before_kink; ++k) at.push_back(first * std::sin(0.5 * std::numbers::pi * k / n_before_kink));
    if (!(most_lambda > first)) return at;
    for (int k = 1; k <= n_beyond_kink; ++k) {
        at.push_back(first + (most_lambda - first) * k * k / (n_beyond_kink * n_beyond_kink));
    }
    return at;
}

// The discriminator about the place where the loop settles, which unequal isotopes move away from the middle.
struct Discriminator {
    const twin::FourWave& laser;
    double field_g;
    double settled_lambda;

    [[nodiscard]] double signal(double dl) const { return laser.at(settled_lambda + dl, field_g).discriminator(); }
    // What an odd curve makes of both sides.
    [[nodiscard]] double odd_signal(double dl) const { return 0.5 * (signal(dl) - signal(-dl)); }
};

// Largest error of the curve between two detunings, on both sides.
double curve_error_lambda(const config::Config& config, const Discriminator& discriminator, double from_lambda,
                          double to_lambda) {
    constexpr int n_probes = 150;
    const double slope = config.gyro.discriminator_per_lambda;
    const core::DiscriminatorCurve curve = discriminator_curve(config, slope);
    double worst_lambda = 0.0;
    for (int k = 0; k < n_probes; ++k) {
        const double size = from_lambda + (to_lambda - from_lambda) * (k + 0.5) / n_probes;
        for (const double dl : {size, -size}) {
            const double apparent = discriminator.signal(dl) / slope;
            worst_lambda = std::max(worst_lambda, std::abs(core::true_detuning(curve, apparent).detuning_lambda - dl));
        }
    }
    return worst_lambda;
}

LaserCalibration calibrate(const config::Config& config) {
    LaserCalibration made{.config = config};
    const twin::TwinConfig gyro = twin_config(config);
    const twin::FourWave laser{gyro.laser};
    const double field_g = gyro.laser.bias_field_g;
    const twin::AveragedLaser averaged = twin::averaged_laser(laser, field_g);
    const twin::TwinConfig told = twin::with_laser(gyro, averaged);
    made.config.gyro.bias_hz = told.bias_hz;
    made.config.gyro.bias_chi = told.bias_chi;
    made.config.gyro.discriminator_per_lambda = told.discriminator_per_lambda;

    const Discriminator discriminator{laser, field_g, averaged.settled_lambda};
    const twin::DiscriminatorCurve inverse = twin::discriminator_curve(laser, field_g);
    const double most_lambda = std::min(inverse.max_detuning_lambda() - averaged.settled_lambda,
                                        averaged.settled_lambda - inverse.min_detuning_lambda());
    const double kink_lambda = averaged.third_wave_lambda - std::abs(averaged.settled_lambda);
    config::Perimeter& perimeter = made.config.perimeter;
    perimeter.discriminator_detuning_lambda = nodes(kink_lambda, most_lambda);
    perimeter.discriminator_signal.clear();
    for (const double dl : perimeter.discriminator_detuning_lambda)
        perimeter.discriminator_signal.push_back(discriminator.odd_signal(dl));

    made.third_wave_lambda = std::min(kink_lambda, most_lambda);
    made.curve_error_lambda = curve_error_lambda(made.config, discriminator, 0.0, made.third_wave_lambda);
    made.curve_error_beyond_lambda =
        curve_error_lambda(made.config, discriminator, made.third_wave_lambda, most_lambda);
    made.chi_error_ratio = averaged.bias_residual_ratio;
    return made;
}

}  // namespace

LaserCalibration calibration_of_laser(const config::Config& config) {
    try {
        return calibrate(config);
    } catch (const std::logic_error& error) {
        throw config::ConfigError{error.what()};
    } catch (const config::ConfigError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw config::ConfigError{fmt::format("[laser] does not make a gyro: {}", error.what())};
    }
}

config::Config calibrated_by_laser(const config::Config& config) { return calibration_of_laser(config).config; }

}  // namespace zlg::rig
