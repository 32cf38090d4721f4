// Sine and cosine of radians and of turns.

#include <bit>
#include <cstdint>

#include <zlg/core/common/maths.hpp>

#include "common/maths/double_double.hpp"
#include "common/maths/reduction.hpp"

namespace zlg::core::maths {
namespace {

// x less the nearest multiple of a right angle, |x| <= 2^23 (Cody and Waite's reduction): pi/2 in three parts of 30
// bits, whose multiples are exact, and the rest.
Reduced reduced_moderate(double x) noexcept {
    constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
    const double shifted = x * two_over_pi + to_whole;
    const double k = shifted - to_whole;
    const Sum first = exact_sum(x - k * 0x1.921fb54p+0, -k * 0x1.10b46118p-30);
    const Sum second = exact_sum(first.high, -k * 0x1.313198ap-61);
    const double low = (second.low + first.low) - k * 0x1.701b839a25205p-92;
    return {.angle = sum_of(second.high, low), .quadrant = std::bit_cast<std::uint64_t>(shifted)};
}

}  // namespace

SinCos sincos(double x) noexcept {
    const double size = __builtin_fabs(x);
    if (!(size < infinity)) return {x - x, x - x};
    const auto [angle, quadrant] = size <= 0x1p23 ? reduced_moderate(x) : reduced_large(x);
    const SinCos result = in_quadrant(sincos_near_zero(angle.high, angle.low), quadrant);
    return {.sin = size < 0x1p-27 ? x : result.sin, .cos = result.cos};
}

double sin(double x) noexcept { return sincos(x).sin; }
double cos(double x) noexcept { return sincos(x).cos; }

// From 2^52 on every number is whole. Of the others multiples of 2^20 are taken off exactly. The sine of the least is
// proportional to them, and is computed where nothing is subnormal.
SinCos sincos_turns(double t) noexcept {
    const double size = __builtin_fabs(t);
    const double limited = size < 0x1p53 ? t : t - t;
    const double rest = limited - 0x1p20 * ((limited * 0x1p-20 + to_whole) - to_whole);
    const bool is_tiny = size < 0x1p-500;
    const SinCos result = sincos_turns_kernel(is_tiny ? t * 0x1p300 : rest);
    const double sin = is_tiny ? result.sin * 0x1p-300 : result.sin;
    return {.sin = sin == 0.0 ? __builtin_copysign(0.0, t) : sin, .cos = result.cos == 0.0 ? 0.0 : result.cos};
}

double sin_turns(double t) noexcept { return sincos_turns(t).sin; }
double cos_turns(double t) noexcept { return sincos_turns(t).cos; }

}  // namespace zlg::core::maths
