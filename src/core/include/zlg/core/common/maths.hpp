#pragma once
// Elementary functions that give the same bits on every machine: additions, multiplications, divisions, square roots
// and operations on the bits only, each rounded as IEEE 754 says. docs/decisions.md has their errors.

namespace zlg::core {

// A NaN or an infinity is not finite.
[[nodiscard]] constexpr bool is_finite(double x) noexcept { return __builtin_isfinite(x); }

inline constexpr double infinity = __builtin_huge_val();
inline constexpr double not_a_number = __builtin_nan("");

// Correctly rounded on every machine with IEEE arithmetic.
[[nodiscard]] inline double square_root(double x) noexcept { return __builtin_sqrt(x); }

// Angle of the vector (x, y) from the x axis, in turns, 0..1; 0 of the zero vector. accuracy 1e-9 turns for finite x, y
// whose larger one is at least 1e-300 in size.
[[nodiscard]] double turns_of(double x, double y) noexcept;

// As in C, but for errno and the flags of floating point: what annex F of the C standard says of zeros, infinities and
// NaN holds. Every result is less than one unit in its last place from the true value, subnormal results too. The bits
// of a NaN differ between processors.
namespace maths {

struct SinCos {
    double sin = 0.0;
    double cos = 1.0;
};

[[nodiscard]] double exp(double x) noexcept;
[[nodiscard]] double expm1(double x) noexcept;
[[nodiscard]] double log(double x) noexcept;

// Of x radians, however large.
[[nodiscard]] double sin(double x) noexcept;
[[nodiscard]] double cos(double x) noexcept;
[[nodiscard]] SinCos sincos(double x) noexcept;

// Radians.
[[nodiscard]] double atan2(double y, double x) noexcept;
[[nodiscard]] double asin(double x) noexcept;

[[nodiscard]] double tanh(double x) noexcept;
[[nodiscard]] double hypot(double x, double y) noexcept;

}  // namespace maths

}  // namespace zlg::core
