#include <zlg/core/control/gyro_control_state.hpp>
#include <zlg/core/gyro_control.hpp>

#include "support.hpp"

namespace zlg::core::gyro_control_state_test {

constexpr auto fault(auto change) { return test::fault_of<GyroControlConfig>(change); }
static_assert(check(GyroControlConfig{}) == GyroControlFault::none);
static_assert(fault([](auto& c) { c.loop.kind = LoopKind::digital; }) == GyroControlFault::none);
static_assert(fault([](auto& c) { c.detector.dark_fraction = not_a_number; }) == GyroControlFault::detector);
static_assert(fault([](auto& c) { c.loop.slew_v_s = not_a_number; }) == GyroControlFault::loop);
static_assert(fault([](auto& c) { c.half_wave.half_wave = Volts{0.0}; }) == GyroControlFault::half_wave);
static_assert(fault([](auto& c) { c.schedule.interval_ticks = 0; }) == GyroControlFault::schedule);
static_assert(fault([](auto& c) { c.mode_switch.gap_ticks = 0; }) == GyroControlFault::mode_switch);
static_assert(fault([](auto& c) { c.commutator.half_ticks = 0; }) == GyroControlFault::commutator);
static_assert(fault([](auto& c) { c.limits.counts = -1; }) == GyroControlFault::monitors);
static_assert(fault([](auto& c) { c.presumed_temperature = Celsius{not_a_number}; }) == GyroControlFault::temperature);
static_assert(fault([](auto& c) { c.loop.range.max = Volts{290.0}; }) == GyroControlFault::ranges_differ);
static_assert(fault([](auto& c) { c.commutator.dither = {.method = DitherMethod::paired, .cycle_ticks = 4000.0}; }) ==
              GyroControlFault::commutator);

TEST(GyroControlState, StartsAtTheSetPointTheCounterAndTheTemperatureThatArePresumed) {
    GyroControlConfig config;
    config.mode_switch.start_set_point = Volts{160.0};
    config.mode_switch.start_polarity = -1;
    config.presumed_temperature = Celsius{35.0};
    const GyroControlState state = initial_state(config, 1234);
    EXPECT_EQ(state.loop.set_point_v, 160.0);
    EXPECT_EQ(state.piezo_v, 160.0);
    EXPECT_EQ(state.counter, 1234u);
    EXPECT_EQ(state.temperature_c, 35.0);
    EXPECT_EQ(state.half, 0);
    EXPECT_EQ(state.up_v, -state.down_v);
    const ActuatorFrame first = initial_actuator(config);
    EXPECT_TRUE(first.loop_closed);
    EXPECT_EQ(first.polarity, -1);
    EXPECT_EQ(first.n_set_points, 1);
    EXPECT_EQ(first.set_point_v[0], 160.0);
}

}  // namespace zlg::core::gyro_control_state_test
