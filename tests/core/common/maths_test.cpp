#include <zlg/core/common/maths.hpp>

#include "compensation/compensation_support.hpp"

// Errors of ordinary arguments are held in maths_accuracy.cpp.

namespace zlg::core::maths_test {

using namespace compensation_test;

constexpr double subnormal = 0x1p-1074, normal = 0x1p-1022;  // the smallest ones
constexpr double largest = 0x1.fffffffffffffp1023;
constexpr double below_1 = 0x1.fffffffffffffp-1, above_1 = 0x1.0000000000001p+0;
constexpr double half_odd = 0x1.fffffffffffffp+51, odd = 0x1.fffffffffffffp+52;  // the largest ones

// Zeros, infinities, NaN, the borders of every range, whole numbers odd and even, small and beyond 2^53, and halves.
constexpr double sizes[] = {0.0,     subnormal, 0x1p-1023, normal, 1e-300,  1e-20, 1e-5,    0.25,    0.5,   0.75,
                            below_1, 1.0,       above_1,   1.5,    2.0,     3.0,   4.0,     22.5,    709.0, 1023.0,
                            1075.0,  1e10,      half_odd,  odd,    0x1p+53, 1e300, largest, infinite};

// The value of the C library where it is special, and next to it elsewhere.
void expect_as_c(double got, double expected, double x, double y) {
    if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(got)) << x << ", " << y << " gave " << got;
    } else if (expected == 0.0 || std::isinf(expected)) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(got), std::bit_cast<std::uint64_t>(expected)) << x << ", " << y;
    } else {
        EXPECT_LE(ulps(got, static_cast<long double>(expected)), 1.0) << x << ", " << y;
    }
}

template <class Ours, class Theirs> void expect_as_c_of_one(Ours ours, Theirs theirs) {
    for (const double x : sizes) {
        expect_as_c(ours(x), theirs(x), x, 0.0);
        expect_as_c(ours(-x), theirs(-x), -x, 0.0);
    }
    EXPECT_TRUE(std::isnan(ours(not_a_number)));
}

template <class Ours, class Theirs> void expect_as_c_of_two(Ours ours, Theirs theirs) {
    const auto both_signs = [&](double x, double y) {
        for (const double first : {x, -x})
            for (const double second : {y, -y}) expect_as_c(ours(first, second), theirs(first, second), first, second);
    };
    for (const double x : sizes) {
        for (const double y : sizes) both_signs(x, y);
        both_signs(x, not_a_number);
        both_signs(not_a_number, x);
    }
    both_signs(not_a_number, not_a_number);
}

#define ZLG_OURS_AND_THEIRS(name) [](auto... x) { return maths::name(x...); }, [](auto... x) { return std::name(x...); }

TEST(Maths, SpecialValuesAreThoseOfC) {
    expect_as_c_of_one(ZLG_OURS_AND_THEIRS(exp));
    expect_as_c_of_one(ZLG_OURS_AND_THEIRS(expm1));
    expect_as_c_of_one(ZLG_OURS_AND_THEIRS(log));
    expect_as_c_of_one(ZLG_OURS_AND_THEIRS(sin));
    expect_as_c_of_one(ZLG_OURS_AND_THEIRS(cos));
    expect_as_c_of_one(ZLG_OURS_AND_THEIRS(asin));
    expect_as_c_of_one(ZLG_OURS_AND_THEIRS(tanh));
    expect_as_c_of_two(ZLG_OURS_AND_THEIRS(atan2));
    expect_as_c_of_two(ZLG_OURS_AND_THEIRS(hypot));
}

TEST(Maths, SincosIsSineAndCosine) {
    Random random{2};
    for (int k = 0; k < 10'000; ++k) {
        const double x = random.uniform(-1e5, 1e5);
        EXPECT_EQ(maths::sincos(x).sin, maths::sin(x)) << x;
        EXPECT_EQ(maths::sincos(x).cos, maths::cos(x)) << x;
    }
}

TEST(Maths, LogOfAPowerOfTwoIsTheNearestDouble) {
    const long double ln2 = std::log(2.0L);
    for (int k = -1074; k <= 1023; ++k)
        EXPECT_EQ(maths::log(std::ldexp(1.0, k)), static_cast<double>(static_cast<long double>(k) * ln2)) << k;
}

TEST(Maths, HypotOfPythagoreanTriplesIsExact) {
    for (const double scale : {subnormal, 0x1p-1030, 1.0, 0x1p1000}) {
        EXPECT_EQ(maths::hypot(3.0 * scale, -4.0 * scale), 5.0 * scale);
        EXPECT_EQ(maths::hypot(12.0 * scale, 5.0 * scale), 13.0 * scale);
        EXPECT_EQ(maths::hypot(20.0 * scale, 21.0 * scale), 29.0 * scale);
    }
}

TEST(SquareRoot, IsTheNearestDouble) {
    Random random{7};
    for (int k = 0; k < 100'000; ++k) {
        const double x = std::bit_cast<double>(random.bits() % 0x7ff0000000000000u);
        const double root = square_root(x);
        const Quad below = (Quad{root} + Quad{std::nextafter(root, 0.0)}) / 2;
        const Quad above = (Quad{root} + Quad{std::nextafter(root, infinite)}) / 2;
        EXPECT_TRUE(below * below <= Quad{x} && Quad{x} <= above * above) << x;
    }
    for (int k = 0; k < 1000; ++k) EXPECT_EQ(square_root(static_cast<double>(k * k)), k);
}

TEST(IsFinite, IsFalseForInfinitiesAndNotANumberOnly) {
    for (const double x : {0.0, -0.0, subnormal, 1.0, -1e300, largest, -largest}) EXPECT_TRUE(is_finite(x)) << x;
    for (const double x : {infinite, -infinite, not_a_number, -not_a_number}) EXPECT_FALSE(is_finite(x)) << x;
    static_assert(is_finite(3.263));
    EXPECT_GT(infinity, largest);
}

TEST(TurnsOf, IsTheAngleInTurnsInEveryQuadrant) {
    for (int k = 0; k < 100'000; ++k) {
        const double turns = k / 100'000.0;
        const double size = 1e-3 + 7.0 * (k % 13);
        const double x = size * std::cos(2.0 * M_PI * turns);
        const double y = size * std::sin(2.0 * M_PI * turns);
        EXPECT_NEAR(std::remainder(turns_of(x, y) - turns, 1.0), 0.0, 1e-9) << turns;
    }
}

TEST(TurnsOf, IsBelowOneTurn) {
    EXPECT_EQ(turns_of(0.0, 0.0), 0.0);
    EXPECT_EQ(turns_of(1.0, 0.0), 0.0);
    EXPECT_EQ(turns_of(0.0, 2.0), 0.25);
    EXPECT_EQ(turns_of(-3.0, 0.0), 0.5);
    EXPECT_EQ(turns_of(0.0, -4.0), 0.75);
    for (const double y : {-1e-3, -1e-12, -1e-30, -subnormal}) {
        EXPECT_GE(turns_of(1.0, y), 0.0);
        EXPECT_LT(turns_of(1.0, y), 1.0);
    }
}

}  // namespace zlg::core::maths_test
