#pragma once
// The counter of an address: the layout that address.hpp describes.

#include <cassert>
#include <cstdint>

#include <zlg/chance/address.hpp>

#include "philox.hpp"

namespace zlg::chance {

inline constexpr std::uint32_t of_bits = 0;
inline constexpr std::uint32_t of_normals = 0x80000000u;

[[nodiscard]] inline Counter counter_of(const Address& a, std::uint32_t kind, std::uint32_t block) noexcept {
    assert(a.half >> 48 == 0);
    const auto upper = static_cast<std::uint32_t>(a.half >> 32) & 0xffffu;
    return {kind | block, a.gyro, static_cast<std::uint32_t>(a.half),
            std::uint32_t{static_cast<std::uint16_t>(a.cause)} << 16 | upper};
}

}  // namespace zlg::chance
