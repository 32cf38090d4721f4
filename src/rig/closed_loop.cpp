#include <zlg/rig/closed_loop.hpp>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

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

std::optional<LeapPlan> plan_of(const config::Config& config, const twin::Motion& motion) {
    if (config.gyro.fidelity != config::Fidelity::events || !why_lived(config, motion).empty()) return {};
    return leap_plan(config, control_config(config), adviser_config(config), motion);
}

// A stretch between two events is leapt over in so many parts: points of the error in time.
constexpr std::int64_t parts_of_a_stretch = 16;
// Shorter ones are lived; ticks that are told one by one come so many at a time.
constexpr std::int64_t least_ticks = 16;
constexpr std::int64_t most_single_ticks = 1024;

// Times of forgetting in which the motion is learnt before the first event: .95 of what can be.
constexpr std::int64_t first_lessons = 3;

}  // namespace

ProcessorSettings processor_settings(const config::Config& config) {
    return {control_config(config), adviser_config(config)};
}

ClosedLoop::ClosedLoop(const config::Config& config, twin::Motion motion, Processor* processor)
    : config_{config},
      plan_{processor ? std::nullopt : plan_of(config, motion)},
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
    last_ = out.record;
    piece_ticks_ = 0;
    return out;
}

std::int64_t ClosedLoop::quiet_ticks(std::int64_t most_halves) {
    if (!plan_ || !is_quiet(*plan_, control_state_)) return 0;
    const std::int64_t tick = control_state_.half / 2;
    const std::int64_t opens = next_opening(control_config_.schedule, control_state_.schedule, tick, last_.mode);
    const std::int64_t event = std::min(opens - tick, twin_.quiet_halves() / 2);
    return std::min(event - plan_->before_ticks, most_halves / 2);
}

std::optional<Leap> ClosedLoop::leap(std::int64_t most_halves, std::int64_t longest_ticks) {
    const std::int64_t quiet = quiet_ticks(most_halves);
    if (quiet < least_ticks) return {};
    if (piece_ticks_ == 0) {
        piece_ticks_ = quiet / parts_of_a_stretch + 1;
        learn_ticks_ = has_leapt_ ? plan_->learn_ticks : first_lessons * plan_->learn_ticks;
        has_leapt_ = true;
    }
    const bool learns = quiet <= learn_ticks_, singly = plan_->all_singly || learns;
    std::int64_t ticks = std::min(learns ? quiet : quiet - learn_ticks_, std::max(piece_ticks_, least_ticks));
    if (singly) ticks = std::min(ticks, most_single_ticks);
    ticks = std::min({ticks, twin_.even_halves() / 2, std::max(longest_ticks, least_ticks)});
    const core::PiezoRange& range = control_config_.loop.range;
    // The warming moves the piezo in one direction: where it ends, it is nearest to an end of the range.
    while (ticks > 0 && near_end(range, core::Volts{twin_.voltage_after(2 * ticks)})) ticks /= 2;
    if (ticks < least_ticks) return {};
    Leap made = leap_of(twin_.leap(2 * ticks, {.singly = singly, .noise = plan_->noise}), last_);
    made.learns = learns;
    rig::leap(control_config_, control_state_, made);
    if (adviser_) adviser_->leap(made);
    for (double& v : actuator_.set_point_v) v += made.set_point_v;
    last_.temperature_c = made.temperature_c;
    if (made.has_place) last_.fringe = static_cast<float>(made.end_parts);
    return made;
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
