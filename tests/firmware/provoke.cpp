// An image with all parts of the product's but its main: it lives like that one until it does what must not happen.
//
// What that is, a number in memory says which the machine is given. After the restart it tells how it is and ends the
// emulator.

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <zlg/firmware/half_period.hpp>
#include <zlg/firmware/port.hpp>

#include "board.hpp"
#include "lock_step.hpp"
#include "registers.hpp"

namespace {

using namespace zlg::firmware;
using namespace zlg::firmware::mps2;

constexpr Settings defaults{};

// Halves after which it happens: the gyro is then at work.
constexpr std::uint32_t quiet_halves = 40;

[[noreturn]] void leave() {
    asm volatile(
        "mov r0, #0x18\n"  // semihosting: the program has ended
        "ldr r1, =0x20026\n"
        "bkpt 0xab\n" ::
            : "r0", "r1", "memory");
    for (;;) {
    }
}

void tell(const char* key, std::uint32_t number) {
    char text[40];
    std::size_t size = 0;
    while (key[size] != '\0') text[size] = key[size], ++size;
    std::uint32_t power = 1'000'000'000;
    while (power > 1 && number < power) power /= 10;
    for (; power > 0; power /= 10) text[size++] = static_cast<char>('0' + number / power % 10);
    tell_bench({text, size});
}

}  // namespace

