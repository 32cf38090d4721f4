// A Draw: its laws, and what changes its numbers.

#include <zlg/chance/draw.hpp>

#include "test.hpp"

namespace zlg::chance::draw_test {

TEST(Draw, NumbersAreThoseOfTheAddressFromIndexZeroOn) {
    const Address address{.seed = 5, .gyro = 7, .cause = Cause::test, .half = 6};
    Draw draw{5, Cause::test, 6, 7};
    EXPECT_EQ(draw.bits(), chance::bits(address, 0));
    EXPECT_EQ(draw.uniform(), chance::uniform(address, 1));
    for (std::uint32_t i = 0; i < 100; ++i) ASSERT_EQ(draw.normal(), chance::normal(address, i));
    EXPECT_EQ(draw.uniform(), chance::uniform(address, 2));
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

TEST(Draw, ChoicesAreOfTheArrayAndAllOfThem) {
    Draw draw{3, Cause::test};
    std::array<int, 3> counts{};
    for (int i = 0; i < 300; ++i) ++counts.at(static_cast<std::size_t>(draw.one_of(std::array{0, 1, 2})));
    for (const int count : counts) EXPECT_GT(count, 50);
}

}  // namespace zlg::chance::draw_test
