#include "telemetry_queue.hpp"

namespace zlg::firmware {
namespace {

constinit TelemetryQueue the_queue;

}  // namespace

TelemetryQueue& telemetry_queue() noexcept { return the_queue; }

void TelemetryQueue::restart() noexcept {
    sums_ = {};
    skipped_ = {};
    has_skipped_ = false;
    health_of_first_ = 0;
    begin_.store(end_.load(std::memory_order_relaxed), std::memory_order_relaxed);
}

void TelemetryQueue::put(const HalfOutput& half, const wire::TickTime& ended, double tick_s) noexcept {
    if (!half.compensation.has_sample) {
        health_of_first_ = half.control.health;
        return;
    }
    const wire::TickReport report{.mode = half.control.record.mode,
                                  .health = health_of_first_ | half.control.health,
                                  .temperature_c = half.control.record.temperature_c,
                                  .tick_s = tick_s,
                                  .time = ended};
    const std::uint32_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == waiting_.size()) {
        (void)telemetry_of(skipped_, half.compensation.sample, report);
        has_skipped_ = true;
        return;
    }
    Tick& tick = waiting_[end % waiting_.size()];
    tick.sample = half.compensation.sample;
    tick.report = report;
    tick.after_others = has_skipped_;
    if (has_skipped_) {
        tick.others = skipped_;
        skipped_ = {};
        has_skipped_ = false;
    }
    end_.store(end + 1, std::memory_order_release);
}

bool TelemetryQueue::take(wire::Telemetry& message) noexcept {
    const std::uint32_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    const Tick& tick = waiting_[begin % waiting_.size()];
    if (tick.after_others) skip(sums_, tick.others);
    message = telemetry_of(sums_, tick.sample, tick.report);
    begin_.store(begin + 1, std::memory_order_release);
    return true;
}

}  // namespace zlg::firmware
