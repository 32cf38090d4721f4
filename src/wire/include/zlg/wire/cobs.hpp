#pragma once
// Consistent Overhead Byte Stuffing (Cheshire and Baker, 1999): bytes without a zero, so that a zero ends a frame.
//
// A receiver that has lost its place finds it again at the next zero, whatever was before.

#include <cstddef>
#include <cstdint>
#include <span>

namespace zlg::wire {

// What n bytes become at most.
[[nodiscard]] constexpr std::size_t stuffed_bytes(std::size_t n) noexcept { return n + n / 254 + 1; }

// The stuffed bytes, without a zero that ends them.
//
// out     at least stuffed_bytes(bytes.size()); not the same memory.
// return  how many were written.
[[nodiscard]] std::size_t stuff(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> out) noexcept;

struct Unstuffed {
    bool good = false;  // no zero inside, no block that reaches beyond the end
    std::size_t size = 0;
};

// The reverse, in place.
[[nodiscard]] Unstuffed unstuff(std::span<std::uint8_t> bytes) noexcept;

}  // namespace zlg::wire
