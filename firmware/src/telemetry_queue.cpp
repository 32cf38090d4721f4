#include "telemetry_queue.hpp"

namespace zlg::firmware {
namespace {

constinit TelemetryQueue the_queue;

}  // namespace

TelemetryQueue& telemetry_queue() noexcept { return the_queue; }

void TelemetryQueue::restart() noexcept {
    sums_ = {};
    health_of_first_ = 0;
    begin_.store(end_.load(std::memory_order_relaxed), std::memory_order_relaxed);
}

void TelemetryQueue::put(const HalfOutput& half, const wire::TickTime& ended, double tick_s) noexcept {
    if (!half.compensation.has_sample) {
        health_of_first_ = half.control.health;
        return;
    }
    // Also of a tick that does not fit.
    const wire::Telemetry told = telemetry_of(sums_, half.compensation.sample,
                                              {.mode = half.control.record.mode,
                                               .health = health_of_first_ | half.control.health,
                                               .temperature_c = half.control.record.temperature_c,
                                               .tick_s = tick_s,
                                               .time = ended});
    const std::uint32_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == waiting_.size()) return;
    waiting_[end % waiting_.size()] = told;
    end_.store(end + 1, std::memory_order_release);
}

bool TelemetryQueue::take(wire::Telemetry& told) noexcept {
    const std::uint32_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    told = waiting_[begin % waiting_.size()];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
}

}  // namespace zlg::firmware
