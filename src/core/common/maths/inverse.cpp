// Angles: arc tangent of two arguments, and arc sine.

#include <bit>
#include <cstdint>

#include <zlg/core/common/maths.hpp>

#include "common/maths/double_double.hpp"
#include "common/maths/scale.hpp"

namespace zlg::core::maths {
namespace {

// Multiples of it up to 4 are exact in the first part.
constexpr double quarter_pi_high = 0x1.921fb54442d18p-1;
constexpr double quarter_pi_low = 0x1.1a62633145c07p-55;

// atan(t) = t + t z P(z), z = t^2, |t| <= tan(pi/8): the second term. polynomial error 2^-53 of it
double atan_behind(double t) noexcept {
    const double z = t * t;
    const double zz = z * z;
    const double even =
        -0x1.5555555555555p-2 +
        zz * (-0x1.249249243d6b8p-3 +
              zz * (-0x1.745d0b9b37c6p-4 +
                    zz * (-0x1.10fae454c15p-4 + zz * (-0x1.a0b89fd35f146p-5 + zz * -0x1.3aea268dd0266p-6))));
    const double odd = 0x1.999999999942ap-3 +
                       zz * (0x1.c71c7188b437p-4 +
                             zz * (0x1.3b126bdb3c47fp-4 + zz * (0x1.dfecd9c3509dbp-5 + zz * 0x1.41b489d54a8ebp-5)));
    return t * z * (even + z * odd);
}

// asin(s) = s + s z P(z), z = s^2 <= 1/4: P. polynomial error 2^-53 of it
double asin_behind(double z) noexcept {
    const double zz = z * z;
    const double even =
        0x1.5555555555556p-3 +
        zz * (0x1.6db6db6e442c2p-5 +
              zz * (0x1.6e8bb30e1ed27p-6 +
                    zz * (0x1.c9d1fdde358c5p-7 +
                          zz * (0x1.52eb71998178ap-7 + zz * (0x1.20a9f2e10d53fp-6 + zz * 0x1.dabba2b5ad0a6p-6)))));
    const double odd =
        0x1.3333333332dc8p-4 +
        zz * (0x1.f1c71c1478c97p-6 +
              zz * (0x1.1c4d1a7281b7cp-6 +
                    zz * (0x1.780afddec99b9p-7 + zz * (0x1.603756089bbcfp-8 + zz * -0x1.f1700255eb69dp-7))));
    return even + z * odd;
}

// x or zero, without a branch that hardly anything predicts.
double if_so(bool is_so, double x) noexcept {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & (std::uint64_t{0} - std::uint64_t{is_so}));
}

// tan of the angle, 0..pi/4, of a vector whose coordinates are given, less pi/4 where it is upper: (q - 1)/(q + 1).
Sum tangent(double smaller, double larger, bool is_upper) noexcept {
    const auto [less, less_low] = sum_of(if_so(is_upper, larger), -smaller);
    return quotient_of({-less, -less_low}, sum_of(larger, if_so(is_upper, smaller)));
}

}  // namespace

// n pi/4 +- atan(t), where t stays below tan(pi/8) in size. An infinite coordinate counts as 1, beside which the others
// are zero, and so does the larger one of two zeros. Where the angle is small, it is the quotient itself, which may be
// subnormal.
double atan2(double y, double x) noexcept {
    constexpr double tan_of_pi_over_8 = 0x1.a827999fcef32p-2;
    if (x != x || y != y) return x + y;
    const double across = __builtin_fabs(x);
    const double up = __builtin_fabs(y);
    const bool is_steep = up > across;
    const double given = up > across ? up : across;
    const double other = up < across ? up : across;
    const bool is_limit = given == 0.0 || given == infinity;
    const double larger = is_limit ? 1.0 : given;
    const double smaller = is_limit ? (other == infinity ? 1.0 : 0.0) : other;
    const double scale = scale_of(larger);
    const bool is_upper = smaller * scale > larger * scale * tan_of_pi_over_8;
    const Sum t = tangent(smaller * scale, larger * scale, is_upper);
    const bool is_left = __builtin_copysign(1.0, x) < 0.0;
    int n_quarters = is_upper ? 1 : 0;
    n_quarters = is_steep ? 2 - n_quarters : n_quarters;
    n_quarters = is_left ? 4 - n_quarters : n_quarters;
    const double n = n_quarters;
    const double sign = is_steep == is_left ? 1.0 : -1.0;
    const double behind = t.low * (1.0 - t.high * t.high) + atan_behind(t.high);
    const auto [high, low] = sum_of(n * quarter_pi_high, sign * t.high);
    const double angle = high + (low + (sign * behind + n * quarter_pi_low));
    const bool is_small = n == 0.0 && t.high < 0x1p-30;
    return __builtin_copysign(is_small ? smaller / larger : angle, y);
}

// From 1/2 on asin(x) = pi/2 - 2 asin(s), s = sqrt((1 - x)/2), with what the root lost; of 0/0 the small number makes
// 0.
double asin(double x) noexcept {
    const double size = __builtin_fabs(x);
    const bool is_small = size < 0.5;
    const double z = is_small ? size * size : 0.5 * (1.0 - size);
    const double root = square_root(z);
    const auto [square, square_low] = product_of(root, root);
    const double twice_lost = ((z - square) - square_low) / (root + 0x1p-1000);
    const double v = is_small ? size : -2.0 * root;
    const auto [high, low] = sum_of(is_small ? 0.0 : 2.0 * quarter_pi_high, v);
    const double rest = is_small ? 0.0 : 2.0 * quarter_pi_low - twice_lost;
    return __builtin_copysign(high + (low + (v * z * asin_behind(z) + rest)), x);
}

}  // namespace zlg::core::maths
