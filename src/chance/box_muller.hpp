#pragma once
// Box and Muller's transform of words of 64 random bits, without branches: the compiler makes instructions for two
// words of a loop. The law is that of address.hpp.
//
// The bits of a word: 0 and 1 signs, 2..23 angle, 24..63 radius.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/common/maths_kernels.hpp>

namespace zlg::chance {

inline constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;

// Bits 24..63 of a word as u = (k + 1/2) 2^-40: a unit in the last place of 2^12 is 2^-40.
[[nodiscard]] inline double radius_uniform(std::uint64_t word) noexcept {
    constexpr double base = 0x1p12;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(base) | word >> 24) - (base - 0x1p-41);
}

// Bits 2..23 as t = 2 (j + 1/2) 2^-22 - 1. A unit in the last place of 2^29 is 2^-23, so that they stand where they
// must; the bit below them is the half.
[[nodiscard]] inline double angle_uniform(std::uint64_t word) noexcept {
    constexpr double base = 0x1p29;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(base) | (word & 0xfffffcu) | 2u) - (base + 1.0);
}

// sqrt(-ln u), -ln(2^e m) = -e ln 2 - 2 atanh s, s = (m - 1)/(m + 1). polynomial error 5e-12 of atanh (Chebyshev fit in
// s^2)
[[nodiscard]] inline double root_of_log(double u) noexcept {
    constexpr double ln2 = 0x1.62e42fefa39efp-1;
    const auto [exponent, mantissa] = core::maths::scaled(u);
    const double s = (mantissa - 1.0) / (mantissa + 1.0);
    const double z = s * s;
    const double zz = z * z;
    const double series = (2.0000000000083595 + z * 0.6666666524748752) +
                          zz * ((0.4000038467237519 + z * 0.2853505103781631) + zz * 0.23616359099145984);
    return core::square_root(-exponent * ln2 - s * series);
}

// sin(pi t/4) and cos(pi t/4), |t| < 1. polynomial errors 5e-12 and 7e-11 (Chebyshev fits in t^2)
[[nodiscard]] inline double sine(double t) noexcept {
    const double z = t * t;
    const double zz = z * z;
    return t * ((0.78539816339405 + z * -0.08074551201834942) +
                zz * ((0.002490393210175957 + z * -3.657239263067379e-05) + zz * 3.089966866337448e-07));
}

[[nodiscard]] inline double cosine(double t) noexcept {
    const double z = t * t;
    const double zz = z * z;
    return (0.9999999999524894 + z * -0.30842513515829056) +
           zz * ((0.015854325228444592 + z * -0.00032593858594162623) + zz * 3.5297971342978537e-06);
}

[[nodiscard]] inline double with_sign(double x, std::uint64_t sign) noexcept {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (sign & sign_bit));
}

// Two deviates of each word. Bit 0 is the sign of the first, bit 1 that of the second.
template <std::size_t n> void transform(const std::array<std::uint64_t, n>& words, double* out) noexcept {
    std::array<double, n> radius, sin, cos;
    for (std::size_t i = 0; i < n; ++i) radius[i] = root_of_log(radius_uniform(words[i]));
    for (std::size_t i = 0; i < n; ++i) {
        const double t = angle_uniform(words[i]);
        sin[i] = sine(t);
        cos[i] = cosine(t);
    }
    for (std::size_t i = 0; i < n; ++i) {
        out[2 * i] = with_sign(radius[i] * (cos[i] - sin[i]), words[i] << 63);
        out[2 * i + 1] = with_sign(radius[i] * (cos[i] + sin[i]), words[i] << 62);
    }
}

}  // namespace zlg::chance
