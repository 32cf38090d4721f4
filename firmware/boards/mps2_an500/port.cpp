#include <zlg/firmware/port.hpp>

#include <zlg/firmware/half_period.hpp>

#include "board.hpp"
#include "handlers.hpp"
#include "lock_step.hpp"
#include "registers.hpp"

namespace zlg::firmware {
namespace {

using namespace mps2;

// The machine has no gyro: outside of lock step every frame is missed.
constexpr core::SensorFrame no_frame{.status = core::frame_missed};

std::uint32_t n_overruns = 0;

}  // namespace

void on_half_timer() noexcept {
    half_timer.clear() = 1;
    on_half_period();
    // It reads as whether the timer interrupts.
    if ((half_timer.clear() & 1u) != 0) ++n_overruns;
}

namespace port {

void start() noexcept {
    recall_fault();
    protect_memory();
    trap_division_by_zero();
    start_uart();
    tell_bench(text_of(last_fault()).view());
    set_irq_priority(half_timer_irq, 0x40);
    enable_irq(half_timer_irq);
}

void start_half_periods(std::uint64_t half_ticks) noexcept {
    if (is_in_lock_step()) return present_to_host();
    half_timer.reload() = static_cast<std::uint32_t>(half_ticks * 5 / 2 - 1);
    half_timer.value() = half_timer.reload();
    half_timer.control() = Timer::enable | Timer::interrupt;
    // A host in lock step may take its time, and watches this side itself.
    start_watchdog();
}

const core::SensorFrame& latched() noexcept { return is_in_lock_step() ? exchange().sensor : no_frame; }

Pulse last_pulse() noexcept { return is_in_lock_step() ? exchange().pulse : Pulse{}; }

void command(const core::ActuatorFrame&) noexcept {}

bool has_line() noexcept { return !is_in_lock_step() || exchange().has_line != 0; }

void restart() noexcept { system_reset(); }

std::uint32_t overruns() noexcept { return n_overruns; }

Quiet::Quiet() noexcept : before_{} { asm volatile("mrs %0, primask\n cpsid i" : "=r"(before_)::"memory"); }
Quiet::~Quiet() { asm volatile("msr primask, %0" ::"r"(before_) : "memory"); }

void idle() noexcept {
    if (is_in_lock_step()) {
        wait_for_host();
        return answer_host();
    }
    asm volatile("wfi");
}

}  // namespace port
}  // namespace zlg::firmware
