#pragma once
// Elementary functions that give the same bits on every machine: additions, multiplications and divisions only.

namespace zlg::core {

// A NaN or an infinity is not finite.
[[nodiscard]] constexpr bool is_finite(double x) noexcept { return __builtin_isfinite(x); }

inline constexpr double infinity = __builtin_huge_val();

// Correctly rounded on every machine with IEEE arithmetic.
[[nodiscard]] inline double square_root(double x) noexcept { return __builtin_sqrt(x); }

// Natural logarithm. accuracy 2 units in the last place for 0 < x < infinity; -infinity at 0, NaN below.
[[nodiscard]] double natural_log(double x) noexcept;

// Exponential. accuracy 2 units in the last place; 0 below -708, infinity above 709.
[[nodiscard]] double exponential(double x) noexcept;

// Angle of the vector (x, y) from the x axis, in turns, 0..1; 0 of the zero vector. accuracy 1e-9 turns for finite x, y
// whose larger one is at least 1e-300 in size.
[[nodiscard]] double turns_of(double x, double y) noexcept;

}  // namespace zlg::core
