#pragma once
// The usual path of logarithm, sine and cosine, without branches and special values: for loops that the compiler makes
// vectors of, and for maths.hpp. The same bits on every machine, if the compiler fuses no multiplication with an
// addition
// (-ffp-contract=off, which zlg::core passes on): +, -, *, / and operations on the bits alone.
//
// The coefficients are minimax fits in doubles (Sollya's fpminimax, relative error); each polynomial says how far it is
// off.

#include <bit>
#include <cstdint>

#include <zlg/core/common/maths.hpp>

namespace zlg::core::maths {

// A number as the unevaluated sum of two doubles, the second below a unit in the last place of the first or so.
struct Sum {
    double high = 0.0;
    double low = 0.0;
};

// Adding it to a number of up to 2^51 in size leaves the nearest whole number in the lowest bits of the sum;
// subtracting it again leaves that number.
inline constexpr double to_whole = 0x1.8p52;

inline constexpr double ln2_high = 0x1.62e42fefa38p-1;  // 42 bits: its product with an exponent is exact
inline constexpr double ln2_low = 0x1.ef35793c7673p-45;

// 26 leading bits of x, so that the square is exact.
[[nodiscard]] inline double head_of(double x) noexcept {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0xfffffffff8000000u);
}

// a + b exactly, for |a| >= |b| or a = 0 (Dekker's fast two-sum).
[[nodiscard]] inline Sum sum_of(double a, double b) noexcept {
    const double high = a + b;
    return {high, (a - high) + b};
}

// x = 2^exponent mantissa, sqrt(1/2) <= mantissa < sqrt(2), of a normal positive x.
struct Scaled {
    double exponent = 0.0;
    double mantissa = 1.0;
};

[[nodiscard]] inline Scaled scaled(double x) noexcept {
    constexpr std::uint64_t root_half = std::bit_cast<std::uint64_t>(0x1.6a09e667f3bcdp-1);
    constexpr std::uint64_t bias = std::uint64_t{1023} << 52;
    const std::uint64_t biased = std::bit_cast<std::uint64_t>(x) + (bias - root_half);
    const std::uint64_t exponent = (biased >> 52) | std::bit_cast<std::uint64_t>(0x1p52);
    return {.exponent = std::bit_cast<double>(exponent) - (0x1p52 + 1023.0),
            .mantissa = std::bit_cast<double>((biased & 0x000fffffffffffffu) + root_half)};
}

// ln x as a sum, for a normal positive x: ln(1 + f) = 2 atanh(s), s = f/(2 + f), where 2 s = f - s f and
// s f = (f^2/2)(1 - s), so that what is rounded is small beside f.
// polynomial error 2^-51 of the terms behind 2 s, which are at most 0.01 of it
[[nodiscard]] inline Sum log_parts(double x) noexcept {
    const auto [k, m] = scaled(x);
    const double f = m - 1.0;
    const double s = f / (2.0 + f);
    const double z = s * s;
    const double zz = z * z;
    const double odd = 0x1.9999999995321p-2 + zz * (0x1.c71c62e62a529p-3 + zz * 0x1.39fe57d2513a1p-3);
    const double even =
        0x1.5555555555558p-1 + zz * (0x1.2492492def064p-2 + zz * (0x1.7462b4c5f6f18p-3 + zz * 0x1.2b58d77a44819p-3));
    const double half_square = 0.5 * f * f;
    const double of_s = s * (half_square + z * (even + z * odd));
    const auto [high, low] = sum_of(k * ln2_high, f);
    return {high, low - (half_square - (of_s + k * ln2_low))};
}

// Sine and cosine of a + rest radians, |a| <= pi/4 and |rest| within a unit in the last place of a.
// polynomial errors 2^-52 and 2^-54 of the terms behind a and 1 - a^2/2
[[nodiscard]] inline SinCos sincos_near_zero(double a, double rest) noexcept {
    const double z = a * a;
    const double zz = z * z;
    const double of_sin = (-0x1.5555555555555p-3 + z * 0x1.1111111110c77p-7) +
                          zz * ((-0x1.a01a019e9e3cfp-13 + z * 0x1.71de37ae2535ep-19) +
                                zz * (-0x1.ae601d72be3c5p-26 + z * 0x1.5e105af151d9ap-33));
    const double of_cos = (0x1.5555555555555p-5 + z * -0x1.6c16c16c168c9p-10) +
                          zz * ((0x1.a01a019f37ebfp-16 + z * -0x1.27e4fa0275783p-22) +
                                zz * (0x1.1eeb57599cfe8p-29 + z * -0x1.90732aa61f99fp-37));
    const double half = 0.5 * z;
    const double begun = 1.0 - half;
    return {.sin = a + (a * z * of_sin + rest * begun),
            .cos = begun + (((1.0 - begun) - half) + (zz * of_cos - a * rest))};
}

// Sine and cosine, of which those of the angle less `quadrant` right angles are given; only the two lowest bits count.
[[nodiscard]] inline SinCos in_quadrant(const SinCos& rest, std::uint64_t quadrant) noexcept {
    const auto sin = std::bit_cast<std::uint64_t>(rest.sin);
    const auto cos = std::bit_cast<std::uint64_t>(rest.cos);
    const std::uint64_t exchanged = (sin ^ cos) & (0u - (quadrant & 1u));
    return {.sin = std::bit_cast<double>(sin ^ exchanged ^ ((quadrant & 2u) << 62)),
            .cos = std::bit_cast<double>(cos ^ exchanged ^ (((quadrant + 1u) & 2u) << 62))};
}

// 2 pi (head + tail) radians as a sum: head, of 26 bits, multiplies exactly.
[[nodiscard]] inline Sum radians_of(double head, double tail) noexcept {
    constexpr double two_pi = 0x1.921fb54442d18p+2;
    constexpr double two_pi_high = 0x1.921fb5p+2;  // 26 bits
    constexpr double two_pi_low = 0x1.110b4611a6263p-24;
    return sum_of(head * two_pi_high, head * two_pi_low + tail * two_pi);
}

// Sine and cosine of t turns, |t| <= 2^48. accuracy 0.9 units in the last place for |t| >= 2^-900; a zero has either
// sign
//
// The quarter turns are taken off exactly.
[[nodiscard]] inline SinCos sincos_turns_kernel(double t) noexcept {
    const double shifted = 4.0 * t + to_whole;
    const double r = t - 0.25 * (shifted - to_whole);
    const double head = head_of(r);
    const auto [angle, rest] = radians_of(head, r - head);
    return in_quadrant(sincos_near_zero(angle, rest), std::bit_cast<std::uint64_t>(shifted));
}

}  // namespace zlg::core::maths
