#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <zlg/wire/angle_register.hpp>

#include "test.hpp"

namespace zlg::wire::angle_register_test {

AngleRegister sum(const std::vector<double>& terms) {
    AngleRegister r;
    for (const double term : terms) r.add(term);
    return r;
}

TEST(AngleRegister, CountsIn2ToTheMinus28Arcsec) {
    EXPECT_EQ(sum({1.0}).high, std::uint64_t{1} << 28);
    EXPECT_EQ(sum({0x1p-28}).high, 1u);
    EXPECT_EQ(sum({3.25}).high, 13u * (std::uint64_t{1} << 26));
}

TEST(AngleRegister, IsRoundedDown) {
    EXPECT_EQ(sum({0x1.8p-28}), (AngleRegister{1, std::uint64_t{1} << 63}));
    EXPECT_EQ(sum({-0x1p-30}).high, ~std::uint64_t{0});
    EXPECT_EQ(sum({-1.0}).high, ~(std::uint64_t{1} << 28) + 1);
}

TEST(AngleRegister, WrapsAt2To36Arcsec) {
    EXPECT_EQ(sum({0x1p36}), AngleRegister{});
    EXPECT_EQ(sum({0x1p200, 5.0}), sum({5.0}));
    EXPECT_EQ(sum({0x1.8p36}), sum({0x1p35}));
}

TEST(AngleRegister, AMonthOfTicksIsExact) {
    // 3.263 arcsec is m 2^-51 with a whole m: n times it is (n m) 2^-51, here in the units 2^-92.
    const auto m = static_cast<std::uint64_t>(std::ldexp(3.263, 51));
    AngleRegister r;
    constexpr std::uint64_t n = 1'000'000;
    for (std::uint64_t k = 0; k < n; ++k) r.add(3.263);
    // n m 2^41 = high 2^64 + low
    const std::uint64_t product_high = (m >> 32) * n;
    const std::uint64_t product_low = (m & 0xFFFFFFFF) * n;
    const std::uint64_t low_word = (product_high << 32) + product_low;
    const std::uint64_t high_word = (product_high >> 32) + (low_word < product_low ? 1 : 0);
    EXPECT_EQ(r.low, low_word << 41);
    EXPECT_EQ(r.high, (high_word << 41) | (low_word >> 23));
}

TEST(AngleRegister, WhatIsNotFiniteIsNotAdded) {
    using Limits = std::numeric_limits<double>;
    EXPECT_EQ(sum({Limits::quiet_NaN(), 2.0, Limits::infinity(), -Limits::infinity()}), sum({2.0}));
}

TEST(AngleRegister, TurnedIsTheDifferenceAcrossTheWrap) {
    const AngleRegister before = sum({0x1p36 - 10.0});
    AngleRegister after = before;
    after.add(25.5);
    EXPECT_LT(after.high, before.high);
    EXPECT_EQ(turned_arcsec(before.high, after.high), 25.5);
    EXPECT_EQ(turned_arcsec(after.high, before.high), -25.5);
}

RC_GTEST_PROP(AngleRegister, TheOrderOfTheTermsDoesNotMatter, ()) {
    auto terms = *rc::gen::container<std::vector<double>>(
        rc::gen::map(rc::gen::pair(rc::gen::arbitrary<std::int64_t>(), rc::gen::inRange(-90, 20)),
                     [](const std::pair<std::int64_t, int>& p) {
                         return std::ldexp(static_cast<double>(p.first >> 11), p.second - 53);
                     }));
    const AngleRegister forward = sum(terms);
    std::reverse(terms.begin(), terms.end());
    RC_ASSERT(sum(terms) == forward);
    std::sort(terms.begin(), terms.end());
    RC_ASSERT(sum(terms) == forward);
}

}  // namespace zlg::wire::angle_register_test
