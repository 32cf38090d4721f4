// From a configuration to the parameters of the compensation.

#include <cmath>
#include <numbers>

#include <zlg/config/schema.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/wiring.hpp>

#include "bias_wiring.hpp"
#include "fringe_wiring.hpp"

namespace zlg::rig {
namespace {

// Lines that stand for a band; a hundredth of a period apart over the longest distance in a window.
constexpr int lines_in_band = 2000;

// White part of a prior's variance: without it a counter of very small steps leaves a matrix that cannot be inverted.
constexpr double white_part = 1e-9;

void add_line(core::Window& prior, double variance_arcsec2_s2, double frequency_hz, double half_s) {
    const double x = std::numbers::pi * frequency_hz * half_s;
    const double mean = x > 0.0 ? core::maths::sin(x) / x : 1.0;
    const double variance = variance_arcsec2_s2 * half_s * half_s * mean * mean;
    for (std::size_t k = 0; k < prior.size(); ++k)
        prior[k] += variance * core::maths::cos(2.0 * x * static_cast<double>(k));
}

// Covariance of the angles of two half-ticks of h = T/2 by their distance k, arcsec^2.
//
//   a line of amplitude a at f:  (a^2/2) h^2 sinc^2(f h) cos(2 pi f h k);   a flat band: the mean of it over 0..band
core::Window motion_prior(const config::Compensation& c, double tick_s) {
    core::Window prior{};
    const double half_s = 0.5 * tick_s;
    if (c.prior == config::MotionPrior::lines) {
        for (std::size_t i = 0; i < c.prior_line_hz.size(); ++i)
            add_line(prior, 0.5 * c.prior_line_arcsec_s[i] * c.prior_line_arcsec_s[i], c.prior_line_hz[i], half_s);
    } else {
        const double each = c.prior_rate_arcsec_s * c.prior_rate_arcsec_s / lines_in_band;
        for (int i = 0; i < lines_in_band; ++i)
            add_line(prior, each, (i + 0.5) / lines_in_band * c.prior_band_hz, half_s);
    }
    prior[0] *= 1.0 + white_part;
    return prior;
}

// Without `record_curve`, which depends on how the log was recorded: `asked_compensation` sets it.
core::CompensationConstants constants_of(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    return {.tick = core::Seconds{g.tick_s},
            .scale = core::Arcsec{g.scale_arcsec},
            .random_walk = core::ArcsecPerRootSecond{config.drift.random_walk_arcsec_sqrt_s},
            .bias = core::Hertz{g.bias_hz},
            .chi = g.bias_chi,
            .temperature_coefficient_per_c = g.bias_temperature_coefficient_per_c,
            .reference_temperature = core::Celsius{g.reference_temperature_c},
            .centre = core::Wavelengths{config.perimeter.discriminator_centre_lambda},
            .timer = core::Hertz{timer_hz},
            .plateau_ratio = plateau_ratio(g),
            .light_noise = core::Wavelengths{g.light_noise_lambda},
            .light_samples = g.light_samples,
            .fringe_noise_counts = fringe_noise_counts(config),
            .control_curve = discriminator_curve(config, g.discriminator_per_lambda)};
}

// Whether the motion is learnt and gaps are estimated by half-ticks: each half must be corrected, or read as it is. Learning
// by half-ticks costs a processor a seventh more, so that `auto` does it with `joint` alone.
bool has_halves(core::RelockMethod relock, core::BridgeMethod bridge) {
    if (relock == core::RelockMethod::joint) return true;
    return bridge == core::BridgeMethod::optimal &&
           (relock == core::RelockMethod::mean_square || relock == core::RelockMethod::none);
}

core::OptimalBridgeConfig optimal_config(const config::Config& config, core::RelockMethod relock,
                                         core::BridgeMethod bridge) {
    core::OptimalBridgeConfig made{
        .learns = bridge != core::BridgeMethod::optimal || config.compensation.prior == config::MotionPrior::learnt,
        .halves = has_halves(relock, bridge)};
    if (!made.learns) made.prior_arcsec2 = motion_prior(config.compensation, config.gyro.tick_s);
    return made;
}

// How `joint` reads the light samples: with the slope and the curve of the control.
core::RelockProfileConfig profile_of(const config::Config& config, core::RelockMethod relock) {
    if (relock != core::RelockMethod::joint) return {};
    const double slope_per_lambda = config.gyro.discriminator_per_lambda;
    return {.discriminator_per_lambda = slope_per_lambda, .curve = discriminator_curve(config, slope_per_lambda)};
}

core::MagneticDriftConfig magnetic_of(const config::Config& config) {
    const config::Compensation& c = config.compensation;
    return {.method = c.magnetic,
            .presumed_arcsec_s = c.magnetic_arcsec_s,
            .presumed_sigma_arcsec_s = c.magnetic_sigma_arcsec_s,
            .warming_arcsec_s = c.magnetic_thermal_arcsec_s,
            .warming_sigma_arcsec_s = c.magnetic_thermal_sigma_arcsec_s,
            .thermal_time = core::Seconds{c.magnetic_thermal_time_s}};
}

// Thresholds of the beat; the core counts `counts_per_turn` in a cycle of it.
core::LockInConfig lock_in_of(const config::Config& config) {
    const double counts = counts_per_turn(config.laser.quadrature);
    return {.threshold = core::Hertz{counts * config.compensation.lock_in_hz},
            .sigma = core::Hertz{counts * config.compensation.lock_in_sigma_hz}};
}

[[noreturn]] void refuse_prior(const config::Config& config) {
    refuse(config,
           {"compensation.prior", "compensation.prior_band_hz", "compensation.prior_rate_arcsec_s",
            "compensation.prior_line_hz", "compensation.prior_line_arcsec_s", "gyro.tick_s"},
           "rates whose squares, in a tick, are numbers above 0");
}

// errors  config::ConfigError where the configured points do not carry the polynomial of that bridge, or a key of
//         [gyro] or [compensation] is out of its range.
void require_points(config::Config config, core::BridgeMethod bridge) {
    config.compensation.bridge = bridge;
    check_compensation(config);
}

}  // namespace

core::GyroCompensationConfig compensation_config(const config::Config& config, core::RelockMethod relock,
                                                 core::BridgeMethod bridge) {
    const config::Compensation& c = config.compensation;
    const core::GyroCompensationConfig made{.relock = {.method = relock, .ticks = c.relock_ticks},
                                            .profile = profile_of(config, relock),
                                            .bridge = {.method = bridge,
                                                       .extrapolation_points = c.extrapolation_points,
                                                       .points_before = c.points_before,
                                                       .points_after = c.points_after,
                                                       .optimal = optimal_config(config, relock, bridge)},
                                            .magnetic = magnetic_of(config),
                                            .lock_in = lock_in_of(config),
                                            .gyro = constants_of(config)};
    switch (check(made)) {
        case core::GyroCompensationFault::none:
            return made;
        case core::GyroCompensationFault::bridge:
            if (check(made.bridge) == core::GapBridgeFault::optimal) refuse_prior(config);
            require_points(config, bridge);
            break;
        case core::GyroCompensationFault::edges:
        case core::GyroCompensationFault::relock:
            refuse(config, {"gyro.tick_s", "gyro.scale_arcsec", "gyro.bias_hz", "gyro.bias_chi", "gyro.bias_edge_s"},
                   "a gyro that can be compensated: finite numbers, edges shorter than half a tick");
        case core::GyroCompensationFault::random_walk:
            refuse(config, {"drift.random_walk_arcsec_sqrt_s"}, "0..1e6");
        case core::GyroCompensationFault::profile:
            refuse(config, {"gyro.discriminator_per_lambda", "compensation.relock"},
                   "sizes 1e-6..1e6 where the light is read");
        case core::GyroCompensationFault::magnetic:
            refuse(config,
                   {"compensation.magnetic_arcsec_s", "compensation.magnetic_sigma_arcsec_s",
                    "compensation.magnetic_thermal_arcsec_s", "compensation.magnetic_thermal_sigma_arcsec_s",
                    "compensation.magnetic_thermal_time_s"},
                   "drifts of up to 1e6 arcsec/s and a time constant of 1e-9..1e12 s");
        case core::GyroCompensationFault::lock_in:
            refuse(config, {"compensation.lock_in_hz", "compensation.lock_in_sigma_hz"}, "0..1e6");
    }
    throw config::ConfigError{named(config, "the compensation refuses this gyro")};
}

}  // namespace zlg::rig
