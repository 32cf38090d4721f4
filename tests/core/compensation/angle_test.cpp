#include <zlg/core/compensation/angle.hpp>

#include <rapidcheck/gtest.h>

#include "compensation_support.hpp"

namespace zlg::core::angle_test {

using namespace compensation_test;

Quad exact_value(const ExactSum& sum) { return Quad{sum.high} + Quad{sum.low}; }

ExactSum sum_of(const std::vector<double>& terms) {
    ExactSum sum;
    for (const double x : terms) sum.add(x);
    return sum;
}

TEST(ExactSum, ItsTwoPartsDoNotOverlap) {
    Random random{1};
    ExactSum sum;
    for (int k = 0; k < 100'000; ++k) {
        sum.add(random.uniform(-1.0, 1.0) * std::exp(random.uniform(-30.0, 30.0)));
        ASSERT_EQ(sum.high + sum.low, sum.high);
    }
}

// Below a power of two the doubles are twice as dense: what is half a step above it is a whole step below.
TEST(ExactSum, ItsValueIsTheNearestDoubleOnBothSidesOfAPowerOfTwo) {
    EXPECT_EQ(sum_of({1.0, 0x1.8p-54}).value(), 1.0);
    EXPECT_EQ(sum_of({1.0, -0x1.8p-54}).value(), 1.0 - 0x1p-53);
}

// Integers of 63 bits, a hundred of them: the sum fits two doubles, so nothing at all may be lost.
RC_GTEST_PROP(ExactSum, IntegersOfAnySizeAddExactly, (const std::vector<std::int64_t>& terms)) {
    ExactSum sum;
    Integer128 exact = 0;
    for (const std::int64_t term : terms) {
        const double x = static_cast<double>(term);
        sum.add(x);
        exact += static_cast<Integer128>(x);
    }
    RC_ASSERT(static_cast<Integer128>(sum.high) + static_cast<Integer128>(sum.low) == exact);
}

RC_GTEST_PROP(ExactSum, TakingEveryTermAwayAgainLeavesNothing, (const std::vector<std::int64_t>& terms)) {
    ExactSum sum;
    for (const std::int64_t term : terms) sum.add(0x1p-10 * static_cast<double>(term));
    for (const std::int64_t term : terms) sum.add(-0x1p-10 * static_cast<double>(term));
    RC_ASSERT(sum == ExactSum{});
}

TEST(ExactSum, RandomMagnitudesLoseLessThanTheStatedPartOfEachPartialSum) {
    Random random{2};
    ExactSum sum;
    Integer128 exact = 0;  // in units of 2^-72
    Quad allowed = 0;
    for (int k = 0; k < 200'000; ++k) {
        const double x = std::ldexp(random.uniform(-1.0, 1.0), random.index(-19, 20));
        // A multiple of 2^-52 * 2^-19: a whole number of units.
        exact += static_cast<Integer128>(Quad{x} * Quad{0x1p72});
        sum.add(x);
        allowed += Quad{0x1p-104} * magnitude(static_cast<Quad>(exact) * Quad{0x1p-72});
    }
    EXPECT_TRUE(magnitude(exact_value(sum) - static_cast<Quad>(exact) * Quad{0x1p-72}) <= allowed + Quad{0x1p-72});
}

// A month of ticks has 5.2e8; what is added up here is a thousand times the angle of a month at 12000 arcsec/s.
TEST(Angle, CountsAloneAreIntegerArithmetic) {
    constexpr double scale_arcsec = 3.263;
    Random random{3};
    Angle angle;
    std::int64_t counts = 0;
    for (int k = 0; k < 10'000'000; ++k) {
        const std::int64_t tick_counts = random.integer(-1'000, 2'000'000);
        angle.add(tick_counts, scale_arcsec, scale_arcsec * static_cast<double>(tick_counts));
        counts += tick_counts;
    }
    EXPECT_GT(counts, 9'000'000'000'000);
    EXPECT_EQ(angle.counts, counts);
    EXPECT_EQ(angle.remainder_arcsec, ExactSum{});
    EXPECT_EQ(angle.value_arcsec(scale_arcsec), scale_arcsec * static_cast<double>(counts));
}

TEST(Angle, WhatIsNotCountsIsKeptToTheLastBit) {
    constexpr double scale_arcsec = 3.263;
    Random random{4};
    Angle angle;
    std::int64_t counts = 0;
    Quad remainder = 0;
    for (int k = 0; k < 1'000'000; ++k) {
        const std::int64_t tick_counts = random.integer(-20, 20);
        const double counted = scale_arcsec * static_cast<double>(tick_counts);
        const double dtheta = random.chance(0.3) ? random.uniform(-100.0, 100.0) : counted;
        angle.add(tick_counts, scale_arcsec, dtheta);
        counts += tick_counts;
        remainder += Quad{dtheta} - Quad{counted};
    }
    EXPECT_EQ(angle.counts, counts);
    EXPECT_TRUE(magnitude(exact_value(angle.remainder_arcsec) - remainder) < 1e-20);
    const double exact = static_cast<double>(Quad{scale_arcsec} * static_cast<Quad>(counts) + remainder);
    EXPECT_NEAR(angle.value_arcsec(scale_arcsec), exact,
                3e-16 * (std::fabs(exact) + std::fabs(static_cast<double>(remainder))));
}

TEST(Angle, AMeasuredTickLeavesTheRemainderAloneHoweverMuchItCounts) {
    Angle angle;
    for (const double dtheta_arcsec : {1.0, 1e-20}) angle.add(0, 1.0, dtheta_arcsec);
    const ExactSum before = angle.remainder_arcsec;
    angle.add(std::int64_t{1} << 62, 0x1p30, 0x1p92);
    EXPECT_EQ(angle.remainder_arcsec, before);
}

TEST(Angle, WildCountsWrapAndComeBack) {
    constexpr std::int64_t wild = std::numeric_limits<std::int64_t>::max();
    Angle angle;
    for (int k = 0; k < 2; ++k) angle.add(wild, 1.0, static_cast<double>(wild));
    EXPECT_EQ(angle.counts, -2);
    for (int k = 0; k < 2; ++k) angle.add(-wild, 1.0, -static_cast<double>(wild));
    EXPECT_EQ(angle, Angle{});
}

}  // namespace zlg::core::angle_test
