#include "lock_step.hpp"

#include <zlg/firmware/half_period.hpp>
#include <zlg/firmware/port.hpp>

#include "board.hpp"
#include "registers.hpp"

namespace zlg::firmware::mps2 {
namespace {

// Longer than the host needs for a half-period of the averaged twin: some ten microseconds.
constexpr int n_looks = 2'000;

bool is(const Exchange& x, Readiness readiness) noexcept {
    return x.readiness.load(std::memory_order_relaxed) == static_cast<std::uint32_t>(readiness);
}

[[nodiscard]] bool is_asked(const Exchange& x) noexcept {
    return x.asked.load(std::memory_order_acquire) != x.answered.load(std::memory_order_relaxed);
}

void start_by(Exchange& x) noexcept {
    x.fault = check(x.settings);
    if (x.fault == SettingsFault{}) x.first_actuator = start_gyro(x.settings, x.counter);
}

void start_stored(Exchange& x) noexcept {
    const Settings* const stored = port::stored();
    x.has_stored = stored != nullptr ? 1 : 0;
    if (stored == nullptr) return;
    x.settings = *stored;
    start_by(x);
}

void answer(Exchange& x) noexcept {
    switch (x.request) {
        case Request::none: break;
        case Request::start: start_by(x); break;
        case Request::start_stored: start_stored(x); break;
        case Request::half:
            pend_irq(half_timer_irq);
            barrier();
            x.output = last_half();
            gyro().work();
            break;
        case Request::drain: x.drained = gyro().drain(); break;
        case Request::state:
            x.state = gyro().state();
            x.stack_used_bytes = port::stack_used_bytes();
            break;
    }
}

}  // namespace

bool is_in_lock_step() noexcept { return exchange().magic == lock_step_magic; }

Exchange& exchange() noexcept { return *reinterpret_cast<Exchange*>(0x60000000); }

void present_to_host() noexcept {
    Exchange& x = exchange();
    x.processor_layout = layout();
    auto readiness = x.processor_layout == x.host_layout ? Readiness::ready : Readiness::refused;
    if (is(x, Readiness::ready)) {
        x.ended = port::last_fault();
        readiness = Readiness::restarted;
    }
    x.readiness.store(static_cast<std::uint32_t>(readiness), std::memory_order_release);
}

void wait_for_host() noexcept {
    Exchange& x = exchange();
    // What waits for room on the line has no interrupt to wake it.
    if (x.has_bell == 0 || x.has_line != 0) return;
    for (int k = 0; k < n_looks; ++k)
        if (is_asked(x)) return;
    // With interrupts held back none comes between the last look and the sleep; one that waits ends it.
    asm volatile("cpsid i" ::: "memory");
    x.processor_sleeps.store(1);
    if (!is_asked(x)) asm volatile("wfi" ::: "memory");
    x.processor_sleeps.store(0);
    asm volatile("cpsie i" ::: "memory");
}

void answer_host() noexcept {
    Exchange& x = exchange();
    // Read once: a request that comes between two looks would be answered under the number of the one before, and then
    // again.
    const std::uint32_t asked = x.asked.load(std::memory_order_acquire);
    if (asked == x.answered.load(std::memory_order_relaxed) || !is(x, Readiness::ready)) return;
    answer(x);
    x.answered.store(asked);
    if (x.host_sleeps.load() != 0) ring_bell();
}

}  // namespace zlg::firmware::mps2
