// A Draw: its laws, and what changes its numbers.

#include <zlg/chance/draw.hpp>

#include "test.hpp"

namespace zlg::chance {
namespace {

constexpr int n = 100'000;

struct Moments {
    double mean, variance;
};

Moments moments(const std::function<double(Draw&)>& number) {
    Draw draw{7, Cause::test};
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

TEST(Draw, NumbersAreThoseOfTheAddressFromIndexZeroOn) {
    const Address address{.seed = 5, .gyro = 7, .cause = Cause::test, .half = 6};
    Draw draw{5, Cause::test, 6, 7};
    EXPECT_EQ(draw.bits(), chance::bits(address, 0));
    EXPECT_EQ(draw.uniform(), chance::uniform(address, 1));
    for (std::uint32_t i = 0; i < 100; ++i) ASSERT_EQ(draw.normal(), chance::normal(address, i));
    EXPECT_EQ(draw.uniform(), chance::uniform(address, 2));
}

TEST(Draw, SeedCauseTrialAndThingEachMakeOtherNumbers) {
    const double first = Draw{1, Cause::test, 2, 3}.normal();
    EXPECT_EQ((Draw{1, Cause::test, 2, 3}.normal()), first);
    EXPECT_NE((Draw{2, Cause::test, 2, 3}.normal()), first);
    EXPECT_NE((Draw{1, Cause::benchmark, 2, 3}.normal()), first);
    EXPECT_NE((Draw{1, Cause::test, 3, 3}.normal()), first);
    EXPECT_NE((Draw{1, Cause::test, 2, 4}.normal()), first);
}

TEST(Draw, ACopyGoesOnLikeTheOriginal) {
    Draw draw{1, Cause::test};
    for (int i = 0; i < 5; ++i) draw.normal();
    Draw copy = draw;
    for (int i = 0; i < 100; ++i) ASSERT_EQ(copy.normal(), draw.normal());
}

TEST(Draw, TheDrawsOfATrialAreFoundByName) {
    const Draws draws{.seed = 1, .cause = Cause::test, .trial = 2};
    EXPECT_EQ(draws.of("bias").bits(), (Draw{1, Cause::test, 2, thing_of("bias")}.bits()));
    EXPECT_NE(draws.of("bias").bits(), draws.of("scale").bits());
}

// The published test values of FNV-1a.
TEST(Draw, NamesMakeTheirHashes) {
    EXPECT_EQ(thing_of(""), 0x811c9dc5u);
    EXPECT_EQ(thing_of("a"), 0xe40c292cu);
    EXPECT_EQ(thing_of("foobar"), 0xbf9cf968u);
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
    Draw draw{3, Cause::test};
    std::array<int, 3> counts{};
    for (int i = 0; i < 300; ++i) ++counts.at(static_cast<std::size_t>(draw.one_of(std::array{0, 1, 2})));
    for (const int count : counts) EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace zlg::chance
