// Where the processor ends when something is wrong with it: the reason is noted, and it begins anew.

#include <array>
#include <cstdint>
#include <cstdlib>

#include <zlg/firmware/fault.hpp>
#include <zlg/firmware/half_period.hpp>
#include <zlg/firmware/port.hpp>

#include "board.hpp"
#include "handlers.hpp"
#include "registers.hpp"

extern "C" {
extern const std::uint32_t stack_bottom[];
extern const std::uint32_t stack_top[];
}

namespace zlg::firmware {
namespace {

using namespace mps2;

// What the processor itself puts on the stack when an exception begins.
struct ExceptionFrame {
    std::array<std::uint32_t, 5> r0_to_r3_r12;
    std::uint32_t lr;
    std::uint32_t pc;
    std::uint32_t psr;
};

constexpr std::uint32_t nmi = 2;
constexpr std::uint32_t hard_fault = 3;
// Entering the handler has failed: there is no frame.
constexpr std::uint32_t not_stacked = (1u << 4) | (1u << 12);

// Not cleared by a reset. The start counter is kept twice, once inverted, to know it from random memory.
[[gnu::section(".kept")]] FaultRecord kept;
[[gnu::section(".kept")]] std::uint32_t kept_starts;
[[gnu::section(".kept")]] std::uint32_t kept_starts_inverted;

// Of this start.
FaultRecord last;

std::uint32_t number(const void* address) noexcept { return reinterpret_cast<std::uint32_t>(address); }

FaultKind kind_of_exception(std::uint32_t exception, std::uint32_t sp, std::uint32_t cfsr) noexcept {
    if (exception == nmi) return is_half_period_alive() ? FaultKind::background_hung : FaultKind::half_period_hung;
    if (exception != hard_fault) return FaultKind::unexpected_interrupt;
    const FaultKind kind = kind_of(cfsr);
    // An access beyond the stack, from a stack that has grown there.
    const bool is_outside = sp < number(stack_bottom) + sizeof(ExceptionFrame);
    return kind == FaultKind::forbidden_address && is_outside ? FaultKind::stack_overflow : kind;
}

[[noreturn]] void restart_with(const FaultRecord& record) noexcept {
    kept = seal(record);
    barrier();
    system_reset();
}

// The call, four bytes long, ends where it would return to.
[[noreturn]] void stop_at(const void* return_address, std::uint32_t detail) noexcept {
    restart_with({.kind = FaultKind::assertion,
                  .pc = (number(return_address) & ~1u) - 4,
                  .detail = detail,
                  .halves = halves(),
                  .overruns = port::overruns()});
}

}  // namespace

extern "C" {

// frame  what the processor has put on the stack, if it could. The memory protection is off in the handler of a hard
// fault.
[[noreturn, gnu::used]] void note_fault(const ExceptionFrame* frame, std::uint32_t exception) {
    // The registers of the floating-point unit wait to be stored where there may be no memory: they are not needed.
    fpccr() &= ~1u;
    const std::uint32_t sp = number(frame);
    const std::uint32_t cfsr = fault_status();
    FaultRecord record{
        .kind = kind_of_exception(exception, sp, cfsr), .sp = sp, .cfsr = cfsr, .hfsr = hard_fault_status()};
    const bool is_there = sp >= number(stack_bottom) && sp <= number(stack_top) - sizeof(ExceptionFrame);
    if (is_there && (cfsr & not_stacked) == 0) {
        record.pc = frame->pc;
        record.lr = frame->lr;
    }
    record.address = address_of(cfsr, forbidden_address(), bus_fault_address());
    record.detail = exception;
    record.halves = halves();
    record.overruns = port::overruns();
    restart_with(record);
}

// Whatever the C library cannot go on from ends here.
[[noreturn]] void abort() { zlg::firmware::stop_at(__builtin_return_address(0), 0); }

}  // extern "C"

// A stack that has overflowed is no stack for the handler: it then begins again at the top, where nothing is needed any
// more.
[[gnu::naked]] void on_fault() {
    asm volatile(
        "mrs r0, msp\n"
        "mrs r1, ipsr\n"
        "ldr r2, =stack_bottom + 512\n"
        "cmp r0, r2\n"
        "it lo\n"
        "ldrlo sp, =stack_top\n"
        "b note_fault\n");
}

namespace mps2 {

void recall_fault() noexcept {
    const bool has_kept = kept_starts_inverted == ~kept_starts;
    last = has_kept ? FaultRecord{.kind = FaultKind::reset} : FaultRecord{};
    if (has_kept && is_sound(kept)) last = kept;
    kept.sum = ~kept.sum;
    kept_starts = has_kept ? kept_starts + 1 : 1;
    kept_starts_inverted = ~kept_starts;
}

}  // namespace mps2

namespace port {

void fail(std::uint32_t detail) noexcept { stop_at(__builtin_return_address(0), detail); }
const FaultRecord& last_fault() noexcept { return last; }
std::uint32_t starts() noexcept { return kept_starts; }

}  // namespace port
}  // namespace zlg::firmware
