#pragma once
// The exponential as mantissa and power of two, for exp, expm1 and tanh.

#include <bit>
#include <cstdint>

#include <zlg/core/common/maths_kernels.hpp>

namespace zlg::core::maths {

// 2^exponent (mantissa.high + mantissa.low); the exponent is a whole number modulo 2^64.
struct ExpParts {
    Sum mantissa;
    std::uint64_t exponent = 0;
};

// 2^k as a double, -1022 <= k <= 1023 modulo 2^64.
inline double power_of_two(std::uint64_t k) noexcept { return std::bit_cast<double>((k + 1023u) << 52); }

// e^(x + rest), |x| <= 800 and |rest| within a unit in the last place of x: 1 + r + r^2/2 + r^3 P(r), r = x - k ln 2.
// Up to r^2/2, of the head of r, nothing is lost. polynomial error 2^-53 of r^3 P(r), which is at most 0.01 of the
// whole
inline ExpParts exp_parts(double x, double rest) noexcept {
    constexpr double one_over_ln2 = 0x1.71547652b82fep+0;
    const double shifted = x * one_over_ln2 + to_whole;
    const double k = shifted - to_whole;
    const auto [r, r_low] = sum_of(x - k * ln2_high, rest - k * ln2_low);
    const double z = r * r;
    const double first =
        (0x1.5555555555556p-3 + r * 0x1.5555555555554p-5) + z * (0x1.1111111110702p-7 + r * 0x1.6c16c16c17a08p-10);
    const double second =
        (0x1.a01a01a90aebfp-13 + r * 0x1.a01a019c4abd5p-16) + z * (0x1.71de0a17cd59p-19 + r * 0x1.27e4f829cc2a7p-22);
    const double third = 0x1.af3f631f2f3cdp-26 + r * 0x1.1f3e72e133ep-29;
    const double head = head_of(r);
    const Sum begun = sum_of(1.0, r);
    const Sum mantissa = sum_of(begun.high, 0.5 * head * head);
    const double of_square = r_low * mantissa.high + 0.5 * (r - head) * (r + head);
    const double of_cube = r * z * (first + z * z * (second + z * z * third));
    return {.mantissa = {mantissa.high, (begun.low + mantissa.low) + (of_square + of_cube)},
            .exponent = std::bit_cast<std::uint64_t>(shifted) - std::bit_cast<std::uint64_t>(to_whole)};
}

// The double next to them, for exponents of +-1200: two factors, of which only the second rounds, overflows or
// underflows.
inline double value_of(const ExpParts& parts) noexcept {
    const std::uint64_t half = ((parts.exponent + 2048u) >> 1) - 1024u;
    return (parts.mantissa.high + parts.mantissa.low) * power_of_two(half) * power_of_two(parts.exponent - half);
}

// (e^x - 1)/2 as a sum, for -60 <= x < 710.
Sum half_expm1(double x) noexcept;

}  // namespace zlg::core::maths