// Each has a name that the test can look up for the place where it happened.
extern "C" {

[[gnu::noinline]] void provoke_undefined_instruction() { asm volatile("udf #0"); }

[[gnu::noinline]] void provoke_no_coprocessor() { asm volatile("mrc p1, 0, r0, c0, c0, 0" ::: "r0"); }

[[gnu::noinline]] void provoke_unaligned() {
    asm volatile("ldr r0, =0x20000001\n ldrd r2, r3, [r0]" ::: "r0", "r2", "r3");
}

[[gnu::noinline]] void provoke_divide_by_zero() { asm volatile("mov r0, #0\n udiv r1, r1, r0" ::: "r0", "r1"); }

[[gnu::noinline]] void provoke_bad_branch() { asm volatile("mov r0, #0x100\n blx r0" ::: "r0", "lr"); }

[[gnu::noinline]] void provoke_run_in_memory() { asm volatile("ldr r0, =0x20008001\n blx r0" ::: "r0", "lr"); }

[[gnu::noinline]] std::uint32_t provoke_bus_error() { return reg(0x50000000); }

[[gnu::noinline]] void provoke_write_to_code() { reg(0x00008000) = 1; }

[[gnu::noinline]] void provoke_write_beyond_memory() { reg(0x20020000) = 1; }

[[gnu::noinline]] std::uint32_t provoke_stack_overflow(std::uint32_t depth) {
    volatile std::uint32_t kept[16]{};
    kept[depth % 16] = depth;
    return depth == 0xffffffff ? 0 : provoke_stack_overflow(depth + 1) + kept[(depth + 1) % 16];
}

// Over the whole stack in one leap.
[[gnu::noinline]] std::uint8_t provoke_stack_leap() {
    volatile std::uint8_t kept[24'000];
    kept[0] = 1;
    return kept[0];
}

[[gnu::noinline]] void provoke_unexpected_interrupt() {
    enable_irq(20);
    pend_irq(20);
    barrier();
}

[[gnu::noinline]] void provoke_assertion() { port::fail(77); }

[[gnu::noinline]] void provoke_abort() { std::abort(); }

[[gnu::noinline]] void provoke_hang() {
    for (;;) asm volatile("nop");
}

[[gnu::noinline]] void provoke_stopped_timer() { half_timer.control() = 0; }

[[gnu::noinline]] void provoke_reset() { system_reset(); }

void provoke_nothing() {}

}  // extern "C"

namespace {

// What goes wrong in the background, and in the interrupt after the core has done its work.
struct Case {
    void (*in_background)() = provoke_nothing;
    void (*in_half)() = provoke_nothing;
};

std::uint32_t work_until = 0;  // halves that take one and a half of their time

void overrun_once() { work_until = quiet_halves + 1; }
void overrun_always() { work_until = 0xffffffff; }
void ask_nobody() { (void)provoke_bus_error(); }
void leap() { (void)provoke_stack_leap(); }
void overflow() { (void)provoke_stack_overflow(0); }

constexpr Case cases[]{{},
                       {.in_background = provoke_undefined_instruction},
                       {.in_background = provoke_no_coprocessor},
                       {.in_background = provoke_unaligned},
                       {.in_background = provoke_divide_by_zero},
                       {.in_background = provoke_bad_branch},
                       {.in_background = provoke_run_in_memory},
                       {.in_background = ask_nobody},
                       {.in_background = provoke_write_to_code},
                       {.in_background = provoke_write_beyond_memory},
                       {.in_background = overflow},
                       {.in_background = leap},
                       {.in_background = provoke_unexpected_interrupt},
                       {.in_background = provoke_assertion},
                       {.in_background = provoke_abort},
                       {.in_background = provoke_hang},
                       {.in_background = provoke_stopped_timer},
                       {.in_half = provoke_hang},
                       {.in_half = provoke_divide_by_zero},
                       {.in_half = overflow},
                       {.in_half = overrun_once},
                       {.in_half = overrun_always},
                       {.in_background = provoke_reset}};

const Case& chosen() { return cases[reg(0x60800000) % std::size(cases)]; }

void work_for_one_and_a_half() {
    free_timer.reload() = 0xffffffff;
    free_timer.control() = Timer::enable;
    const std::uint32_t start = free_timer.value();
    while (start - free_timer.value() < half_timer.reload() * 3 / 2) {
    }
}

// Sizes and alignments for which memcpy or memset writes other than each byte once.
std::uint32_t memory_errors() {
    constexpr std::size_t room = 160;
    alignas(8) static unsigned char from[room];
    alignas(8) static unsigned char to[room];
    // Through volatile, or the compiler makes calls of the functions under test of these loops too.
    volatile unsigned char* const source = from;
    volatile unsigned char* const target = to;
    std::uint32_t errors = 0;
    for (std::size_t k = 0; k < room; ++k) source[k] = static_cast<unsigned char>(7 * k + 1);
    for (std::size_t at = 0; at < 5; ++at) {
        for (std::size_t n = 0; n + at + 8 < room; ++n) {
            port::kick_watchdog();
            for (const bool fills : {false, true}) {
                for (std::size_t k = 0; k < room; ++k) target[k] = 0xee;
                if (fills)
                    std::memset(to + at, static_cast<int>(n), n);
                else
                    std::memcpy(to + at, from + at % 5, n);
                bool good = true;
                for (std::size_t k = 0; k < room; ++k) {
                    const bool inside = k >= at && k < at + n;
                    const auto written = static_cast<unsigned char>(fills ? n : source[k - at + at % 5]);
                    good = good && target[k] == (inside ? written : 0xee);
                }
                errors += good ? 0u : 1u;
            }
        }
    }
    return errors;
}

[[noreturn]] void tell_and_leave() {
    tell("starts=", port::starts());
    tell("halves=", halves());
    tell("overruns=", port::overruns());
    tell("stack_used_bytes=", port::stack_used_bytes());
    tell("memory_errors=", memory_errors());
    leave();
}

}  // namespace

// The linker leads the half-period here instead.
extern "C" void __real__ZN3zlg8firmware4port7commandERKNS_4core13ActuatorFrameE(const zlg::core::ActuatorFrame&);
extern "C" void __wrap__ZN3zlg8firmware4port7commandERKNS_4core13ActuatorFrameE(
    const zlg::core::ActuatorFrame& actuator) {
    if (halves() == quiet_halves) chosen().in_half();
    if (halves() < work_until) work_for_one_and_a_half();
    __real__ZN3zlg8firmware4port7commandERKNS_4core13ActuatorFrameE(actuator);
}

int main() {
    port::start();
    // In lock step the host is to hear of it.
    const bool alone = !is_in_lock_step();
    const bool is_restart = port::last_fault().kind != FaultKind::none;
    if (is_restart && alone) tell_and_leave();
    port::command(gyro().start(defaults));
    port::start_half_periods(defaults.control.commutator.half_ticks);
    bool done = is_restart;
    for (std::uint32_t seen = halves();;) {
        if (const std::uint32_t now = halves(); now != seen) {
            seen = now;
            port::kick_watchdog();
        }
        if (seen >= quiet_halves && !done) {
            done = true;
            chosen().in_background();
        }
        if (seen >= 8 * quiet_halves && alone) tell_and_leave();
        port::idle();
    }
}
