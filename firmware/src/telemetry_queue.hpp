#pragma once
// From the interrupt of the half-period to the background: what there is to tell of each tick.

#include <array>
#include <atomic>
#include <cstdint>

#include <zlg/firmware/gyro.hpp>
#include <zlg/wire/telemetry.hpp>

namespace zlg::firmware {

// One side puts, the other takes, and makes the messages: the interrupt has no time for that.
class TelemetryQueue {
public:
    // A gyro that begins anew. Nobody may put meanwhile.
    void restart() noexcept;

    // The next half. A tick that does not fit is not sent, for the gyro does not wait for its listener; its angle is in
    // the sums of the next one.
    //
    // ended  when the half did.
    void put(const HalfOutput& half, const wire::TickTime& ended, double tick_s) noexcept;

    [[nodiscard]] bool take(wire::Telemetry& message) noexcept;

private:
    struct Tick {
        core::AngleSample sample{};
        wire::TickReport report{};
        bool after_others = false;      // ticks before it did not fit
        wire::TelemetryState others{};  // their sums
    };

    std::array<Tick, 4> waiting_{};
    std::atomic<std::uint32_t> begin_{};
    std::atomic<std::uint32_t> end_{};

    // Of the side that puts.
    std::uint32_t health_of_first_ = 0;
    bool has_skipped_ = false;
    wire::TelemetryState skipped_{};

    // Of the side that takes.
    wire::TelemetryState sums_{};
};

// That of this processor.
[[nodiscard]] TelemetryQueue& telemetry_queue() noexcept;

}  // namespace zlg::firmware
