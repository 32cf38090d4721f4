// The angle of a vector in turns, as good as the counter's fraction needs it.

#include <zlg/core/common/maths.hpp>

namespace zlg::core {

// The octant by the signs and the larger coordinate, half of it by tan(a - pi/4) = (q - 1)/(q + 1): the series is left
// with |q| <= tan(pi/8).
double turns_of(double x, double y) noexcept {
    constexpr double one_over_two_pi = 0.15915494309189535;
    constexpr double tan_of_pi_over_8 = 0.4142135623730951;
    const double across = __builtin_fabs(x);
    const double up = __builtin_fabs(y);
    const bool steep = up > across;
    const double larger = steep ? up : across;
    if (!(larger > 0.0)) return 0.0;
    double q = (steep ? across : up) / larger;
    const bool upper = q > tan_of_pi_over_8;
    if (upper) q = (q - 1.0) / (q + 1.0);
    const double z = q * q;
    double sum = 1.0 / 21.0;
    for (int k = 19; k >= 1; k -= 2) sum = 1.0 / k - z * sum;
    double turns = one_over_two_pi * q * sum + (upper ? 0.125 : 0.0);
    if (steep) turns = 0.25 - turns;
    if (x < 0.0) turns = 0.5 - turns;
    if (y < 0.0) turns = 1.0 - turns;
    return turns < 1.0 ? turns : 0.0;
}

}  // namespace zlg::core
