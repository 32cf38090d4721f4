#include <zlg/core/common/maths.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "compensation/compensation_support.hpp"

namespace {

using namespace zlg::core;
using namespace compensation_test;

constexpr int n_random = 1'000'000;
constexpr double smallest_subnormal = 0x1p-1074;
constexpr double largest = 0x1.fffffffffffffp1023;

// A long double must hold enough more digits than a double to be the judge.
static_assert(std::numeric_limits<long double>::digits >= 64);

void expect_log(double x) {
    const double distance = ulps(natural_log(x), std::log(static_cast<long double>(x)));
    if (!(distance <= 2.0)) ADD_FAILURE() << "log(" << std::hexfloat << x << ") is off by " << distance << " ulp";
}

void expect_exp(double x) {
    const double distance = ulps(exponential(x), std::exp(static_cast<long double>(x)));
    if (!(distance <= 2.0)) ADD_FAILURE() << "exp(" << std::hexfloat << x << ") is off by " << distance << " ulp";
}

TEST(NaturalLog, IsGoodToTwoUlpForAnyPositiveNumber) {
    Random random{1};
    for (int k = 0; k < n_random; ++k) expect_log(std::bit_cast<double>(random.bits() % 0x7ff0000000000000u));
}

TEST(NaturalLog, IsGoodToTwoUlpForSubnormals) {
    Random random{2};
    for (int k = 0; k < 100'000; ++k)
        expect_log(std::bit_cast<double>((random.bits() >> 12 >> random.index(0, 51)) | 1));
    expect_log(smallest_subnormal);
}

TEST(NaturalLog, IsGoodToTwoUlpNearOneAndNearRootTwo) {
    Random random{3};
    for (int k = 0; k < n_random / 4; ++k) {
        const double shift = std::ldexp(random.uniform(-1.0, 1.0), -random.index(1, 52));
        expect_log(1.0 + shift);
        expect_log(std::sqrt(2.0) * (1.0 + shift));
    }
}

TEST(NaturalLog, OfPowersOfTwoIsAMultipleOfItsOwnLogOfTwo) {
    const long double ln2 = std::log(2.0L);
    for (int k = -1074; k <= 1023; ++k)
        EXPECT_LE(ulps(natural_log(std::ldexp(1.0, k)), static_cast<long double>(k) * ln2), 1.0) << k;
}

TEST(NaturalLog, EdgesAreThoseOfTheFunction) {
    EXPECT_EQ(natural_log(1.0), 0.0);
    EXPECT_EQ(natural_log(0.0), -infinity);
    EXPECT_EQ(natural_log(-0.0), -infinity);
    EXPECT_EQ(natural_log(infinity), infinity);
    for (const double x : {-smallest_subnormal, -1.0, -largest, -infinity, not_a_number})
        EXPECT_TRUE(std::isnan(natural_log(x))) << x;
    expect_log(largest);
    expect_log(0x1p-1022);
    expect_log(std::nextafter(0x1p-1022, 0.0));
}

TEST(Exponential, IsGoodToTwoUlpOverItsWholeRange) {
    Random random{4};
    for (int k = 0; k < n_random; ++k) expect_exp(random.uniform(-708.0, 709.0));
    expect_exp(-708.0);
    expect_exp(709.0);
}

TEST(Exponential, IsGoodToTwoUlpForSmallArguments) {
    Random random{5};
    for (int k = 0; k < n_random / 4; ++k) expect_exp(std::ldexp(random.uniform(-1.0, 1.0), -random.index(0, 70)));
}

TEST(Exponential, IsGoodToTwoUlpWhereTheArgumentIsHalfwayBetweenTwoPowers) {
    for (int k = -1020; k <= 1021; ++k) {
        const double halfway = (k + 0.5) * std::log(2.0);
        expect_exp(std::nextafter(halfway, -1000.0));
        expect_exp(halfway);
        expect_exp(std::nextafter(halfway, 1000.0));
    }
}

TEST(Exponential, EdgesAreThoseOfTheFunction) {
    EXPECT_EQ(exponential(0.0), 1.0);
    EXPECT_EQ(exponential(-0.0), 1.0);
    EXPECT_EQ(exponential(infinity), infinity);
    EXPECT_EQ(exponential(-infinity), 0.0);
    EXPECT_TRUE(std::isnan(exponential(not_a_number)));
    for (const double x : {std::nextafter(709.0, 710.0), 1e4, largest}) EXPECT_EQ(exponential(x), infinity) << x;
    for (const double x : {std::nextafter(-708.0, -709.0), -1e4, -largest}) EXPECT_EQ(exponential(x), 0.0) << x;
}

TEST(Exponential, UndoesTheLogarithm) {
    Random random{6};
    for (int k = 0; k < n_random / 4; ++k) {
        const double x = std::exp(random.uniform(-707.9, 708.9));
        const double log_x = natural_log(x);
        // Two ulp of the logarithm, an absolute error, become a relative one.
        const double bound = 2.0 * (std::nextafter(std::fabs(log_x), 1e4) - std::fabs(log_x)) + 0x1p-51;
        EXPECT_NEAR(exponential(log_x) / x, 1.0, bound) << x;
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
    for (const double x : {0.0, -0.0, smallest_subnormal, 1.0, -1e300, largest, -largest})
        EXPECT_TRUE(is_finite(x)) << x;
    for (const double x : {infinite, -infinite, not_a_number, -not_a_number}) EXPECT_FALSE(is_finite(x)) << x;
    static_assert(is_finite(3.263));
}

TEST(IsFinite, TheConstantInfinityExceedsEveryNumber) {
    EXPECT_GT(infinity, largest);
    EXPECT_FALSE(is_finite(infinity));
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
    for (const double y : {-1e-3, -1e-12, -1e-30, -smallest_subnormal}) {
        EXPECT_GE(turns_of(1.0, y), 0.0);
        EXPECT_LT(turns_of(1.0, y), 1.0);
    }
}

}  // namespace
