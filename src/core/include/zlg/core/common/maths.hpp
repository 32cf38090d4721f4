#pragma once
// Elementary functions that give the same bits on every machine: additions, multiplications and divisions only.

#include <cstddef>
#include <cstdint>

namespace zlg::core {

// A whole number, rounded once. In two parts where no instruction takes 64 bits: the sum is what rounds.
[[nodiscard]] constexpr double as_double(std::int64_t x) noexcept {
    if constexpr (sizeof(std::size_t) >= sizeof(x)) return static_cast<double>(x);
    const auto high = static_cast<std::int32_t>(x >> 32);
    const auto low = static_cast<std::uint32_t>(x);
    return high * 0x1p32 + low;
}

// A NaN or an infinity is not finite.
[[nodiscard]] constexpr bool is_finite(double x) noexcept { return __builtin_isfinite(x); }

inline constexpr double infinity = __builtin_huge_val();

// Correctly rounded on every machine with IEEE arithmetic.
[[nodiscard]] inline double square_root(double x) noexcept { return __builtin_sqrt(x); }

// Natural logarithm. accuracy 2 units in the last place for 0 < x < infinity; -infinity at 0, NaN below.
[[nodiscard]] double natural_log(double x) noexcept;

// Exponential. accuracy 2 units in the last place; 0 below -708, infinity above 709.
[[nodiscard]] double exponential(double x) noexcept;

}  // namespace zlg::core
