#pragma once
// What the gyro would have sent over its line, from a closed loop that runs here.

#include <cstdint>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/twin/twin_config.hpp>
#include <zlg/wire/status.hpp>
#include <zlg/wire/telemetry.hpp>

namespace zlg::rig {

// The pulse of a clock outside that the simulated gyro is given: one a second, the first with the first half.
inline constexpr std::uint64_t pulse_ticks = static_cast<std::uint64_t>(twin::timer_hz);

class WireStream {
public:
    // session  number of this start of the gyro.
    //
    // errors  config::ConfigError.
    WireStream(const config::Config& config, std::uint16_t session = 1);

    // Append to `bytes` what is sent after this half, the one that `loop` has just made: a message at the end of each
    // tick, another one of the state each second.
    void take(const ClosedLoop& loop, const LoopHalf& half, std::vector<std::uint8_t>& bytes);

    // The rows that are settled when measuring stops.
    void end(std::vector<std::uint8_t>& bytes);

private:
    void take_tick(const ClosedLoop& loop, const LoopHalf& half, const core::AngleSample& sample,
                   std::vector<std::uint8_t>& bytes);
    void send_status(const ClosedLoop& loop, std::vector<std::uint8_t>& bytes);

    Replay replay_;
    wire::Sender sender_;
    wire::TelemetryState telemetry_{};
    wire::TickReport report_{};
    wire::Status status_{};
    std::uint32_t health_before_ = 0;  // of the half before
    std::int64_t status_ticks_;        // from one to the next
    std::uint64_t started_ticks_ = 0;  // stamp of the first half
};

}  // namespace zlg::rig
