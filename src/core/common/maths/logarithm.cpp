// Logarithms of x and of 1 + x.

#include <zlg/core/common/maths.hpp>

#include "common/maths/double_double.hpp"

namespace zlg::core::maths {
namespace {

constexpr double not_a_number = __builtin_nan("");

// Where there is no usual path: x is zero, negative, infinite or NaN.
double special_log(double x) noexcept {
    if (x == 0.0) return -infinity;
    return x > 0.0 ? x : (x < 0.0 ? not_a_number : x + x);
}

}  // namespace

double log(double x) noexcept {
    if (!(x > 0.0 && x < infinity)) return special_log(x);
    if (x >= 0x1p-1022) return log_kernel(x);
    const auto [high, low] = log_parts(x * 0x1p54);
    const Sum sum = sum_of(high, -54.0 * ln2_high);
    return sum.high + (sum.low + (low - 54.0 * ln2_low));
}

// ln(u) + c/u, where u is 1 + x rounded and c what the rounding took.
double log1p(double x) noexcept {
    if (!(x > -1.0 && x < infinity)) return x == -1.0 ? -infinity : special_log(x);
    const auto [u, c] = exact_sum(1.0, x);
    const auto [high, low] = log_parts(u);
    const double result = high + (low + c / u);
    return __builtin_fabs(x) < 0x1p-54 ? x : result;
}

}  // namespace zlg::core::maths
