// Where the errors of elementary functions are looked for.

#include <bit>
#include <cmath>
#include <cstdint>

#include <zlg/core/common/maths_kernels.hpp>

#include "errors.hpp"

namespace zlg::trials {
namespace {

namespace maths = core::maths;

constexpr double pi = 0x1.921fb54442d18p+1;
constexpr double ln2 = 0x1.62e42fefa39efp-1;
constexpr double root_2 = 0x1.6a09e667f3bcdp+0;

double uniform(Bits& bits, double from, double to) {
    return from + (to - from) * (static_cast<double>(bits() >> 11) * 0x1p-53);
}
int whole(Bits& bits, int from, int to) {
    return from + static_cast<int>(bits() % static_cast<std::uint64_t>(to - from + 1));
}
double signed_as(Bits& bits, double x) { return (bits() & 1u) != 0 ? -x : x; }

// Every binade from 2^from to 2^to alike, of either sign.
double binade(Bits& bits, int from, int to) {
    return signed_as(bits, std::ldexp(uniform(bits, 1.0, 2.0), whole(bits, from, to)));
}
double positive(Bits& bits) { return std::fabs(binade(bits, -1022, 1023)); }
double subnormal(Bits& bits) { return std::bit_cast<double>((bits() >> 12 >> whole(bits, 0, 51)) | 1u); }
// x and the doubles nearest to it.
double beside(Bits& bits, double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + (bits() % 5u) - 2u);
}
double near(Bits& bits, double x) { return x * (1.0 + binade(bits, -52, -3)); }
// The double next to a multiple of pi/2, by 64 bits of it.
double near_right_angle(Bits& bits, int greatest) {
    const auto n = static_cast<long double>(std::floor(std::exp2(uniform(bits, 0.0, greatest))));
    return signed_as(bits, beside(bits, static_cast<double>(n * 1.57079632679489661923132169163975144L)));
}
double near_quarter(Bits& bits, int greatest) {
    return 0.25 * std::floor(binade(bits, 0, greatest)) + binade(bits, -60, -3);
}

// Two of the doubles that come closest to a multiple of pi/2 for their size, and their neighbours.
double least_rest(Bits& bits) {
    constexpr double some[] = {6381956970095103.0 * 0x1p797, 5319372648326541.0 * 0x1p255};
    return signed_as(bits, beside(bits, some[bits() % 2u]));
}

Arguments turned_little(Bits& bits) {
    const double x = binade(bits, -300, 300);
    return {x * binade(bits, -700, -1), std::fabs(x)};
}

// y/x beside tan(pi/8), 1 and their like in the other octants.
Arguments near_octant(Bits& bits) {
    constexpr double tan_of_pi_over_8 = 0x1.a827999fcef32p-2;
    const double x = binade(bits, -1, 0);
    const double y = near(bits, x * (whole(bits, 0, 1) != 0 ? 1.0 : tan_of_pi_over_8));
    return whole(bits, 0, 1) != 0 ? Arguments{y, x} : Arguments{x, y};
}

Arguments alike(Bits& bits) {
    const double x = binade(bits, -1022, 1022);
    return {x, x * uniform(bits, 0.5, 2.0)};
}

const Function of_exp{"exp", [](Arguments a) { return maths::exp(a.x); },
                      [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_exp(r, x, MPFR_RNDN); }};
const Function of_expm1{"expm1", [](Arguments a) { return maths::expm1(a.x); },
                        [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_expm1(r, x, MPFR_RNDN); }};
const Function of_log{"log", [](Arguments a) { return maths::log(a.x); },
                      [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_log(r, x, MPFR_RNDN); }};
const Function of_sin{"sin", [](Arguments a) { return maths::sin(a.x); },
                      [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_sin(r, x, MPFR_RNDN); }};
const Function of_cos{"cos", [](Arguments a) { return maths::cos(a.x); },
                      [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_cos(r, x, MPFR_RNDN); }};
const Function of_asin{"asin", [](Arguments a) { return maths::asin(a.x); },
                       [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_asin(r, x, MPFR_RNDN); }};
const Function of_tanh{"tanh", [](Arguments a) { return maths::tanh(a.x); },
                       [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_tanh(r, x, MPFR_RNDN); }};
const Function of_sin_turns{"sin_turns", [](Arguments a) { return maths::sincos_turns_kernel(a.x).sin; },
                            [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_sinu(r, x, 1, MPFR_RNDN); }};
const Function of_cos_turns{"cos_turns", [](Arguments a) { return maths::sincos_turns_kernel(a.x).cos; },
                            [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { return mpfr_cosu(r, x, 1, MPFR_RNDN); }};
const Function of_hypot{"hypot", [](Arguments a) { return maths::hypot(a.x, a.y); },
                        [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr y) { return mpfr_hypot(r, x, y, MPFR_RNDN); }};
const Function of_atan2{"atan2", [](Arguments a) { return maths::atan2(a.x, a.y); },
                        [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr y) { return mpfr_atan2(r, x, y, MPFR_RNDN); }};

std::vector<Region> of_exponentials() {
    return {
        {of_exp, "whole range", [](Bits& b) { return Arguments{uniform(b, -746.0, 710.0)}; }},
        {of_exp, "every binade", [](Bits& b) { return Arguments{binade(b, -80, 9)}; }},
        {of_exp, "beside half powers of two",
         [](Bits& b) { return Arguments{beside(b, (whole(b, -1074, 1022) + 0.5) * ln2)}; }},
        {of_exp, "overflow", [](Bits& b) { return Arguments{uniform(b, 709.7, 709.8)}; }},
        {of_exp, "subnormal results", [](Bits& b) { return Arguments{uniform(b, -745.2, -708.0)}; }},
        {of_expm1, "whole range", [](Bits& b) { return Arguments{uniform(b, -60.0, 710.0)}; }},
        {of_expm1, "near zero", [](Bits& b) { return Arguments{uniform(b, -1.0, 1.0)}; }},
        {of_expm1, "every binade", [](Bits& b) { return Arguments{binade(b, -1022, 9)}; }},
        {of_expm1, "overflow", [](Bits& b) { return Arguments{uniform(b, 709.7, 709.8)}; }},
        {of_tanh, "whole range", [](Bits& b) { return Arguments{uniform(b, -22.0, 22.0)}; }},
        {of_tanh, "near zero", [](Bits& b) { return Arguments{uniform(b, -1.0, 1.0)}; }},
        {of_tanh, "every binade", [](Bits& b) { return Arguments{binade(b, -1022, 5)}; }},
    };
}

std::vector<Region> of_logarithms() {
    return {
        {of_log, "every binade", [](Bits& b) { return Arguments{positive(b)}; }},
        {of_log, "subnormal", [](Bits& b) { return Arguments{subnormal(b)}; }},
        {of_log, "near 1", [](Bits& b) { return Arguments{near(b, 1.0)}; }},
        {of_log, "0.5 to 2", [](Bits& b) { return Arguments{uniform(b, 0.5, 2.0)}; }},
        {of_log, "near the root of 2",
         [](Bits& b) { return Arguments{near(b, whole(b, 0, 1) != 0 ? root_2 : 0.5 * root_2)}; }},
    };
}

std::vector<Region> of_angles() {
    return {
        {of_sin, "one turn", [](Bits& b) { return Arguments{uniform(b, -2.0 * pi, 2.0 * pi)}; }},
        {of_sin, "2^20 turns", [](Bits& b) { return Arguments{uniform(b, -0x1p21 * pi, 0x1p21 * pi)}; }},
        {of_sin, "every binade", [](Bits& b) { return Arguments{binade(b, -1022, 1023)}; }},
        {of_sin, "beside right angles, to 2^23", [](Bits& b) { return Arguments{near_right_angle(b, 22)}; }},
        {of_sin, "beside right angles, to 2^60", [](Bits& b) { return Arguments{near_right_angle(b, 59)}; }},
        {of_sin, "beside the least rests", [](Bits& b) { return Arguments{least_rest(b)}; }},
        {of_cos, "one turn", [](Bits& b) { return Arguments{uniform(b, -2.0 * pi, 2.0 * pi)}; }},
        {of_cos, "2^20 turns", [](Bits& b) { return Arguments{uniform(b, -0x1p21 * pi, 0x1p21 * pi)}; }},
        {of_cos, "every binade", [](Bits& b) { return Arguments{binade(b, -1022, 1023)}; }},
        {of_cos, "beside right angles, to 2^23", [](Bits& b) { return Arguments{near_right_angle(b, 22)}; }},
        {of_cos, "beside right angles, to 2^60", [](Bits& b) { return Arguments{near_right_angle(b, 59)}; }},
        {of_cos, "beside the least rests", [](Bits& b) { return Arguments{least_rest(b)}; }},
    };
}

std::vector<Region> of_turns() {
    return {
        {of_sin_turns, "one turn", [](Bits& b) { return Arguments{uniform(b, -1.0, 1.0)}; }},
        {of_sin_turns, "every binade", [](Bits& b) { return Arguments{binade(b, -900, 47)}; }},
        {of_sin_turns, "near quarter turns", [](Bits& b) { return Arguments{near_quarter(b, 40)}; }},
        {of_cos_turns, "one turn", [](Bits& b) { return Arguments{uniform(b, -1.0, 1.0)}; }},
        {of_cos_turns, "every binade", [](Bits& b) { return Arguments{binade(b, -900, 47)}; }},
        {of_cos_turns, "near quarter turns", [](Bits& b) { return Arguments{near_quarter(b, 40)}; }},
    };
}

std::vector<Region> of_vectors() {
    return {
        {of_atan2, "every direction",
         [](Bits& b) {
             return Arguments{uniform(b, -1.0, 1.0), uniform(b, -1.0, 1.0)};
         }},
        {of_atan2, "every binade",
         [](Bits& b) {
             return Arguments{binade(b, -1022, 1023), binade(b, -1022, 1023)};
         }},
        {of_atan2, "small angles", [](Bits& b) { return turned_little(b); }},
        {of_atan2, "near the borders of octants", [](Bits& b) { return near_octant(b); }},
        {of_atan2, "subnormal",
         [](Bits& b) {
             return Arguments{signed_as(b, subnormal(b)), signed_as(b, subnormal(b))};
         }},
        {of_atan2, "subnormal results",
         [](Bits& b) {
             return Arguments{signed_as(b, subnormal(b)), uniform(b, 0.1, 10.0)};
         }},
        {of_asin, "whole range", [](Bits& b) { return Arguments{uniform(b, -1.0, 1.0)}; }},
        {of_asin, "every binade", [](Bits& b) { return Arguments{binade(b, -1022, -1)}; }},
        {of_asin, "near 1", [](Bits& b) { return Arguments{1.0 - std::fabs(binade(b, -53, -2))}; }},
        {of_asin, "near 1/2", [](Bits& b) { return Arguments{near(b, 0.5)}; }},
        {of_hypot, "every direction",
         [](Bits& b) {
             return Arguments{uniform(b, -1.0, 1.0), uniform(b, -1.0, 1.0)};
         }},
        {of_hypot, "every binade",
         [](Bits& b) {
             return Arguments{binade(b, -1022, 1023), binade(b, -1022, 1023)};
         }},
        {of_hypot, "alike", [](Bits& b) { return alike(b); }},
        {of_hypot, "subnormal",
         [](Bits& b) {
             return Arguments{signed_as(b, subnormal(b)), signed_as(b, subnormal(b))};
         }},
        {of_hypot, "overflow",
         [](Bits& b) {
             return Arguments{uniform(b, 0x1p1022, 0x1.8p1023), uniform(b, 0x1p1022, 0x1.8p1023)};
         }},
    };
}

}  // namespace

const std::vector<Region>& regions() {
    static const std::vector<Region> all = [] {
        std::vector<Region> result;
        for (const auto& some : {of_exponentials(), of_logarithms(), of_angles(), of_turns(), of_vectors()})
            result.insert(result.end(), some.begin(), some.end());
        return result;
    }();
    return all;
}

}  // namespace zlg::trials
