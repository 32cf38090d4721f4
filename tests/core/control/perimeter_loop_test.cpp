#include <zlg/core/control/perimeter_loop.hpp>

#include "support.hpp"

namespace zlg::core::perimeter_loop_test {

constexpr PerimeterLoopConfig digital{.kind = LoopKind::digital};
constexpr PerimeterLoopConfig analog{.kind = LoopKind::analog};

static_assert(is_allowed(digital));
constexpr bool allows(auto change) { return test::allows<PerimeterLoopConfig>(change); }
static_assert(!allows([](auto& c) { c.range.max = Volts{-1.0}; }));
static_assert(!allows([](auto& c) { c.half_wave = Volts{not_a_number}; }));
static_assert(!allows([](auto& c) { c.half_period = Seconds{0.0}; }));
static_assert(!allows([](auto& c) { c.time_constant = Seconds{0.002}; }));
static_assert(!allows([](auto& c) { c.error_limit = Wavelengths{not_a_number}; }));
static_assert(!allows([](auto& c) { c.slew_v_s = 0.0; }));
static_assert(!allows([](auto& c) { c.watch_limit = Wavelengths{0.0}; }));

PerimeterLoopInput measured(double detuning_lambda) {
    return {.usable = true, .detuning = Wavelengths{detuning_lambda}, .piezo = Volts{150.0}};
}

PerimeterLoopState at(const PerimeterLoopConfig& c, double set_point_v) { return initial_state(c, Volts{set_point_v}); }

// The set-point after one half: the last that is commanded.
double moved_v(const PerimeterLoopConfig& c, PerimeterLoopState& s, const PerimeterLoopInput& in) {
    const PerimeterLoopOutput out = step(c, s, in);
    return out.set_point_v[static_cast<std::size_t>(out.n_set_points - 1)];
}

TEST(PerimeterLoop, ASmallDetuningDecaysWithTheTimeConstant) {
    PerimeterLoopConfig slow = digital;
    slow.time_constant = Seconds{0.25};  // a hundred halves: a sampled integrator is then as good as a continuous one
    PerimeterLoopState s = at(slow, 150.0);
    constexpr double kp_lambda_v = 0.5 / 40.0;
    constexpr double target_v = 152.0;
    for (int k = 0; k < 100; ++k) (void)step(slow, s, measured(kp_lambda_v * (s.set_point_v - target_v)));
    EXPECT_NEAR((target_v - s.set_point_v) / 2.0, std::exp(-1.0), 0.003);
}

// 2.5 ms / 6.5 ms of 0.01 wavelength, 80 V per wavelength, against the detuning; of 0.24, what the limit of 0.09 lets
// pass.
TEST(PerimeterLoop, OneHalfMovesTheSetPointByItsShareOfTheDetuningUpToTheLimit) {
    for (const auto& [detuning_lambda, move_v] : {std::pair{0.01, 0.8}, {0.24, 7.2}, {-0.24, -7.2}}) {
        PerimeterLoopState s = at(digital, 150.0);
        EXPECT_NEAR(moved_v(digital, s, measured(detuning_lambda)), 150.0 - move_v * 2.5 / 6.5, 1e-12);
    }
}

TEST(PerimeterLoop, TheSetPointMovesNoFasterThanTheStageSlews) {
    PerimeterLoopConfig slow_stage = digital;
    slow_stage.slew_v_s = 400.0;  // 1 V in a half
    PerimeterLoopState s = at(slow_stage, 150.0);
    EXPECT_NEAR(moved_v(slow_stage, s, measured(-0.09)), 151.0, 1e-12);
    EXPECT_NEAR(moved_v(slow_stage, s, measured(0.09)), 150.0, 1e-12);
}

TEST(PerimeterLoop, TheEndsHoldAndLetGoAtOnce) {
    for (const double sign : {1.0, -1.0}) {
        PerimeterLoopState s = at(digital, 150.0);
        for (int k = 0; k < 1000; ++k) (void)step(digital, s, measured(sign * 0.09));
        const double end_v = sign > 0.0 ? 0.0 : 300.0;
        EXPECT_EQ(s.set_point_v, end_v);
        // No wind-up: the first error of the other sign acts in full.
        EXPECT_NEAR(std::abs(moved_v(digital, s, measured(-sign * 0.01)) - end_v), 0.8 * 2.5 / 6.5, 1e-12);
    }
}

TEST(PerimeterLoop, WhatWasNotMeasuredHolds) {
    PerimeterLoopState s = at(digital, 150.0);
    const PerimeterLoopState before = s;
    (void)step(digital, s, measured(not_a_number));
    (void)step(digital, s, measured(1.0 / 0.0));
    PerimeterLoopInput unusable = measured(0.05);
    unusable.usable = false;
    (void)step(digital, s, unusable);
    PerimeterLoopInput was_open = measured(0.05);
    was_open.was_closed = false;
    EXPECT_FALSE(step(digital, s, was_open).over_limit);
    EXPECT_EQ(s, before);
}

TEST(PerimeterLoop, TheSecondInputRulesWhileOpenAndPresetsTheLoop) {
    for (const PerimeterLoopConfig& c : {digital, analog}) {
        PerimeterLoopState s = at(c, 150.0);
        PerimeterLoopInput in = measured(0.05);
        in.close = false;
        in.second_input = Volts{190.0};
        EXPECT_EQ(moved_v(c, s, in), 190.0);
        in.second_input = Volts{not_a_number};
        EXPECT_EQ(moved_v(c, s, in), 190.0);
        in.second_input = Volts{500.0};
        EXPECT_EQ(moved_v(c, s, in), 300.0);
        in.close = true;
        in.was_closed = false;
        EXPECT_EQ(moved_v(c, s, in), 300.0);
    }
}

TEST(PerimeterLoop, AnAnalogLoopIsWatchedNotMoved) {
    PerimeterLoopState s = at(analog, 150.0);
    EXPECT_TRUE(step(analog, s, measured(0.11)).over_limit);
    EXPECT_TRUE(step(analog, s, measured(-0.11)).over_limit);
    EXPECT_FALSE(step(analog, s, measured(0.09)).over_limit);
    PerimeterLoopInput high = measured(0.0);
    high.piezo = Volts{295.0};
    EXPECT_TRUE(step(analog, s, high).near_range_end);
    high.piezo = Volts{not_a_number};
    EXPECT_FALSE(step(analog, s, high).near_range_end);  // the set-point stands in
    EXPECT_EQ(s.set_point_v, 150.0);
    s = at(analog, 295.0);
    EXPECT_TRUE(step(analog, s, high).near_range_end);
}

}  // namespace zlg::core::perimeter_loop_test
