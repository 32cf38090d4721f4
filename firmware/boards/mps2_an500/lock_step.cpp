#include "lock_step.hpp"

#include <zlg/firmware/exchange.hpp>
#include <zlg/firmware/half_period.hpp>
#include <zlg/firmware/port.hpp>

#include "registers.hpp"

namespace zlg::firmware::mps2 {
namespace {

// Memory of the machine that a gyro's board has not: it serves nothing but this exchange.
Exchange& exchange() noexcept { return *reinterpret_cast<Exchange*>(0x60000000); }

bool is(const Exchange& x, Readiness readiness) noexcept {
    return x.readiness.load(std::memory_order_relaxed) == static_cast<std::uint32_t>(readiness);
}

void start_by(Exchange& x) noexcept {
    x.fault = check(x.settings);
    if (x.fault == SettingsFault{}) x.first_actuator = start_gyro(x.settings, x.counter);
}

void answer(Exchange& x) noexcept {
    switch (x.request) {
        case Request::none:
            break;
        case Request::start:
            start_by(x);
            break;
        case Request::half:
            pend_irq(half_timer_irq);
            barrier();
            x.output = last_half();
            x.half_wave = gyro().state().control.half_wave;
            break;
        case Request::drain:
            x.drained = gyro().drain();
            break;
        case Request::state:
            x.state = gyro().state();
            x.stack_used_bytes = port::stack_used_bytes();
            break;
    }
}

}  // namespace

bool is_in_lock_step() noexcept { return exchange().magic == lock_step_magic; }

bool host_listens() noexcept { return exchange().has_line != 0; }

const core::SensorFrame& host_frame() noexcept { return exchange().sensor; }

Pulse host_pulse() noexcept { return exchange().pulse; }

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

void answer_host() noexcept {
    Exchange& x = exchange();
    const std::uint32_t asked = x.asked.load(std::memory_order_acquire);
    if (asked == x.answered.load(std::memory_order_relaxed) || !is(x, Readiness::ready)) return;
    answer(x);
    x.answered.store(asked, std::memory_order_release);
}

}  // namespace zlg::firmware::mps2
