#pragma once
// The exponential as mantissa and power of two, for exp, expm1, pow and tanh.

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

// e^(x + rest), |x| <= 800 and |rest| within a unit in the last place of x: 1 + r + r^2 P(r), r = x - k ln 2. Of 1 + r
// nothing is lost. polynomial error 2^-58 of the terms behind 1 + r
inline ExpParts exp_parts(double x, double rest) noexcept {
    constexpr double one_over_ln2 = 0x1.71547652b82fep+0;
    const double shifted = x * one_over_ln2 + to_whole;
    const double k = shifted - to_whole;
    const Sum r = sum_of(x - k * ln2_high, rest - k * ln2_low);
    const double z = r.high * r.high;
    const double zz = z * z;
    const double first =
        (0.5 + r.high * 0x1.5555555555557p-3) + z * (0x1.5555555555552p-5 + r.high * 0x1.1111111110046p-7);
    const double second = (0x1.6c16c16c1893bp-10 + r.high * 0x1.a01a01ac26ef3p-13) +
                          z * (0x1.a01a0197bce78p-16 + r.high * 0x1.71de018a576b9p-19);
    const double third = 0x1.27e500ced4232p-22 + r.high * 0x1.af4f1b79bfd6cp-26 + z * 0x1.1f332fa1118fp-29;
    const auto [high, low] = sum_of(1.0, r.high);
    return {.mantissa = {high, low + (r.low * high + z * (first + zz * (second + zz * third)))},
            .exponent = std::bit_cast<std::uint64_t>(shifted) - std::bit_cast<std::uint64_t>(to_whole)};
}

// The double next to them, for exponents of +-1200: two factors, of which only the second rounds, overflows or underflows.
inline double value_of(const ExpParts& parts) noexcept {
    const std::uint64_t half = ((parts.exponent + 2048u) >> 1) - 1024u;
    return (parts.mantissa.high + parts.mantissa.low) * power_of_two(half) * power_of_two(parts.exponent - half);
}

// (e^x - 1)/2 as a sum, for -60 <= x < 710.
Sum half_expm1(double x) noexcept;

}  // namespace zlg::core::maths
