// Sine and cosine of radians.

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

}  // namespace zlg::core::maths
