// From a configuration to the parameters of the control.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include <zlg/config/schema.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/wiring.hpp>

#include "bias_wiring.hpp"
#include "fringe_wiring.hpp"
#include "piezo_wiring.hpp"

namespace zlg::rig {
namespace {

// Whole ticks of a time, 1 at least.
std::int64_t ticks_of(double time_s, double tick_s) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::llround(time_s / tick_s)));
}

// errors  config::ConfigError for an interval that is still "optimal".
core::SwitchScheduleConfig schedule_of(const config::Config& config) {
    if (config.switching.interval_optimal)
        throw config::ConfigError{
            "switching.interval_s = \"optimal\" must be resolved into seconds before a gyro can run"};
    const config::Switching& sw = config.switching;
    return {.interval_ticks = ticks_of(sw.interval_s, config.gyro.tick_s),
            .first_segment = sw.first_segment,
            .kind = sw.schedule,
            .min_ticks = ticks_of(sw.interval_min_s, config.gyro.tick_s),
            .max_ticks = ticks_of(sw.interval_max_s, config.gyro.tick_s),
            .tick_s = config.gyro.tick_s};
}

// Most counts of a half: one less than the fastest the counter can follow.
std::int64_t counts_limit(const config::Config& config) {
    const double most = 0.5 * config.gyro.tick_s * counter_max_hz(config.gyro);
    return static_cast<std::int64_t>(std::clamp(most - 1.0, 1.0, 0x1p62));
}

// Within which a drift of the photodiodes of .2 an hour is a fault; one tick in four is learnt from
// (light_balance.hpp).
constexpr double balance_s = 240.0;

// Most of the derivative of the loss by the square of the detuning, up to the largest that a switch leaves.
double steepest_loss(const config::Gyro& g) {
    constexpr double largest_lambda2 = 0.24 * 0.24;
    double sum = std::abs(g.bias_chi), power = 1.0;
    for (std::size_t k = 0; k < g.bias_chi_higher.size(); ++k) {
        power *= largest_lambda2;
        sum += static_cast<double>(k + 2) * power * std::abs(g.bias_chi_higher[k]);
    }
    return sum;
}

// Arm the monitors with the change of bias and of perimeter that makes one false count in a tick.
void add_monitors(const config::Config& config, core::GyroControlConfig& made) {
    const config::Gyro& g = config.gyro;
    const double bias_counts = 0.5 * g.tick_s * g.bias_hz;
    made.limits.counts = counts_limit(config);
    made.limits.bias_counts = std::min(bias_counts, 1e15);
    if (bias_counts >= core::min_bias_counts) made.limits.coil_ratio = 0.5 / bias_counts;
    made.limits.light_noise = core::Wavelengths{g.light_noise_lambda};
    // A laser whose curve is not known reads several times its detuning: the bias cannot have lost what that would
    // take.
    const bool reads_true = g.fidelity != config::Fidelity::laser || made.detector.curve.n_nodes > 0;
    if (!reads_true) made.limits.light_gain = 10.0;
    if (reads_true && g.bias_chi > 0.0 && g.bias_chi_higher.empty() && bias_counts >= 100.0)
        made.limits.bias_chi = g.bias_chi;
    const double false_counts = bias_counts * steepest_loss(g);
    if (false_counts > 0.0) {
        const double noise_lambda2 = g.light_noise_lambda * g.light_noise_lambda;
        made.limits.detuning_change_lambda2 = std::min(1.0 / false_counts + 20.0 * noise_lambda2, 1e6);
    }
    made.limits.balance_ticks = std::clamp(0.25 * balance_s / config.gyro.tick_s, 1.0, 1e9);
    made.limits.relock_ticks = config.compensation.relock_ticks;
}

// What the core's check refuses, by the keys that it comes from. Single numbers that it would refuse, the table of keys
// does not allow; these are rules between them.
void require_loop(const config::Config& config, const core::PerimeterLoopConfig& loop) {
    const auto require = [&](bool kept, std::initializer_list<std::string_view> keys, std::string_view allowed) {
        if (!kept) refuse(config, keys, allowed);
    };
    const auto is_above_0 = [](double x, double most) { return x > 0.0 && x <= most; };
    require(is_allowed(loop.range), {"piezo.range_min_v", "piezo.range_max_v"},
            "above -1e6 to below 1e6 V, the first the lower");
    require(loop.half_wave.value() >= 1e-3 && loop.half_wave.value() <= 1e6,
            {"piezo.half_wave_v", "piezo.half_wave_error"},
            "a presumed half-wave voltage, half_wave_v (1 + half_wave_error), of 1e-3..1e6 V");
    require(is_above_0(loop.half_period.value(), 1e3), {"gyro.tick_s"}, "above 0 up to 1e3 s");
    require(is_above_0(loop.time_constant.value(), 1e6), {"perimeter.tau_s"}, "up to 1e6 s");
    require(is_above_0(loop.error_limit.value(), 1e3), {"perimeter.limit_lambda"}, "above 0 up to 1e3");
    require(is_above_0(loop.slew_v_s, 1e12), {"piezo.slew_v_s"}, "above 0 up to 1e12 V/s");
    require(is_allowed(loop), {"gyro.light_samples", "perimeter.relock_halves", "piezo.rc_s"},
            "a gain above 0 of the halves after closing, and piezo.rc_s of 1e-9..1e3 s");
}

