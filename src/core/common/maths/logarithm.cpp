// Natural logarithm.

#include <zlg/core/common/maths.hpp>

#include "common/maths/double_double.hpp"

namespace zlg::core::maths {
namespace {

// Where there is no usual path: x is zero, negative, infinite or NaN.
double special_log(double x) noexcept {
    if (x == 0.0) return -infinity;
    return x > 0.0 ? x : (x < 0.0 ? not_a_number : x + x);
}

}  // namespace

double log(double x) noexcept {
    if (!(x > 0.0 && x < infinity)) return special_log(x);
    const bool is_subnormal = x < 0x1p-1022;
    const auto [high, low] = log_parts(is_subnormal ? x * 0x1p54 : x);
    if (!is_subnormal) return high + low;
    const Sum sum = sum_of(high, -54.0 * ln2_high);
    return sum.high + (sum.low + (low - 54.0 * ln2_low));
}

}  // namespace zlg::core::maths
