// Reduction of large angles (Payne and Hanek 1983): x/(2 pi) modulo 1, of those digits of 1/(2 pi) that count.

#include "common/maths/reduction.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace zlg::core::maths {
namespace {

// A fraction of a turn in digits of 32 bits, the first of weight 2^-32.
using Digits = std::array<std::uint32_t, 6>;

// 1/(2 pi), after 32 zeros.
constexpr std::uint32_t one_over_two_pi[38] = {
    0x00000000u, 0x28be60dbu, 0x9391054au, 0x7f09d5f4u, 0x7d4d3770u, 0x36d8a566u, 0x4f10e410u, 0x7f9458eau,
    0xf7aef158u, 0x6dc91b8eu, 0x909374b8u, 0x01924bbau, 0x82746487u, 0x3f877ac7u, 0x2c4a69cfu, 0xba208d7du,
    0x4baed121u, 0x3a671c09u, 0xad17df90u, 0x4e64758eu, 0x60d4ce7du, 0x272117e2u, 0xef7e4a0eu, 0xc7fe25ffu,
    0xf7816603u, 0xfbcbc462u, 0xd6829b47u, 0xdb4d9fb3u, 0xc9f2c26du, 0xd3d18fd9u, 0xa797fa8bu, 0x5d49eeb1u,
    0xfaf97c5eu, 0xcf41ce7du, 0xe294a4bau, 0x9afed7ecu, 0x47e35742u, 0x1580cc11u,
};

// 2^exponent/(2 pi) modulo 1, cut after 192 bits, for exponent >= -32.
Digits fraction_from(int exponent) noexcept {
    const auto from = static_cast<unsigned>(exponent + 32);
    Digits digits{};
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const std::uint32_t* pair = one_over_two_pi + from / 32u + i;
        const std::uint64_t both = (std::uint64_t{pair[0]} << 32) | pair[1];
        digits[i] = static_cast<std::uint32_t>((both << (from % 32u)) >> 32);
    }
    return digits;
}

// digits times factor modulo 1, by long multiplication.
Digits times(const Digits& digits, std::uint64_t factor) noexcept {
    Digits product{};
    const std::uint64_t parts[2] = {factor & 0xffffffffu, factor >> 32};
    for (std::size_t part = 0; part < 2; ++part) {
        std::uint64_t carry = 0;
        for (std::size_t i = digits.size() - part; i-- > 0;) {
            carry += product[i] + parts[part] * digits[i + part];
            product[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
    }
    return product;
}

// Turns, below 1/2 in size. The first three digits and what they leave are added without loss.
Sum value_of(const Digits& d) noexcept {
    const double tail = d[3] * 0x1p-128 + (d[4] * 0x1p-160 + d[5] * 0x1p-192);
    const Sum third = sum_of(d[2] * 0x1p-96, tail);
    const Sum first = sum_of(d[0] * 0x1p-32, d[1] * 0x1p-64);
    const auto [high, low] = sum_of(first.high, first.low + third.high);
    return {high, low + third.low};
}

}  // namespace

Reduced reduced_large(double x) noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t mantissa = (bits & 0x000fffffffffffffu) | 0x0010000000000000u;
    const int exponent = static_cast<int>((bits >> 52) & 0x7ffu) - 1075;
    Digits turns = times(fraction_from(exponent), mantissa);
    const std::uint32_t quarters = (turns[0] + 0x20000000u) >> 30;
    turns[0] -= quarters << 30;
    // A negative rest is the complement of a positive one, to the last of 192 bits.
    const bool is_below = turns[0] >= 0x80000000u;
    if (is_below)
        for (std::uint32_t& digit : turns) digit = ~digit;
    const Sum rest = value_of(turns);
    const double head = head_of(rest.high);
    Sum angle = radians_of(head, (rest.high - head) + rest.low);
    const bool is_negative = (bits >> 63) != 0;
    if (is_below != is_negative) angle = {-angle.high, -angle.low};
    return {.angle = angle, .quadrant = is_negative ? 0u - std::uint64_t{quarters} : quarters};
}

}  // namespace zlg::core::maths
