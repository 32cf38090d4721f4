// Length of a vector of two coordinates.

#include <zlg/core/common/maths.hpp>

#include "common/maths/double_double.hpp"
#include "common/maths/scale.hpp"

namespace zlg::core::maths {

// The squares of the heads are exact and their sum is; only sum, root and, where it is subnormal, the result are
// rounded.
double hypot(double x, double y) noexcept {
    const double across = __builtin_fabs(x);
    const double up = __builtin_fabs(y);
    if (across == infinity || up == infinity) return infinity;
    if (x != x || y != y) return x + y;
    const double larger = up > across ? up : across;
    const double scale = scale_of(larger);
    const double a = larger * scale;
    const double b = (up > across ? across : up) * scale;
    const double a_head = head_of(a);
    const double b_head = head_of(b);
    const auto [high, low] = sum_of(a_head * a_head, b_head * b_head);
    const double tails = (a - a_head) * (a + a_head) + (b - b_head) * (b + b_head);
    return 0.5 * square_root(high + (low + tails)) * twice_unscale_of(larger);
}

}  // namespace zlg::core::maths
