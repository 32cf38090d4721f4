#pragma once
// From the interrupt of the half-period to the background: what there is to tell of each tick.

#include <array>
#include <atomic>
#include <cstdint>

#include <zlg/firmware/gyro.hpp>
#include <zlg/wire/telemetry.hpp>

namespace zlg::firmware {

// One side puts, the other takes.
class TelemetryQueue {
public:
    // A gyro that begins anew. Nobody may put meanwhile.
    void restart() noexcept;

    // The next half. A tick that does not fit is not told, for the gyro does not wait for its listener; its angle is in the sums
    // of the next one.
    //
    // ended  when the half did.
    void put(const HalfOutput& half, const wire::TickTime& ended, double tick_s) noexcept;

    [[nodiscard]] bool take(wire::Telemetry& told) noexcept;

private:
    wire::TelemetryState sums_{};
    std::array<wire::Telemetry, 4> waiting_{};
    std::atomic<std::uint32_t> begin_{};
    std::atomic<std::uint32_t> end_{};
    std::uint32_t health_of_first_ = 0;
};

// That of this processor.
[[nodiscard]] TelemetryQueue& telemetry_queue() noexcept;

}  // namespace zlg::firmware
