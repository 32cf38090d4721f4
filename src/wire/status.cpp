#include <zlg/wire/status.hpp>

#include <zlg/wire/telemetry.hpp>

#include "packing.hpp"

namespace zlg::wire {
namespace {

constexpr std::size_t body_bytes = 96;

enum Content : std::uint8_t { content_closed = 1, content_held = 2, content_asked = 4 };
constexpr std::uint8_t contents = content_closed | content_held | content_asked;

// The numbers of the body in their order.
template <class Codec, class AnyStatus> void lay_out(Codec&& codec, AnyStatus& s, std::uint8_t& content) noexcept {
    codec(s.tick, s.phase, s.polarity, content, s.n_late, s.tick_s, s.scale_arcsec, s.timer_hz, s.health, s.n_switches,
          s.n_failed, s.half_wave_v, s.half_wave_sigma_v, s.piezo_v, s.temperature_c, s.detuning_lambda,
          s.magnetic_arcsec_s, s.switch_error_arcsec, s.settings_crc, s.n_received, s.n_damaged, s.n_overruns,
          s.stack_used_bytes, s.last_fault);
}

bool is_possible(const Status& s) noexcept {
    return s.phase <= core::SwitchPhase::searching && is_sign(s.polarity) && s.tick_s >= min_tick_s &&
           s.tick_s <= max_tick_s && is_number(s.scale_arcsec) && is_number(s.timer_hz);
}

}  // namespace

Status status_of(const core::GyroControlState& control, const core::GyroCompensationState& compensation,
                 const core::GyroCompensationConfig& config) noexcept {
    const core::SwitchAdvice known = advice(config, compensation);
    Status s;
    s.tick = static_cast<std::uint32_t>(control.half / 2 - 1);
    s.tick_s = config.gyro.tick.value();
    s.scale_arcsec = config.gyro.scale.value();
    s.timer_hz = config.gyro.timer.value();
    s.phase = control.mode_switch.phase;
    s.loop_closed = control.mode_switch.loop_closed;
    s.polarity = control.mode_switch.polarity;
    s.held = control.schedule.held;
    s.n_late = static_cast<std::uint8_t>(compensation.bridge.background.n_late);
    s.asked = control.schedule.asked;
    s.half_wave_v = static_cast<float>(half_wave(control).value());
    s.half_wave_sigma_v = static_cast<float>(sigma(control.half_wave, half_wave(control)).value());
    s.piezo_v = static_cast<float>(control.piezo_v);
    s.temperature_c = static_cast<float>(control.temperature_c);
    s.detuning_lambda = static_cast<float>(control.mode_switch.detuning_lambda);
    s.magnetic_arcsec_s = static_cast<float>(known.magnetic_arcsec_s);
    s.switch_error_arcsec = static_cast<float>(known.switch_error_arcsec);
    return s;
}

Frame frame_of(Sender& sender, const Status& s) noexcept {
    auto content = static_cast<std::uint8_t>((s.loop_closed ? content_closed : 0) | (s.held ? content_held : 0) |
                                             (s.asked ? content_asked : 0));
    Packer p;
    lay_out(p, s, content);
    return frame_of(sender, MessageType::status, p.body());
}

std::optional<Status> status_in(const Message& message) noexcept {
    if (message.type != MessageType::status || message.body.size() != body_bytes) return std::nullopt;
    Status s;
    std::uint8_t content = 0;
    lay_out(Unpacker{message.body}, s, content);
    if ((content & ~contents) != 0) return std::nullopt;
    s.loop_closed = (content & content_closed) != 0;
    s.held = (content & content_held) != 0;
    s.asked = (content & content_asked) != 0;
    if (!is_possible(s)) return std::nullopt;
    return s;
}

}  // namespace zlg::wire
