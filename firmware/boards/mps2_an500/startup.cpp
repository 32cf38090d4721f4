// From reset to main: the floating-point unit, the memory, the vector table.

#include <array>
#include <cstddef>
#include <cstdint>

#include "handlers.hpp"

extern "C" {

// Placed by the linker.
extern std::uint32_t stack_top;
extern std::uint32_t data_begin;
extern std::uint32_t data_end;
extern const std::uint32_t data_load;
extern std::uint32_t bss_begin;
extern std::uint32_t bss_end;
extern void (*const init_array_begin[])();
extern void (*const init_array_end[])();

[[gnu::used]] void fill_memory() {
    const std::uint32_t* from = &data_load;
    for (std::uint32_t* to = &data_begin; to != &data_end; ++to) *to = *from++;
    for (std::uint32_t* to = &bss_begin; to != &bss_end; ++to) *to = 0;
    for (auto* initialise = init_array_begin; initialise != init_array_end; ++initialise) (*initialise)();
}

// The unit is switched on before anything that a compiler has made: that may use its registers for any copy.
[[noreturn, gnu::naked]] void reset() {
    asm volatile(
        "ldr r0, =0xe000ed88\n"  // CPACR: full access to coprocessors 10 and 11
        "ldr r1, [r0]\n"
        "orr r1, r1, #(0xf << 20)\n"
        "str r1, [r0]\n"
        "dsb\n"
        "isb\n"
        "ldr r0, =stack_bottom\n"  // paint the stack
        "ldr r1, =0x5aa5c33c\n"
        "1: str r1, [r0], #4\n"
        "cmp r0, sp\n"
        "blo 1b\n"
        "bl fill_memory\n"
        "bl main\n"
        "b .\n");
}

}  // extern "C"

namespace {

using Handler = void (*)();

constexpr std::size_t n_system = 15;  // after the top of the stack
constexpr std::size_t n_devices = 32;

struct Vectors {
    std::uint32_t* top;
    std::array<Handler, n_system> system;
    std::array<Handler, n_devices> device;
};

using namespace zlg::firmware;

[[gnu::section(".vectors"), gnu::used]] constinit const Vectors vectors{
    &stack_top,
    {reset, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault,
     on_fault, on_fault, on_fault, on_fault},
    {on_uart0_receive, on_fault, on_uart1_receive, on_fault, on_uart2_receive, on_fault, on_fault, on_fault,
     on_half_timer,    on_fault, on_fault,         on_fault, on_fault,         on_fault, on_fault, on_fault,
     on_fault,         on_fault, on_fault,         on_fault, on_fault,         on_fault, on_fault, on_fault,
     on_fault,         on_fault, on_fault,         on_fault, on_fault,         on_fault, on_fault, on_fault}};

}  // namespace
