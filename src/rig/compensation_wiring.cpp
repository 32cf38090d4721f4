// From a configuration to the parameters of the compensation.

#include <algorithm>
#include <cmath>

#include <zlg/config/schema.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/wiring.hpp>

#include "bias_wiring.hpp"
#include "fringe_wiring.hpp"

namespace zlg::rig {
namespace {

// The core has further terms over chi, which is then not 0: less than this is no angle.
constexpr double least_chi = 1e-6;

double chi_of(const config::Gyro& g) {
    return g.bias_chi_higher.empty() || std::abs(g.bias_chi) > least_chi ? g.bias_chi : least_chi;
}

core::LossBend bend_of(const config::Gyro& g) {
    core::LossBend bend;
    for (std::size_t k = 0; k < std::min(g.bias_chi_higher.size(), bend.term.size()); ++k)
        bend.term[k] = g.bias_chi_higher[k] / chi_of(g);
    return bend;
}

// Without `record_curve`, which depends on how the log was recorded: `asked_compensation` sets it.
core::CompensationConstants constants_of(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    return {.tick = core::Seconds{g.tick_s},
            .scale = core::Arcsec{g.scale_arcsec},
            .random_walk = core::ArcsecPerRootSecond{config.drift.random_walk_arcsec_sqrt_s},
            .bias = core::Hertz{g.bias_hz},
            .chi = chi_of(g),
            .bend = bend_of(g),
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
                                                       .gap_ticks = static_cast<int>(config.switching.gap_ticks)},
                                            .magnetic = magnetic_of(config),
                                            .lock_in = lock_in_of(config),
                                            .gyro = constants_of(config)};
    switch (check(made)) {
        case core::GyroCompensationFault::none: return made;
        case core::GyroCompensationFault::bridge:
            require_points(config, bridge);
            refuse(config, {"gyro.tick_s", "switching.gap_ticks", "compensation.relock_ticks"},
                   "max(16, gap_ticks) + max(8, relock_ticks) + 80 ms in ticks + 1 of at most 128 ticks, after which a "
                   "tick is final with compensation.bridge = \"auto\"");
        case core::GyroCompensationFault::edges:
        case core::GyroCompensationFault::relock:
            refuse(config, {"gyro.tick_s", "gyro.scale_arcsec", "gyro.bias_hz", "gyro.bias_chi", "gyro.bias_edge_s"},
                   "a gyro that can be compensated: finite numbers, edges shorter than half a tick");
        case core::GyroCompensationFault::random_walk: refuse(config, {"drift.random_walk_arcsec_sqrt_s"}, "0..1e6");
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
