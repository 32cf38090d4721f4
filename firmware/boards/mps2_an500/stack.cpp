// The stack: what lies below it is forbidden, and what it has used can be seen.

#include <cstdint>

#include <zlg/firmware/port.hpp>

#include "board.hpp"
#include "registers.hpp"

extern "C" {
extern const volatile std::uint32_t stack_bottom[];
extern const volatile std::uint32_t stack_top[];
}

namespace zlg::firmware {
namespace {

using namespace mps2;

// Numbers of the memory protection unit: 2^log2_size bytes from `base`, a multiple of that size.
struct Region {
    std::uint32_t base;
    std::uint32_t log2_size;
    std::uint32_t attributes;
};

constexpr std::uint32_t never_run = 1u << 28;
constexpr std::uint32_t forbidden = 0u << 24 | never_run;
constexpr std::uint32_t read_write = 3u << 24 | 1u << 19 | 3u << 16 | never_run;  // written back from the cache
constexpr std::uint32_t read_and_run = 6u << 24 | 2u << 16;

// Of two that overlap, the later holds. The end of the flash is for settings, which this machine lets the program
// write. What lies below the memory takes a stack that has grown too large.
constexpr Region regions[]{{0x00000000, 29, forbidden},
                           {0x00000000, 18, read_and_run},
                           {0x0003c000, 14, read_write},
                           {0x20000000, 29, forbidden},
                           {0x20000000, 17, read_write}};

}  // namespace

namespace mps2 {

void protect_memory() noexcept {
    for (std::uint32_t k = 0; k < std::size(regions); ++k) {
        protection.number() = k;
        protection.base() = regions[k].base;
        protection.attributes() = regions[k].attributes | (regions[k].log2_size - 1) << 1 | 1u;
    }
    protection.control() = Protection::enable | Protection::rest_by_default;
    barrier();
}

}  // namespace mps2

namespace port {

std::uint32_t stack_used_bytes() noexcept {
    const volatile std::uint32_t* untouched = stack_bottom;
    while (untouched != stack_top && *untouched == stack_paint) ++untouched;
    return static_cast<std::uint32_t>(stack_top - untouched) * sizeof(std::uint32_t);
}

}  // namespace port
}  // namespace zlg::firmware
