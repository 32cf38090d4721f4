#include <gtest/gtest.h>

#include <cmath>
#include <vector>
#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>

using namespace zlg::config;
using zlg::core::BridgeMethod;

// The published gyro: a 0.16 m ring with 3.263 arcsec per count, 200 Hz ticks, 60 kHz bias and a switch every 90 s.
TEST(Config, the_defaults_are_the_published_gyro) {
    const Config c;
    EXPECT_EQ(c.gyro.tick_s, 0.005);
    EXPECT_EQ(c.gyro.scale_arcsec, 3.263);
    EXPECT_EQ(c.gyro.bias_hz, 60e3);
    EXPECT_EQ(c.gyro.bias_chi, 3.6);
    EXPECT_EQ(c.gyro.light_samples, 16);
    EXPECT_EQ(c.gyro.light_noise_lambda, 0.0033);
    EXPECT_EQ(c.drift.magnetic_arcsec_s, 0.7);
    EXPECT_EQ(c.drift.magnetic_thermal_arcsec_s, 0.7);
    EXPECT_EQ(c.drift.thermal_time_s, 3000.0);
    EXPECT_EQ(c.drift.nonmagnetic_arcsec_s, 0.05);
    EXPECT_EQ(c.drift.random_walk_arcsec_sqrt_s, 0.14);
    EXPECT_EQ(c.perimeter.loop, Loop::analog);
    EXPECT_EQ(c.perimeter.tau_s, 0.0065);
    EXPECT_EQ(c.perimeter.limit_lambda, 0.09);
    EXPECT_EQ(c.perimeter.miss_lambda, 0.22);
    EXPECT_EQ(c.piezo.half_wave_v, 40.0);
    EXPECT_EQ(c.piezo.rc_s, 0.001);
    EXPECT_EQ(c.piezo.slew_v_s, 4000.0);
    EXPECT_EQ(c.switching.interval_s, 90.0);
    EXPECT_EQ(c.switching.first_segment, FirstSegment::full);
    EXPECT_EQ(c.switching.gap_ticks, 3);
    EXPECT_EQ(c.design.switch_error_arcsec, 10.0);
}

TEST(Config, the_default_compensation_is_automatic_over_four_and_two_and_two_points) {
    const Config c;
    EXPECT_FALSE(c.compensation.relock.has_value());
    EXPECT_EQ(c.compensation.relock_ticks, 20);
    EXPECT_EQ(c.compensation.bridge, BridgeMethod::automatic);
    EXPECT_EQ(c.compensation.extrapolation_points, 4);
    EXPECT_EQ(c.compensation.points_before, 2);
    EXPECT_EQ(c.compensation.points_after, 2);
}

// With a whole number of periods in an interval every switch would meet the motion in the same phase.
TEST(Config, the_default_motion_is_no_whole_number_of_periods_in_an_interval) {
    const Config c;
    ASSERT_EQ(c.motion.kind, MotionKind::sine);
    EXPECT_EQ(c.motion.amplitude_arcsec_s, std::vector<double>{12000.0});
    const double periods = c.motion.frequency_hz.at(0) * c.switching.interval_s;
    EXPECT_NEAR(periods - std::floor(periods), 0.7, 1e-9);
}

TEST(Config, the_defaults_pass_their_own_check) {
    EXPECT_NO_THROW(check(Config{}));
    EXPECT_NO_THROW(check_compensation(Config{}));
}
