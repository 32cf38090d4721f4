// The length of a gap, chosen by the light.

#include <zlg/core/control/mode_switch.hpp>

#include "support.hpp"

namespace zlg::core::mode_switch_gap_test {

constexpr ModeSwitchConfig shortest(std::int32_t gap_min_ticks) {
    return {
        .gap_ticks = 3, .gap_min_ticks = gap_min_ticks, .settle_ticks = 4, .lock_timeout_ticks = 12, .dark_ticks = 2};
}

static_assert(check(shortest(0)) == ModeSwitchFault::none);
static_assert(check(shortest(3)) == ModeSwitchFault::none);
static_assert(check(shortest(4)) == ModeSwitchFault::ticks);
static_assert(check(shortest(-1)) == ModeSwitchFault::ticks);
static_assert(check(ModeSwitchConfig{.arrival_tolerance = Wavelengths{0.25}}) == ModeSwitchFault::tolerance);

constexpr ModeSwitchInput arrived{.light_known = true,
                                  .two_way = true,
                                  .usable = true,
                                  .at_rest = true,
                                  .piezo = Volts{190.0},
                                  .set_point = Volts{150.0},
                                  .half_wave = Volts{40.0}};

// Halves of the gap, in the last of which and before, from `from` on, the light looks like `seen`.
int gap_halves(const ModeSwitchConfig& c, const ModeSwitchInput& seen, int from = 0) {
    ModeSwitchState s = initial_state(c);
    int half = 0;
    const auto feed = [&](ModeSwitchInput in, bool due) {
        in.tick_border = half % 2 == 1;
        in.next_tick = (half + 1) / 2;
        in.due = due;
        ++half;
        return step(c, s, in).loop_closed;
    };
    for (int k = 0; k < 11; ++k) (void)feed(arrived, false);
    EXPECT_FALSE(feed(arrived, true));
    ModeSwitchInput dark = arrived;
    dark.two_way = dark.usable = false;
    for (int n = 1; n < 20; ++n) {
        if (feed(n - 1 < from ? dark : seen, false)) return n;
    }
    return 0;
}

TEST(ModeSwitchGap, IsFixedUnlessASmallerOneIsAllowed) {
    EXPECT_EQ(gap_halves(shortest(0), arrived), 6);
    EXPECT_EQ(gap_halves(shortest(3), arrived), 6);
}

TEST(ModeSwitchGap, EndsAtTheFirstTickBorderAtWhichTheSwitchHasArrived) {
    EXPECT_EQ(gap_halves(shortest(1), arrived), 2);
    EXPECT_EQ(gap_halves(shortest(2), arrived), 4);
    EXPECT_EQ(gap_halves(shortest(1), arrived, 2), 4);
    EXPECT_EQ(gap_halves(shortest(1), arrived, 3), 4) << "the light of the last half decides";
    EXPECT_EQ(gap_halves(shortest(1), arrived, 4), 6) << "never later than gap_ticks";
}

TEST(ModeSwitchGap, NeedsLightBothWaysAUsableDetuningAndAPiezoAtRest) {
    const auto gap = [](auto change) {
        ModeSwitchInput in = arrived;
        change(in);
        return gap_halves(shortest(1), in);
    };
    EXPECT_EQ(gap([](auto& in) { in.light_known = false; }), 6);
    EXPECT_EQ(gap([](auto& in) { in.two_way = false; }), 6);
    EXPECT_EQ(gap([](auto& in) { in.usable = false; }), 6);
    EXPECT_EQ(gap([](auto& in) { in.at_rest = false; }), 6);
    EXPECT_EQ(gap([](auto& in) { in.detuning = Wavelengths{0.06}; }), 6);
    EXPECT_EQ(gap([](auto& in) { in.detuning = Wavelengths{-0.06}; }), 6);
    EXPECT_EQ(gap([](auto& in) { in.detuning = Wavelengths{not_a_number}; }), 6);
    EXPECT_EQ(gap([](auto& in) { in.detuning = Wavelengths{0.04}; }), 2);
}

TEST(ModeSwitchGap, JudgesWhereTheDetuningLeadsNotWhereItWas) {
    ModeSwitchInput in = arrived;
    in.detuning = Wavelengths{-0.07};
    in.in_flight = Wavelengths{0.06};
    EXPECT_EQ(gap_halves(shortest(1), in), 2);
    in.detuning = Wavelengths{0.01};
    EXPECT_EQ(gap_halves(shortest(1), in), 6);
}

}  // namespace zlg::core::mode_switch_gap_test
