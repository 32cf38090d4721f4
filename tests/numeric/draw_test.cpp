#include <zlg/numeric/draw.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

#include <gtest/gtest.h>

namespace zlg::numeric {
namespace {

constexpr int n = 100'000;

struct Moments {
    double mean, variance;
};

Moments moments(const std::function<double(Draw&)>& number) {
    Draw draw{7};
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n; ++i) {
        const double x = number(draw);
        sum += x;
        squares += x * x;
    }
    return {sum / n, squares / n - sum * sum / n / n};
}

// The mean of so many has a standard error of a three hundredth of the deviation.
void expect(const Moments& moments, double mean, double variance) {
    EXPECT_NEAR(moments.mean, mean, 4.0 * std::sqrt(variance / n));
    EXPECT_NEAR(moments.variance, variance, 0.03 * variance);
}

TEST(Draw, TheBitsAreThoseOfTheStandardsMersenneTwister) {
    Draw draw{5489};
    for (int i = 1; i < 10'000; ++i) draw.bits();
    EXPECT_EQ(draw.bits(), 9981545732273789042u);  // [rand.predef]
}

TEST(Draw, ASeedGivesTheSameNumbersAndAnotherGivesOthers) {
    Draw a{1}, b{1}, c{2};
    EXPECT_EQ(a.normal(), b.normal());
    EXPECT_EQ(a.uniform(), b.uniform());
    EXPECT_NE(a.uniform(), c.uniform());
}

TEST(Draw, NumbersHaveTheMomentsOfTheirLaw) {
    expect(moments([](Draw& d) { return d.uniform(); }), 0.5, 1.0 / 12.0);
    expect(moments([](Draw& d) { return d.within(-2.0, 4.0); }), 1.0, 3.0);
    expect(moments([](Draw& d) { return std::log(d.within_log(1.0, std::exp(6.0))); }), 3.0, 3.0);
    expect(moments([](Draw& d) { return d.normal(); }), 0.0, 1.0);
    expect(moments([](Draw& d) { return d.exponential(); }), 1.0, 1.0);
    expect(moments([](Draw& d) { return d.sign(); }), 0.0, 1.0);
    expect(moments([](Draw& d) { return static_cast<double>(d.below(5)); }), 2.0, 2.0);
    expect(moments([](Draw& d) { return d.is_one_in(4) ? 1.0 : 0.0; }), 0.25, 0.1875);
}

TEST(Draw, ChoicesAreOfTheArrayAndAllOfThem) {
    Draw draw{3};
    std::array<int, 3> counts{};
    for (int i = 0; i < 300; ++i) ++counts.at(static_cast<std::size_t>(draw.one_of(std::array{0, 1, 2})));
    for (const int count : counts) EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace zlg::numeric
