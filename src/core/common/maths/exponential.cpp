// Exponential, and the functions that are made of it.

#include <zlg/core/common/maths.hpp>

#include "common/maths/double_double.hpp"
#include "common/maths/exp_parts.hpp"

namespace zlg::core::maths {
namespace {

// x, brought between the limits; NaN stays.
double clamped(double x, double least, double greatest) noexcept {
    const double below = x > greatest ? greatest : x;
    return below < least ? least : below;
}

}  // namespace

// Beyond the limits the result is an infinity or zero as well.
double exp(double x) noexcept { return value_of(exp_parts(clamped(x, -760.0, 720.0), 0.0)); }

// Halved, so that no power of two overflows before the result does. The lower part is up to a tenth of the upper one.
Sum half_expm1(double x) noexcept {
    const ExpParts parts = exp_parts(x, 0.0);
    const double half_power = power_of_two(parts.exponent - 1u);
    const auto [high, low] = exact_sum(half_power * parts.mantissa.high, -0.5);
    return {high, low + half_power * parts.mantissa.low};
}

// Below -60 the result is -1 rounded, above 709.9 infinite.
double expm1(double x) noexcept {
    const auto [high, low] = half_expm1(clamped(x, -60.0, 709.9));
    const double result = 2.0 * (high + low);
    return __builtin_fabs(x) < 0x1p-54 ? x : result;
}

// h/(1 + h), h = (e^(2|x|) - 1)/2. Above 22 the result is 1 rounded.
double tanh(double x) noexcept {
    const double size = __builtin_fabs(x);
    const Sum half = half_expm1(clamped(2.0 * size, 0.0, 44.0));
    const Sum h = sum_of(half.high, half.low);
    const Sum one_more = exact_sum(1.0, h.high);
    const Sum ratio = quotient_of(h, {one_more.high, one_more.low + h.low});
    const double result = __builtin_copysign(ratio.high + ratio.low, x);
    return size < 0x1p-28 ? x : result;
}

}  // namespace zlg::core::maths
