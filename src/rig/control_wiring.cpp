// From a configuration to the parameters of the control.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <zlg/rig/wiring.hpp>

#include "bias_wiring.hpp"
#include "control_refusal.hpp"
#include "fringe_wiring.hpp"
#include "monitor_wiring.hpp"
#include "switching_wiring.hpp"

namespace zlg::rig {
namespace {

// A beam that runs may be faint: at 0.22 wavelength the weaker one of the default laser has a fifth of its light. One that
// does not run has noise alone.
constexpr double laser_dark_fraction = 0.1;

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
    loop.relock_halves = p.relock_halves;
    loop.relock_gain = 1.0 - std::pow(1.0 - p.sample_gain, config.gyro.light_samples);
    loop.time_constant = core::Seconds{std::max(p.settled_tau_s, 0.5 * config.gyro.tick_s)};
}

bool has_ideal_piezo(const config::Config& config) {
    return config.piezo.hysteresis == 0.0 && config.piezo.creep_per_decade == 0.0;
}

// Each decade of time between the end of the gap and the measurement of the half-wave voltage adds its creep to the next
// miss. One loop is no measure of the next one, most of all at first: the steady gain of its filter is 2/3, and a tenth of the
// voltage is no outlier.
void learn_piezo(core::GyroControlConfig& made) {
    made.mode_switch.settle_ticks = 10;
    made.half_wave.measurement_sigma = 0.02 * made.half_wave.presumed;
    made.half_wave.process_sigma = std::sqrt(4.0 / 3.0) * made.half_wave.measurement_sigma;
    made.half_wave.gate = 10.0;
}

}  // namespace

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
        .set_points = config.perimeter.set_points};
    add_relock(config, made.loop);
    made.half_wave.presumed = presumed;
    made.stroke.range = range;
    made.stroke.half_wave = presumed;
    made.stroke.reference = core::Celsius{config.gyro.reference_temperature_c};
    made.schedule = schedule_of(config);
    made.mode_switch.range = range;
    made.mode_switch.gap_ticks = config.switching.gap_ticks;
    made.mode_switch.gap_min_ticks = config.switching.gap_min_ticks;
    if (!has_ideal_piezo(config)) learn_piezo(made);
    // A slow loop needs longer before it may be said to have failed.
    made.mode_switch.lock_timeout_ticks = static_cast<std::int32_t>(std::max<std::int64_t>(
        60, made.mode_switch.settle_ticks + ticks_of(std::min(12.0 * config.perimeter.tau_s, 1e6 * tick_s), tick_s)));
    // Nor may light noise alone look like a lost lock.
    const double noise_lambda = config.gyro.light_noise_lambda / std::sqrt(config.gyro.light_samples);
    made.mode_switch.lock_tolerance = core::Wavelengths{std::clamp(1.2 * noise_lambda, 0.02, 0.25)};
    made.mode_switch.start_set_point = 0.5 * (range.min + range.max);
    made.commutator = commutator_of(config);
    made.fringe = fringe_readout_of(config);
    add_monitors(config, made);
    made.presumed_temperature = core::Celsius{config.gyro.reference_temperature_c};
    require_control(config, made);
    return made;
}

}  // namespace zlg::rig
