#include <zlg/twin/environment_config.hpp>

#include "test.hpp"

namespace zlg::twin::environment_config_test {

// Without a profile and a field the gyro is what it was before there were any.
TEST(EnvironmentConfig, by_default_nothing_is_given) {
    EXPECT_FALSE(TemperatureConfig{}.profile.is_given());
    EXPECT_EQ(TemperatureConfig{}.sensor_lag_s, 0.0);
    EXPECT_EQ(TemperatureConfig{}.sensor_error_c, 0.0);
    EXPECT_EQ(FieldConfig{}.kind, FieldKind::none);
    EXPECT_FALSE(FieldConfig{}.course.is_given());
    // The field of the earth makes the drift of the default gyro.
    EXPECT_NEAR(FieldConfig{}.field_g * FieldConfig{}.sensitivity_arcsec_s_g, 0.7, 1e-12);
}

TEST(CourseConfig, is_given_by_points_or_by_a_file) {
    EXPECT_TRUE((CourseConfig{.points = {{0.0, 1.0}}}.is_given()));
    EXPECT_TRUE((CourseConfig{.path = "chamber.txt"}.is_given()));
    EXPECT_TRUE((CourseConfig{.path = "chamber.txt"}.is_file()));
    EXPECT_FALSE((CourseConfig{.points = {{0.0, 1.0}}}.is_file()));
}

}  // namespace zlg::twin::environment_config_test
