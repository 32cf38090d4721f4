#include <zlg/rig/wiring.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>

#include "bias_wiring.hpp"
#include "fault_wiring.hpp"
#include "laser_wiring.hpp"
#include "monitor_wiring.hpp"
#include "motion_file.hpp"
#include "motion_prior.hpp"
#include "refusal.hpp"
#include "switching_wiring.hpp"

namespace zlg::rig {
namespace {

using config::ConfigError;

twin::LoopKind twin_loop(config::Loop loop) {
    switch (loop) {
        case config::Loop::analog:
            return twin::LoopKind::analog;
        case config::Loop::exponential:
            return twin::LoopKind::exponential;
        case config::Loop::digital:
            return twin::LoopKind::external;
    }
    return twin::LoopKind::analog;
}

twin::Motion sines(const config::Motion& m) {
    std::vector<twin::Sine> sines;
    for (std::size_t k = 0; k < m.amplitude_arcsec_s.size(); ++k)
        sines.push_back({m.amplitude_arcsec_s[k], m.frequency_hz[k], m.phase_deg[m.phase_deg.size() == 1 ? 0 : k]});
    return twin::Motion::sines(m.rate_arcsec_s, std::move(sines));
}

// A tenth of the range, at most the field's own: room for thermal drift until the next switch.
core::PiezoRange range_of(const config::Config& config) {
    const core::Volts min{config.piezo.range_min_v};
    const core::Volts max{config.piezo.range_max_v};
    return {.min = min, .max = max, .margin = core::Volts{std::min(10.0, 0.1 * (max - min).value())}};
}

// The gain of a half in which every light sample corrects its part of what the samples before it have left.
void add_relock(const config::Config& config, core::PerimeterLoopConfig& loop) {
    const config::Perimeter& p = config.perimeter;
    if (loop.kind != core::LoopKind::digital || p.relock_halves == 0) return;
    loop.relock_halves = static_cast<std::int32_t>(p.relock_halves);
    loop.relock_gain = 1.0 - std::pow(1.0 - p.sample_gain, static_cast<double>(config.gyro.light_samples));
    loop.time_constant = core::Seconds{std::max(p.settled_tau_s, 0.5 * config.gyro.tick_s)};
}

bool has_ideal_piezo(const config::Config& config) {
    return config.piezo.hysteresis == 0.0 && config.piezo.creep_per_decade == 0.0;
}

// Each decade of time between the end of the gap and the measurement of the half-wave voltage adds its creep to the next
// miss. One loop is no measure of the next one, most of all at first: 2/3 of what is new is believed, and a tenth of the
// voltage is no outlier.
void learn_piezo(core::GyroControlConfig& made) {
    made.mode_switch.settle_ticks = 10;
    made.half_wave.measurement_sigma = 0.02 * made.half_wave.presumed;
    made.half_wave.process_sigma = std::sqrt(4.0 / 3.0) * made.half_wave.measurement_sigma;
    made.half_wave.gate = 10.0;
}

}  // namespace

twin::Motion motion(const config::Config& config) {
    const config::Motion& m = config.motion;
    switch (m.kind) {
        case config::MotionKind::rest:
            return twin::Motion::rest();
        case config::MotionKind::constant:
            return twin::Motion::sines(m.rate_arcsec_s, {});
        case config::MotionKind::sine:
        case config::MotionKind::sum:
            return sines(m);
        case config::MotionKind::file:
            return motion_of_file(m);
    }
    return twin::Motion::rest();
}

std::int64_t run_ticks(const config::Config& config, const twin::Motion& motion) {
    const double tick_s = config.gyro.tick_s;
    const double available_s = motion.duration_s();
    const double asked_s =
        config.run.duration_s.value_or(std::isfinite(available_s) ? available_s : default_duration_s);
    // A part of a tick in 1e9 is rounding, not a run that is too long.
    if (asked_s > available_s + 1e-9 * tick_s + 1e-12 * available_s)
        throw ConfigError{
            fmt::format("run.duration_s = {}: {} holds {} s of motion", asked_s, config.motion.path, available_s)};
    const double ticks = std::floor(asked_s / tick_s * (1.0 + 1e-12) + 1e-9);
    if (!(ticks >= 1.0))
        throw ConfigError{fmt::format("run.duration_s = {}: allowed is at least one tick, {} s", asked_s, tick_s)};
    return static_cast<std::int64_t>(ticks);
}

twin::TwinConfig twin_config(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    const config::Drift& d = config.drift;
    const config::Perimeter& p = config.perimeter;
    const config::Piezo& z = config.piezo;
    return {.seed = static_cast<std::uint64_t>(config.run.seed),
            .tick_s = g.tick_s,
            .fidelity = g.fidelity == config::Fidelity::laser ? twin::Fidelity::laser : twin::Fidelity::averaged,
            .scale_arcsec = g.scale_arcsec,
            .bias_hz = g.bias_hz,
            .bias_chi = g.bias_chi,
            .bias_edge_s = g.bias_edge_s,
            .first_bias_sign = static_cast<int>(g.first_bias_sign),
            .bias_temperature_coefficient_per_c = g.bias_temperature_coefficient_per_c,
            .reference_temperature_c = g.reference_temperature_c,
            .temperature_rise_c = g.temperature_rise_c,
            .light_samples = static_cast<int>(g.light_samples),
            .light_noise_lambda = g.light_noise_lambda,
            .discriminator_per_lambda = g.discriminator_per_lambda,
            .magnetic_arcsec_s = d.magnetic_arcsec_s,
            .magnetic_thermal_arcsec_s = d.magnetic_thermal_arcsec_s,
            .thermal_time_s = d.thermal_time_s,
            .nonmagnetic_arcsec_s = d.nonmagnetic_arcsec_s,
            .random_walk_arcsec_sqrt_s = d.random_walk_arcsec_sqrt_s,
            .loop = twin_loop(p.loop),
            .tau_s = p.tau_s,
            .limit_lambda = p.limit_lambda,
            .miss_lambda = p.miss_lambda,
            .expansion_lambda_per_c = p.expansion_lambda_per_c,
            .half_wave_v = z.half_wave_v,
            .half_wave_temperature_coefficient_per_c = z.half_wave_temperature_coefficient_per_c,
            .hysteresis = z.hysteresis,
            .hysteresis_stroke_v = z.hysteresis_stroke_v,
            .creep_per_decade = z.creep_per_decade,
            .mirror_hz = z.mirror_hz,
            .mirror_damping = z.mirror_damping,
            .rc_s = z.rc_s,
            .slew_v_s = z.slew_v_s,
            .range_min_v = z.range_min_v,
            .range_max_v = z.range_max_v,
            .dac_bits = static_cast<int>(z.dac_bits),
            .adc_bits = static_cast<int>(z.adc_bits),
            .adc_noise_v = z.adc_noise_v,
            .counter_max_hz = counter_max_hz(g),
            .faults = faults_of(config),
            .vibration_hz = config.faults.vibration_hz,
            .laser = laser_of(config.laser),
            .beats = beats_of(config)};
}

core::DiscriminatorCurve discriminator_curve(const config::Config& config, double slope_per_lambda) {
    const config::Perimeter& p = config.perimeter;
    std::vector<double> apparent_lambda = p.discriminator_signal;
    for (double& x : apparent_lambda) x /= std::abs(slope_per_lambda);
    const auto curve = core::discriminator_curve(apparent_lambda, p.discriminator_detuning_lambda);
    if (check(curve) != core::CurveFault::none)
        throw ConfigError{named(
            config,
            fmt::format(
                "perimeter.discriminator_detuning_lambda: {} numbers, perimeter.discriminator_signal: {}, "
                "gyro.discriminator_per_lambda = {}: make no curve; allowed are as many of each, {} at "
                "most on a side of 0, of the same sign and growing, of signals and detunings up to 1e3 wavelengths",
                p.discriminator_detuning_lambda.size(), p.discriminator_signal.size(), slope_per_lambda,
                core::max_side_nodes))};
    return curve;
}

namespace {

core::OptimalBridgeConfig optimal_config(const config::Config& config, core::RelockMethod relock,
                                         core::BridgeMethod bridge) {
    const double walk = config.drift.random_walk_arcsec_sqrt_s;
    core::OptimalBridgeConfig made{
        .learns = bridge != core::BridgeMethod::optimal || config.compensation.prior == config::MotionPrior::learnt,
        .halves = relock == core::RelockMethod::joint,
        .counter_step = core::Arcsec{config.gyro.scale_arcsec},
        .walk_arcsec2 = walk * walk * config.gyro.tick_s};
    if (!made.learns) made.prior_arcsec2 = motion_prior(config.compensation, config.gyro.tick_s);
    return made;
}

// The samples of the light, as the control reads them.
core::RelockProfileConfig profile_of(const config::Config& config, core::RelockMethod relock) {
    if (relock != core::RelockMethod::joint) return {};
    const config::Gyro& g = config.gyro;
    return {.discriminator_per_lambda = g.discriminator_per_lambda,
            .curve = discriminator_curve(config, g.discriminator_per_lambda),
            .centre = core::Wavelengths{config.perimeter.discriminator_centre_lambda},
            .light_noise = core::Wavelengths{std::min(g.light_noise_lambda, 1e3)},
            .light_samples = static_cast<int>(g.light_samples)};
}

core::MagneticDriftConfig magnetic_of(const config::Config& config) {
    const config::Compensation& c = config.compensation;
    return {.method = c.magnetic,
            .tick = core::Seconds{config.gyro.tick_s},
            .walk = core::ArcsecPerRootSecond{config.drift.random_walk_arcsec_sqrt_s},
            .count = core::Arcsec{config.gyro.scale_arcsec},
            .presumed_arcsec_s = c.magnetic_arcsec_s,
            .presumed_sigma_arcsec_s = c.magnetic_sigma_arcsec_s,
            .warming_arcsec_s = c.magnetic_thermal_arcsec_s,
            .warming_sigma_arcsec_s = c.magnetic_thermal_sigma_arcsec_s,
            .thermal_time = core::Seconds{c.magnetic_thermal_time_s}};
}

[[noreturn]] void refuse_optimal(const config::Config& config, const core::OptimalBridgeConfig& optimal) {
    if (check(optimal) != core::OptimalBridgeFault::prior)
        refuse(config, {"drift.random_walk_arcsec_sqrt_s", "gyro.tick_s", "gyro.scale_arcsec"},
               "a random walk whose square in a tick is a number");
    refuse(config,
           {"compensation.prior", "compensation.prior_band_hz", "compensation.prior_rate_arcsec_s",
            "compensation.prior_line_hz", "compensation.prior_line_arcsec_s", "gyro.tick_s"},
           "rates whose squares, in a tick, are numbers above 0");
}

// errors  config::ConfigError where the configured points do not carry the polynomial of that bridge.
void require_points(config::Config config, core::BridgeMethod bridge) {
    config.compensation.bridge = bridge;
    check_compensation(config);
}

}  // namespace

core::GyroCompensationConfig compensation_config(const config::Config& config, core::RelockMethod relock,
                                                 core::BridgeMethod bridge) {
    const config::Gyro& g = config.gyro;
    const config::Compensation& c = config.compensation;
    const core::GyroCompensationConfig made{
        .relock = {.method = relock,
                   .ticks = c.relock_ticks,
                   .tick = core::Seconds{g.tick_s},
                   .scale = core::Arcsec{g.scale_arcsec},
                   .bias = core::Hertz{g.bias_hz},
                   .chi = g.bias_chi,
                   .temperature_coefficient_per_c = g.bias_temperature_coefficient_per_c,
                   .reference_temperature = core::Celsius{g.reference_temperature_c},
                   .light_noise = core::Wavelengths{g.light_noise_lambda},
                   .light_samples = static_cast<int>(g.light_samples),
                   .centre = core::Wavelengths{config.perimeter.discriminator_centre_lambda},
                   .control_curve = discriminator_curve(config, g.discriminator_per_lambda)},
        .profile = profile_of(config, relock),
        .timer = core::Hertz{timer_hz},
        .plateau_ratio = plateau_ratio(g),
        .bridge = {.method = bridge,
                   .extrapolation_points = static_cast<int>(c.extrapolation_points),
                   .points_before = static_cast<int>(c.points_before),
                   .points_after = static_cast<int>(c.points_after),
                   .count = core::Arcsec{g.scale_arcsec},
                   .optimal = optimal_config(config, relock, bridge)},
        .random_walk = core::ArcsecPerRootSecond{config.drift.random_walk_arcsec_sqrt_s},
        .magnetic = magnetic_of(config)};
    switch (check(made)) {
        case core::GyroCompensationFault::none:
            return made;
        case core::GyroCompensationFault::bridge:
            if (check(made.bridge) == core::GapBridgeFault::optimal) refuse_optimal(config, made.bridge.optimal);
            require_points(config, bridge);
            [[fallthrough]];
        case core::GyroCompensationFault::edges:
        case core::GyroCompensationFault::relock:
            refuse(config, {"gyro.tick_s", "gyro.scale_arcsec", "gyro.bias_hz", "gyro.bias_chi", "gyro.bias_edge_s"},
                   "a gyro that can be compensated: finite numbers, edges shorter than half a tick");
        case core::GyroCompensationFault::random_walk:
            refuse(config, {"drift.random_walk_arcsec_sqrt_s"}, "0 or more");
        case core::GyroCompensationFault::profile:
            refuse(config, {"gyro.discriminator_per_lambda", "compensation.relock"},
                   "sizes 1e-6..1e6 where the light is read");
        case core::GyroCompensationFault::magnetic:
            refuse(config, {"compensation.magnetic", "drift.random_walk_arcsec_sqrt_s"},
                   "a random walk of up to 1e6 arcsec/sqrt(s) where the drift is estimated");
    }
    return made;
}

core::GyroControlConfig control_config(const config::Config& config) {
    const double tick_s = config.gyro.tick_s;
    const core::PiezoRange range = range_of(config);
    const core::Volts presumed{config.piezo.half_wave_v * (1.0 + config.piezo.half_wave_error)};
    core::GyroControlConfig made;
    made.detector.discriminator_per_lambda = config.gyro.discriminator_per_lambda;
    made.detector.curve = discriminator_curve(config, config.gyro.discriminator_per_lambda);
    if (config.gyro.fidelity == config::Fidelity::laser) made.detector.dark_fraction = laser_dark_fraction;
    made.loop = {
        .kind = config.perimeter.loop == config::Loop::digital ? core::LoopKind::digital : core::LoopKind::analog,
        .range = range,
        .half_wave = presumed,
        .half_period = core::Seconds{0.5 * tick_s},
        .time_constant = core::Seconds{std::max(config.perimeter.tau_s, 0.5 * tick_s)},
        .error_limit = core::Wavelengths{config.perimeter.limit_lambda},
        .slew_v_s = config.piezo.slew_v_s,
        .stage_time_constant = core::Seconds{config.piezo.rc_s},
        .set_points = static_cast<std::int32_t>(config.perimeter.set_points)};
    add_relock(config, made.loop);
    made.half_wave.presumed = presumed;
    made.stroke.range = range;
    made.stroke.half_wave = presumed;
    made.stroke.reference = core::Celsius{config.gyro.reference_temperature_c};
    made.schedule = schedule_of(config);
    made.mode_switch.range = range;
    made.mode_switch.gap_ticks = static_cast<std::int32_t>(config.switching.gap_ticks);
    made.mode_switch.gap_min_ticks = static_cast<std::int32_t>(config.switching.gap_min_ticks);
    if (!has_ideal_piezo(config)) learn_piezo(made);
    // A slow loop needs longer before it may be said to have failed.
    made.mode_switch.lock_timeout_ticks = static_cast<std::int32_t>(std::max<std::int64_t>(
        60, made.mode_switch.settle_ticks + ticks_of(std::min(12.0 * config.perimeter.tau_s, 1e6 * tick_s), tick_s)));
    // Nor may light noise alone look like a lost lock.
    const double noise_lambda =
        config.gyro.light_noise_lambda / std::sqrt(static_cast<double>(config.gyro.light_samples));
    made.mode_switch.lock_tolerance = core::Wavelengths{std::clamp(1.2 * noise_lambda, 0.02, 0.25)};
    made.mode_switch.start_set_point = 0.5 * (range.min + range.max);
    made.commutator = commutator_of(config);
    add_monitors(config, made);
    made.presumed_temperature = core::Celsius{config.gyro.reference_temperature_c};
    require_control(config, made);
    return made;
}

config::Config without_switching(config::Config config) {
    // The longest interval that the schema allows, and no run is longer.
    config.switching.schedule = config::Schedule::fixed;
    config.switching.last_segment = config::LastSegment::any;
    config.switching.interval_s = 1e9;
    return config;
}

}  // namespace zlg::rig
