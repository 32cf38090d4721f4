// Powers: x^y = e^(y ln x), with the logarithm to 2^-65 of itself.

#include <bit>
#include <cstdint>

#include <zlg/core/common/maths.hpp>

#include "common/maths/double_double.hpp"
#include "common/maths/exp_parts.hpp"

namespace zlg::core::maths {
namespace {

// ln x of a positive finite x: k ln 2 + 2 s + s z (2/3 + z P(z)), s = (m - 1)/(m + 1), z = s^2, where only z P(z), 0.02 of
// what it is added to, is computed in single doubles. polynomial error 2^-54 of it
Sum precise_log(double x) noexcept {
    constexpr Sum two_thirds{0x1.5555555555555p-1, 0x1.5555555555555p-55};
    const bool is_subnormal = x < 0x1p-1022;
    const auto [exponent, m] = scaled(is_subnormal ? x * 0x1p54 : x);
    const double k = is_subnormal ? exponent - 54.0 : exponent;
    const Sum s = quotient_of({m - 1.0, 0.0}, exact_sum(m, 1.0));
    const Sum z = product_of(s, s);
    const double t = z.high;
    const double tt = t * t;
    const double first =
        (0x1.999999999999ap-2 + t * 0x1.24924924922fbp-2) + tt * (0x1.c71c71c74d6acp-3 + t * 0x1.745d173c1370fp-3);
    const double second =
        (0x1.3b13aa1eb5f1ep-3 + t * 0x1.111540545fdccp-3) + tt * (0x1.e01cc783f929ep-4 + t * 0x1.da841491a7b9ap-4);
    const auto [factor, factor_low] = sum_of(two_thirds.high, t * (first + tt * tt * second));
    const Sum behind = product_of(product_of(s, z), {factor, factor_low + two_thirds.low});
    const Sum of_mantissa = sum_of(2.0 * s.high, behind.high);
    const Sum sum = sum_of(k * ln2_high, of_mantissa.high);
    return sum_of(sum.high, sum.low + (k * ln2_low + (of_mantissa.low + (2.0 * s.low + behind.low))));
}

// x^y for positive finite x and finite y. Beyond 800 in size the product decides alone, and beyond 2^70 so does y.
double positive_power(double x, double y) noexcept {
    const double limited = __builtin_fabs(y) > 0x1p70 ? __builtin_copysign(0x1p70, y) : y;
    const auto [high, low] = product_of(precise_log(x), {limited, 0.0});
    const bool is_beyond = __builtin_fabs(high) > 800.0;
    return value_of(exp_parts(is_beyond ? __builtin_copysign(800.0, high) : high, is_beyond ? 0.0 : low));
}

enum class Kind { fraction, even, odd };

Kind kind_of(double y) noexcept {
    const double size = __builtin_fabs(y);
    if (size >= 0x1p53) return Kind::even;
    const double shifted = size < 0x1p52 ? size + 0x1p52 : size;
    if (size < 0x1p52 && shifted - 0x1p52 != size) return Kind::fraction;
    return (std::bit_cast<std::uint64_t>(shifted) & 1u) != 0 ? Kind::odd : Kind::even;
}

// x or y is infinite or x is zero; neither is NaN: the size of the result.
double limit_of(double size, double y) noexcept {
    if (size == 1.0) return 1.0;
    return (size > 1.0) == (y > 0.0) ? infinity : 0.0;
}

}  // namespace

double pow(double x, double y) noexcept {
    if (x == 1.0 || y == 0.0) return 1.0;
    if (x != x || y != y) return x + y;
    const double size = __builtin_fabs(x);
    const bool is_usual = size > 0.0 && is_finite(size) && is_finite(y);
    const double result = is_usual ? positive_power(size, y) : limit_of(size, y);
    if (__builtin_copysign(1.0, x) > 0.0) return result;
    const Kind kind = kind_of(y);
    if (kind == Kind::fraction && is_usual) return not_a_number;
    return kind == Kind::odd ? -result : result;
}

}  // namespace zlg::core::maths
