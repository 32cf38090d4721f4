// The length of a gap, chosen by the light.
#include "mode_switch_support.hpp"

namespace zlg::core::test::mode_switch_gap_test {

constexpr ModeSwitchConfig shortest(std::int32_t gap_min_ticks) {
    ModeSwitchConfig c = config;
    c.gap_min_ticks = gap_min_ticks;
    return c;
}

static_assert(is_allowed(shortest(0)));
static_assert(is_allowed(shortest(3)));
static_assert(!is_allowed(shortest(4)));
static_assert(!is_allowed(shortest(-1)));
static_assert(!is_allowed(ModeSwitchConfig{.arrival_tolerance = Wavelengths{0.25}}));

constexpr auto arrived = [](ModeSwitchInput&) {};

// Halves of a gap that may end after `gap_min_ticks`. From `from` on its light has arrived, but for a change.
int gap_halves(std::int32_t gap_min_ticks, auto change, int from = 0) {
    Sequence q{shortest(gap_min_ticks)};
    q.to_open();
    for (int n = 1; n < 20; ++n) {
        ModeSwitchInput in = q.input(n > from ? locked : dark);
        in.at_rest = true;
        if (n > from) change(in);
        if (q.half(in).loop_closed) return n;
    }
    return 0;
}

TEST(ModeSwitchGap, IsFixedUnlessASmallerOneIsAllowed) {
    EXPECT_EQ(gap_halves(0, arrived), 6);
    EXPECT_EQ(gap_halves(3, arrived), 6);
}

TEST(ModeSwitchGap, EndsAtTheFirstTickBorderAtWhichTheSwitchHasArrived) {
    EXPECT_EQ(gap_halves(1, arrived), 2);
    EXPECT_EQ(gap_halves(2, arrived), 4);
    EXPECT_EQ(gap_halves(1, arrived, 2), 4);
    EXPECT_EQ(gap_halves(1, arrived, 3), 4) << "the light of the last half decides";
    EXPECT_EQ(gap_halves(1, arrived, 4), 6) << "never later than gap_ticks";
}

TEST(ModeSwitchGap, NeedsLightBothWaysAUsableDetuningAndAPiezoAtRest) {
    EXPECT_EQ(gap_halves(1, [](auto& in) { in.light_known = false; }), 6);
    EXPECT_EQ(gap_halves(1, [](auto& in) { in.two_way = false; }), 6);
    EXPECT_EQ(gap_halves(1, [](auto& in) { in.usable = false; }), 6);
    EXPECT_EQ(gap_halves(1, [](auto& in) { in.at_rest = false; }), 6);
    for (const auto& [detuning_lambda, n] : {std::pair{0.06, 6}, {-0.06, 6}, {not_a_number, 6}, {0.04, 2}})
        EXPECT_EQ(gap_halves(1, [dl = detuning_lambda](auto& in) { in.detuning = Wavelengths{dl}; }), n)
            << detuning_lambda;
}

TEST(ModeSwitchGap, JudgesWhereTheDetuningLeadsNotWhereItWas) {
    for (const auto& [detuning_lambda, n] : {std::pair{-0.07, 2}, {0.01, 6}}) {
        const auto in_flight = [dl = detuning_lambda](ModeSwitchInput& in) {
            in.detuning = Wavelengths{dl};
            in.in_flight = Wavelengths{0.06};
        };
        EXPECT_EQ(gap_halves(1, in_flight), n) << detuning_lambda;
    }
}

}  // namespace zlg::core::test::mode_switch_gap_test
