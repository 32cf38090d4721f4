#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::switch_count_test {

config::Config every_second() {
    config::Config c;
    c.switching.interval_s = 1.0;
    return c;
}

rig::SwitchTally counted(const config::Config& c, int ticks) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    rig::SwitchCount count{c};
    for (int h = 0; h < 2 * ticks; ++h) count.take(loop.advance());
    return count.tally();
}

TEST(SwitchCount, counts_the_switches_of_a_sound_gyro) {
    const rig::SwitchTally count = counted(every_second(), 1100);
    EXPECT_EQ(count.succeeded, 5);
    EXPECT_EQ(count.failed, 0);
    EXPECT_FALSE(count.none_succeeded());
}

TEST(SwitchCount, counts_what_fails) {
    config::Config c = every_second();
    c.perimeter.miss_lambda = 0.0;
    c.faults.kind = {twin::FaultKind::switch_no_mode};
    c.faults.at_s = {1.9};
    c.faults.duration_s = {0.2};
    c.faults.size = {0.25};
    const rig::SwitchTally count = counted(c, 1100);
    EXPECT_EQ(count.succeeded, 4);
    EXPECT_EQ(count.failed, 1);
}

// Half a wavelength takes far more than is presumed.
config::Config never_arriving() {
    config::Config c = every_second();
    c.perimeter.miss_lambda = 0.0;
    c.piezo.half_wave_error = -0.5;
    return c;
}

TEST(SwitchCount, says_when_none_succeeds) {
    const rig::SwitchTally count = counted(never_arriving(), 1100);
    EXPECT_EQ(count.succeeded, 0);
    EXPECT_GT(count.failed, 0);
    EXPECT_TRUE(count.none_succeeded());
}

TEST(SwitchCount, has_one_line_for_a_reader_where_some_failed) {
    EXPECT_EQ(rig::sentence({5, 0}), "");
    zlg::test::expect_contains(rig::sentence({5, 2}), "2 of 7 switches");
    zlg::test::expect_contains(rig::sentence({0, 2}), "no switch of modes succeeded, 2 failed");
}

TEST(SwitchCount, a_switch_that_is_under_way_has_not_failed) {
    EXPECT_EQ(counted(every_second(), 210).failed, 0);
    EXPECT_FALSE(counted(every_second(), 210).none_succeeded());
    EXPECT_FALSE(counted(every_second(), 150).none_succeeded());
}

TEST(SwitchCount, a_gyro_whose_light_goes_out_in_a_switch_has_failed_by_the_time_its_control_gives_up) {
    config::Config c = every_second();
    c.faults.kind = {twin::FaultKind::laser_off};
    c.faults.at_s = {1.001};
    c.faults.duration_s = {100.0};
    c.faults.size = {1.0};
    EXPECT_FALSE(counted(c, 220).none_succeeded());
    EXPECT_TRUE(counted(c, 400).none_succeeded());
}

}  // namespace zlg::switch_count_test