// errors  config::ConfigError where the core's check refuses what was made of the configuration.
void require_control(const config::Config& config, const core::GyroControlConfig& made) {
    switch (check(made)) {
        case core::GyroControlFault::none: return;
        case core::GyroControlFault::detector:
            refuse(config,
                   {"gyro.discriminator_per_lambda", "perimeter.discriminator_detuning_lambda",
                    "perimeter.discriminator_signal"},
                   "a slope of size 1e-6..1e6, and a curve that grows, up to 1e3 wavelengths by that slope");
        case core::GyroControlFault::loop: require_loop(config, made.loop); break;
        case core::GyroControlFault::half_wave:
        case core::GyroControlFault::temperature:
            refuse(config, {"piezo.half_wave_v", "piezo.half_wave_error", "gyro.reference_temperature_c"},
                   "a presumed half-wave voltage of 1e-3..1e6 V, and a temperature above -1e6 to below 1e6 C");
        case core::GyroControlFault::fringe:
            refuse(config, {"gyro.readout", "photodiodes.noise"},
                   "a phase of less than 1/20 of a turn of noise, and comparators that follow it within 1/8");
        case core::GyroControlFault::schedule:
            refuse(config,
                   {"switching.interval_s", "switching.interval_min_s", "switching.interval_max_s", "gyro.tick_s"},
                   "intervals of 1..2^53 ticks");
        case core::GyroControlFault::mode_switch:
        case core::GyroControlFault::ranges_differ:
            refuse(config,
                   {"piezo.range_min_v", "piezo.range_max_v", "switching.gap_ticks", "switching.gap_min_ticks",
                    "perimeter.tau_s", "gyro.tick_s"},
                   "a range within +-1e6 V, and up to 2^24 ticks for a gap and for 12 time constants of the loop");
        case core::GyroControlFault::commutator:
            refuse(config, {"gyro.tick_s", "gyro.dither"}, "a tick of 1e-6..800 s, where edges shift from 1.6e-6 s on");
        case core::GyroControlFault::monitors:
            refuse(config, {"gyro.bias_hz", "gyro.bias_chi", "gyro.light_noise_lambda", "gyro.tick_s"},
                   "what makes finite counts in a half");
    }
    throw config::ConfigError{named(config, "the control refuses this gyro")};
}

// A beam that runs may be faint: at 0.22 wavelength the weaker one of the default laser has a fifth of its light. One
// that does not run has noise alone.
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
    const double part = 1.0 - p.sample_gain;
    double left = 1.0, lost = 0.0;  // what a product loses is exact by fma: the power is rounded once
    for (int k = 0; k < config.gyro.light_samples; ++k) {
        const double product = left * part;
        lost = std::fma(left, part, -product) + lost * part;
        left = product;
    }
    loop.relock_gain = 1.0 - (left + lost);
    loop.time_constant = core::Seconds{std::max(p.settled_tau_s, 0.5 * config.gyro.tick_s)};
}

}  // namespace

core::GyroControlConfig control_config(const config::Config& config) {
    const double tick_s = config.gyro.tick_s;
    const core::PiezoRange range = range_of(config);
    const core::Volts presumed{presumed_half_wave_v(config)};
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
        .stage_time_constant = core::Seconds{config.piezo.rc_s}};
    add_relock(config, made.loop);
    made.half_wave.range = range;
    made.half_wave.half_wave = presumed;
    made.half_wave.reference = core::Celsius{config.gyro.reference_temperature_c};
    made.schedule = schedule_of(config);
    made.mode_switch.range = range;
    made.mode_switch.gap_ticks = config.switching.gap_ticks;
    made.mode_switch.gap_min_ticks = config.switching.gap_min_ticks;
    // The voltage creeps after a gap: what is measured soon after it says most of the next move.
    if (!has_no_hysteresis_or_creep(config)) made.mode_switch.settle_ticks = 10;
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
