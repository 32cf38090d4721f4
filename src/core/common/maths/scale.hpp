#pragma once
// Powers of two that bring a vector where its squares neither overflow nor vanish.

#include <bit>
#include <cstdint>

namespace zlg::core::maths {

// The exponent's bits, at least 1.
inline std::uint64_t exponent_bits(double x) noexcept {
    const std::uint64_t bits = (std::bit_cast<std::uint64_t>(x) >> 52) & 0x7ffu;
    return bits > 1u ? bits : 1u;
}

// For a finite x: x scale_of(x) lies in 2..4 in size, or below if x is subnormal.
inline double scale_of(double x) noexcept { return std::bit_cast<double>((2047u - exponent_bits(x)) << 52); }

// 2/scale_of(x).
inline double twice_unscale_of(double x) noexcept { return std::bit_cast<double>(exponent_bits(x) << 52); }

}  // namespace zlg::core::maths
