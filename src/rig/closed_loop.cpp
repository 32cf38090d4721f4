#include <zlg/rig/closed_loop.hpp>

#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::rig {
namespace {

constexpr core::SensorFrame before_the_first{};

twin::Twin make_twin(const config::Config& config, twin::Motion motion) {
    const twin::TwinConfig made = twin_config(config);
    try {
        return twin::Twin{made, std::move(motion)};
    } catch (const std::invalid_argument& error) {
        throw config::ConfigError{named(config, error.what())};
    } catch (const std::runtime_error& error) {
        // The laser does not lase, or its light cannot be tabulated.
        throw config::ConfigError{named(config, fmt::format("[laser] does not make a gyro: {}", error.what()))};
    }
}

// Whether the counter can follow the rates of a motion shows only in the run.
const twin::TwinHalf& advance_twin(twin::Twin& twin, const core::ActuatorFrame& actuator,
                                   const config::Config& config) {
    try {
        return twin.advance(actuator);
    } catch (const std::overflow_error& error) {
        refuse_rate(config, error.what());
    }
}

core::GyroCompensationConfig adviser_config(const config::Config& config) {
    config::Config watching = config;
    if (config.switching.schedule == config::Schedule::measured &&
        watching.compensation.magnetic == core::MagneticMethod::none)
        watching.compensation.magnetic = core::MagneticMethod::watch;
    return asked_compensation(watching);
}

}  // namespace

ProcessorSettings processor_settings(const config::Config& config) {
    return {control_config(config), adviser_config(config)};
}

ClosedLoop::ClosedLoop(const config::Config& config, twin::Motion motion, Processor* processor)
    : config_{config},
      twin_{make_twin(config, std::move(motion))},
      control_config_{control_config(config)},
      control_state_{initial_state(control_config_)},
      actuator_{initial_actuator(control_config_)},
      half_wave_{measured_half_wave(config)},
      sensor_{&before_the_first},
      processor_{processor} {
    if (processor_)
        actuator_ = processor_->start(processor_settings(config));
    else if (config.switching.schedule == config::Schedule::measured)
        adviser_.emplace(adviser_config(config));
}

LoopHalf ClosedLoop::advance() {
    const twin::TwinHalf& half = advance_twin(twin_, actuator_, config_);
    sensor_ = &half.sensor;
    LoopHalf out = processor_ ? step_outside() : step_here();
    if (out.control.has_event) half_wave_.take(out.control.event);
    out.half_wave_v = half_wave_.estimate_v;
    out.half_wave_sigma_v = half_wave_.sigma_v();
    out.record = out.control.record;
    out.truth = half.truth;
    actuator_ = out.control.actuator;
    return out;
}

LoopHalf ClosedLoop::step_here() {
    const core::SwitchAdvice advice =
        adviser_ ? core::advice(adviser_->config(), adviser_->state()) : core::SwitchAdvice{};
    LoopHalf out{.control = step(control_config_, control_state_, *sensor_, advice)};
    if (adviser_) adviser_->take(out.control.record, light());
    return out;
}

LoopHalf ClosedLoop::step_outside() {
    const ProcessorHalf half = processor_->half(*sensor_);
    return {.control = half.control, .compensation = half.compensation};
}

core::LightSamples ClosedLoop::light() const {
    const std::span a{sensor_->light_a};
    const std::span b{sensor_->light_b};
    return {a.first(sensor_->n_light), b.first(sensor_->has_light_b ? sensor_->n_light : 0u)};
}

}  // namespace zlg::rig
