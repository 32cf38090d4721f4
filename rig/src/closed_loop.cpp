#include <zlg/rig/closed_loop.hpp>

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::rig {
namespace {

// The twin names its own parameters; these have another name as a key.
std::string with_keys(std::string message) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 12> names{
        {{"loop_tau_s", "perimeter.tau_s"},
         {"loop_limit_lambda", "perimeter.limit_lambda"},
         {"piezo_hysteresis_stroke_v", "piezo.hysteresis_stroke_v"},
         {"piezo_hysteresis", "piezo.hysteresis"},
         {"piezo_creep_per_decade", "piezo.creep_per_decade"},
         {"mirror_hz", "piezo.mirror_hz"},
         {"mirror_damping", "piezo.mirror_damping"},
         {"high_voltage_rc_s", "piezo.rc_s"},
         {"piezo_min_v", "piezo.range_min_v"},
         {"piezo_max_v", "piezo.range_max_v"},
         {"counter_max_hz", "gyro.counter_max_hz"},
         {"vibration_hz", "faults.vibration_hz"}}};
    for (const auto& [parameter, key] : names) {
        const std::size_t at = message.find(parameter);
        if (at != std::string::npos) message.replace(at, parameter.size(), key);
    }
    return message;
}

twin::Twin make_twin(const config::Config& config, twin::Motion motion) {
    try {
        return twin::Twin{twin_config(config), std::move(motion)};
    } catch (const std::invalid_argument& error) {
        throw config::ConfigError{with_keys(error.what())};
    } catch (const std::runtime_error& error) {
        // A laser without light, or one whose light no table can hold.
        throw config::ConfigError{fmt::format("[laser] does not make a gyro: {}", error.what())};
    }
}

// Rates that a configuration allows and no counter can follow show only when it runs.
twin::TwinHalf advance_twin(twin::Twin& twin, const core::ActuatorFrame& actuator) {
    try {
        return twin.advance(actuator);
    } catch (const std::overflow_error& error) {
        throw config::ConfigError{
            fmt::format("[gyro], [drift] or [motion] asks for a rate beyond any counter: {}", error.what())};
    }
}

// The compensation as it is configured; for a schedule that asks for it, always with an eye on the magnetic drift.
core::GyroCompensationConfig adviser_config(const config::Config& config) {
    config::Config watching = config;
    if (config.switching.schedule == config::Schedule::measured &&
        watching.compensation.magnetic == core::MagneticMethod::none)
        watching.compensation.magnetic = core::MagneticMethod::watch;
    return compensation_config(watching, config.compensation.relock.value_or(core::RelockMethod::mean_square),
                               config.compensation.bridge);
}

// Of a run whose last segment is to balance the modes; else 0.
std::int64_t balanced_end(const config::Config& config, const twin::Motion& motion) {
    return config.switching.last_segment == config::LastSegment::half ? run_ticks(config, motion) : 0;
}

}  // namespace

ClosedLoop::ClosedLoop(const config::Config& config, twin::Motion motion, Processor* processor)
    : ClosedLoop{config, balanced_end(config, motion), std::move(motion), processor} {}

ClosedLoop::ClosedLoop(const config::Config& config, std::int64_t end_tick, twin::Motion&& motion, Processor* processor)
    : twin_{make_twin(config, std::move(motion))},
      control_config_{control_config(config)},
      control_state_{initial_state(control_config_)},
      actuator_{initial_actuator(control_config_)},
      processor_{processor} {
    control_config_.schedule.end_tick = end_tick;
    if (processor_)
        actuator_ = processor_->start({control_config_, adviser_config(config)});
    else if (config.switching.schedule == config::Schedule::measured)
        adviser_.emplace(Adviser{adviser_config(config)});
}

LoopHalf ClosedLoop::advance() {
    const twin::TwinHalf half = advance_twin(twin_, actuator_);
    sensor_ = half.sensor;
    LoopHalf out;
    if (processor_)
        step_outside(out);
    else
        step_here(out);
    out.record = out.control.record;
    out.truth = half.truth;
    actuator_ = out.control.actuator;
    return out;
}

void ClosedLoop::step_here(LoopHalf& out) {
    const core::SwitchAdvice advice = adviser_ ? core::advice(adviser_->config, adviser_->state) : core::SwitchAdvice{};
    out.control = step(control_config_, control_state_, sensor_, advice);
    if (adviser_) (void)step(adviser_->config, adviser_->state, out.control.record, light());
    out.half_wave_v = control_state_.half_wave.estimate_v;
    out.half_wave_sigma_v = sigma(control_state_.half_wave).value();
}

void ClosedLoop::step_outside(LoopHalf& out) {
    const ProcessorHalf half = processor_->half(sensor_);
    out.control = half.control;
    out.compensation = half.compensation;
    out.half_wave_v = half.half_wave.estimate_v;
    out.half_wave_sigma_v = sigma(half.half_wave).value();
}

core::LightSamples ClosedLoop::light() const {
    const std::span a{sensor_.light_a};
    const std::span b{sensor_.light_b};
    return {a.first(sensor_.n_light), b.first(sensor_.has_light_b ? sensor_.n_light : 0u)};
}

}  // namespace zlg::rig
