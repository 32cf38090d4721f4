#include <zlg/core/common/maths.hpp>

#include <bit>
#include <cstdint>

namespace zlg::core {
namespace {

// ln 2 in two parts: the high one has trailing zeros, so that k * high is exact for every exponent k.
constexpr double ln2_high = 0x1.62e42feep-1;
constexpr double ln2_low = 0x1.a39ef35793c76p-33;

constexpr double not_a_number = __builtin_nan("");

// 2^k as a double, -1022 <= k <= 1023.
double power_of_two(int k) noexcept { return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52); }

// 2 atanh(s) for |s| <= 3 - 2 sqrt 2; the first term left out is below 2e-18 of the sum.
double twice_atanh(double s) noexcept {
    const double z = s * s;
    double sum = 0.0;
    for (int k = 23; k >= 3; k -= 2) sum = z * (sum + 1.0 / k);
    return 2.0 * s + 2.0 * s * sum;
}

}  // namespace

double natural_log(double x) noexcept {
    if (!(x > 0.0)) return x == 0.0 ? -infinity : not_a_number;
    if (x == infinity) return infinity;
    int k = 0;
    if (x < 0x1p-1022) {
        x *= 0x1p54;
        k = -54;
    }
    const auto bits = std::bit_cast<std::uint64_t>(x);
    k += static_cast<int>(bits >> 52) - 1023;
    double m = std::bit_cast<double>((bits & 0x000fffffffffffffu) | 0x3ff0000000000000u);
    if (m > 1.4142135623730951) {
        m *= 0.5;
        ++k;
    }
    return k * ln2_high + (k * ln2_low + twice_atanh((m - 1.0) / (m + 1.0)));
}

double exponential(double x) noexcept {
    if (!(x == x)) return x;
    if (x > 709.0) return infinity;
    if (x < -708.0) return 0.0;
    constexpr double one_over_ln2 = 1.4426950408889634;
    const int k = static_cast<int>(x * one_over_ln2 + (x < 0.0 ? -0.5 : 0.5));
    const double r = (x - k * ln2_high) - k * ln2_low;
    double sum = 1.0;
    for (int n = 14; n >= 2; --n) sum = 1.0 + sum * r / n;
    return (1.0 + r * sum) * power_of_two(k);
}

// The octant by the signs and the larger coordinate, half of it by tan(a - pi/4) = (q - 1)/(q + 1): the series is left with
// |q| <= tan(pi/8).
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
