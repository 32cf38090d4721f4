#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>

#include "test.hpp"

using namespace zlg::config;
using zlg::core::BridgeMethod;

// A switch every 90 s; the gyro itself: GyroConfig.
TEST(Config, the_defaults_are_the_published_gyro) {
    const Config c;
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
