#include <zlg/rig/wire_stream.hpp>

#include <algorithm>
#include <cmath>

#include <zlg/rig/asked_compensation.hpp>

namespace zlg::rig {
namespace {

void append(const wire::Frame& frame, std::vector<std::uint8_t>& bytes) {
    const auto view = frame.view();
    bytes.insert(bytes.end(), view.begin(), view.end());
}

}  // namespace

WireStream::WireStream(const config::Config& config, std::uint16_t session)
    : replay_{asked_compensation(config)},
      sender_{.session = session},
      report_{.tick_s = config.gyro.tick_s},
      status_ticks_{std::max<std::int64_t>(1, std::llround(std::min(1.0 / config.gyro.tick_s, 1e9)))} {}

void WireStream::take(const ClosedLoop& loop, const LoopHalf& half, std::vector<std::uint8_t>& bytes) {
    if (half.record.half == 0) started_ticks_ = loop.sensor().timer_ticks;
    if (half.control.has_event) {
        const bool switched = half.control.event.outcome == core::SwitchOutcome::switched;
        ++(switched ? status_.n_switches : status_.n_failed);
    }
    const core::CompensationOutput out = replay_.take(half.record, loop.light());
    if (out.has_sample) take_tick(loop, half, out.sample, bytes);
    health_before_ = half.control.health;
}

void WireStream::take_tick(const ClosedLoop& loop, const LoopHalf& half, const core::AngleSample& sample,
                           std::vector<std::uint8_t>& bytes) {
    report_.mode = half.record.mode;
    report_.health = health_before_ | half.control.health;
    report_.temperature_c = half.record.temperature_c;
    const std::uint64_t stamp_ticks = loop.sensor().timer_ticks;
    const std::uint64_t since_start_ticks = stamp_ticks - started_ticks_;
    report_.time = {.timer_ticks = stamp_ticks,
                    .synchronised = true,
                    .n_pulses = static_cast<std::uint32_t>(since_start_ticks / pulse_ticks + 1),
                    .since_pulse_ticks = static_cast<std::uint32_t>(since_start_ticks % pulse_ticks)};
    append(frame_of(sender_, telemetry_of(telemetry_, sample, report_)), bytes);
    if (sample.tick % status_ticks_ == 0) send_status(loop, bytes);
}

void WireStream::send_status(const ClosedLoop& loop, std::vector<std::uint8_t>& bytes) {
    wire::Status now = wire::status_of(loop.control(), replay_.state(), replay_.config());
    now.health = report_.health;
    now.n_switches = status_.n_switches;
    now.n_failed = status_.n_failed;
    append(frame_of(sender_, now), bytes);
}

void WireStream::end(std::vector<std::uint8_t>& bytes) {
    replay_.end(
        [&](const core::AngleRow& row) { append(frame_of(sender_, telemetry_of(telemetry_, row, report_)), bytes); });
}

}  // namespace zlg::rig
