// The reset of a Cortex-M7 in the emulator, for bench/maths_bits: newlib's start needs a stack and the unit of floating
// point.

#include <cstdint>

extern "C" void _start();

namespace {

void reset() {
    auto* const access_to_coprocessors = reinterpret_cast<volatile std::uint32_t*>(0xe000ed88u);
    *access_to_coprocessors = 0x00f00000u;
    asm volatile("dsb\nisb");
    _start();
}

struct Vectors {
    std::uintptr_t stack;
    void (*reset)();
};

// At address 0, where the processor looks for them; the stack goes down from the end of the board's memory of 4 MB.
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors{0x00400000u, reset};

}  // namespace
