#include <zlg/firmware/gyro.hpp>

#include <cstddef>
#include <memory>
#include <span>

namespace zlg::firmware {
namespace {

core::LightSamples light_of(const core::SensorFrame& frame) noexcept {
    const std::size_t n = frame.n_light <= core::max_light_samples ? frame.n_light : 0;
    return {std::span{frame.light_a}.first(n), std::span{frame.light_b}.first(frame.has_light_b ? n : 0)};
}

}  // namespace

SettingsFault check(const Settings& settings) noexcept {
    return {core::check(settings.control), core::check(settings.compensation)};
}

core::ActuatorFrame Gyro::start(const Settings& settings, std::uint64_t counter) noexcept {
    settings_ = settings;
    state_.control = initial_state(settings_.control, counter);
    // In place: a state that is assigned would stand on the stack first, and it is most of the memory.
    std::construct_at(&state_.compensation);
    return initial_actuator(settings_.control);
}

HalfOutput Gyro::half(const core::SensorFrame& frame) noexcept {
    // Only the measured schedule uses what compensation has learnt of the switches.
    const bool asks = settings_.control.schedule.kind == core::ScheduleKind::measured;
    const core::SwitchAdvice advice =
        asks ? core::advice(settings_.compensation, state_.compensation) : core::SwitchAdvice{};
    // The members in order: compensation uses the record just made.
    HalfOutput out{
        .control = step(settings_.control, state_.control, frame, advice),
        .compensation = step(settings_.compensation, state_.compensation, out.control.record, light_of(frame))};
    return out;
}

void Gyro::work(core::Pause pause) noexcept { core::work(settings_.compensation, state_.compensation, pause); }

core::DrainOutput Gyro::drain() noexcept { return core::drain(settings_.compensation, state_.compensation); }

}  // namespace zlg::firmware
