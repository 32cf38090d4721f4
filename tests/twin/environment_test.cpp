#include <zlg/twin/environment.hpp>

#include "quiet_gyro.hpp"

namespace zlg::twin::environment_test {

const std::vector<CoursePoint> points{{10.0, 1.0}, {20.0, 5.0}, {40.0, -5.0}};

TEST(Course, is_straight_between_its_points_and_even_outside) {
    EXPECT_EQ(between(points, 0.0), 1.0);
    EXPECT_EQ(between(points, 10.0), 1.0);
    EXPECT_EQ(between(points, 12.5), 2.0);
    EXPECT_EQ(between(points, 30.0), 0.0);
    EXPECT_EQ(between(points, 41.0), -5.0);
}

TEST(Course, of_steps_holds_each_from_its_time_on) {
    EXPECT_EQ(stepped(points, 0.0), 1.0);
    EXPECT_EQ(stepped(points, 19.9), 1.0);
    EXPECT_EQ(stepped(points, 20.0), 5.0);
    EXPECT_EQ(stepped(points, 100.0), -5.0);
}

TEST(Field, is_of_its_kind) {
    FieldConfig field{.field_g = 0.5, .frequency_hz = 0.25, .course = {.points = points}};
    EXPECT_EQ(field_g(field, 1.0), 0.0);
    field.kind = FieldKind::constant;
    EXPECT_EQ(field_g(field, 1.0), 0.5);
    field.kind = FieldKind::sine;
    EXPECT_NEAR(field_g(field, 1.0), 0.5, 1e-12);
    EXPECT_NEAR(field_g(field, 2.0 + 1.0 / 3.0), -0.25, 1e-12);
    EXPECT_NEAR(field_g(field, 400'000'001.0), 0.5, 1e-12);
    field.kind = FieldKind::steps;
    EXPECT_EQ(field_g(field, 30.0), 5.0);
    field.kind = FieldKind::file;
    EXPECT_EQ(field_g(field, 30.0), 0.0);
}

TEST(Field, drifts_by_a_sensitivity_that_is_linear_in_temperature) {
    const FieldConfig field{
        .kind = FieldKind::constant, .field_g = 0.5, .sensitivity_arcsec_s_g = 4.0, .sensitivity_per_c = -0.01};
    EXPECT_EQ(magnetic_arcsec_s(field, 0.0, 7.0), 2.0);
    EXPECT_NEAR(magnetic_arcsec_s(field, 25.0, 7.0), 1.5, 1e-12);
}

TEST(TemperatureSpan, is_that_of_the_profile_or_of_the_gyros_own_warming) {
    GyroConfig gyro;
    gyro.temperature_rise_c = -8.0;
    EXPECT_EQ(temperature_span(gyro, {}).least_c, -8.0);
    EXPECT_EQ(temperature_span(gyro, {}).most_c, 0.0);
    const TemperatureConfig temperature{.profile = {.points = {{0.0, 30.0}, {1.0, -20.0}, {2.0, 25.0}}}};
    EXPECT_EQ(temperature_span(gyro, temperature).least_c, -40.0);
    EXPECT_EQ(temperature_span(gyro, temperature).most_c, 10.0);
}

// The twin in its environment.
constexpr double ramp_c_s = 10.0;

TwinConfig ramped_gyro() {
    TwinConfig config = held_gyro();
    config.temperature.profile.points = {{0.0, -10.0}, {4.0, -10.0 + 4.0 * ramp_c_s}};
    return config;
}

double temperature_after_c(const TwinConfig& config, int n_halves) {
    Twin twin{config, Motion::rest()};
    return advance(twin, frame(true, 1), n_halves).back().sensor.temperature_c;
}

TEST(TwinInEnvironment, has_the_temperature_of_the_profile) {
    EXPECT_NEAR(temperature_after_c(ramped_gyro(), 400), -10.0 + ramp_c_s, 1e-9);
    EXPECT_NEAR(temperature_after_c(ramped_gyro(), 2400), 30.0, 1e-9);
}

// A first-order lag behind a ramp: slope (t - lag (1 - exp(-t/lag))).
TEST(TwinInEnvironment, has_a_sensor_that_lags_and_errs) {
    TwinConfig config = ramped_gyro();
    config.temperature.sensor_lag_s = 0.5;
    config.temperature.sensor_error_c = 0.75;
    const double behind_c = ramp_c_s * 0.5 * (1.0 - std::exp(-1.0 / 0.5));
    EXPECT_NEAR(temperature_after_c(config, 400), -10.0 + ramp_c_s - behind_c + 0.75, 0.02);
}

// Both directions of the bias cancel over a tick, so what is left of the counts is drift.
double counted_arcsec(const TwinConfig& config, int n_halves, int polarity = 1) {
    Twin twin{config, Motion::rest()};
    (void)twin.advance(frame(true, polarity));
    const auto halves = advance(twin, frame(true, polarity), n_halves);
    const auto counts = static_cast<std::int64_t>(halves.back().sensor.counter - halves.front().sensor.counter);
    return config.gyro.scale_arcsec * static_cast<double>(counts);
}

TEST(TwinInEnvironment, drifts_by_its_field_and_no_more_by_its_drift) {
    TwinConfig config = held_gyro();
    config.drift.magnetic_arcsec_s = 1e6;
    config.field = {.kind = FieldKind::constant, .field_g = 0.5, .sensitivity_arcsec_s_g = 2000.0};
    // 2001 halves from the end of the first: 1000 ticks of 5 ms.
    EXPECT_NEAR(std::abs(counted_arcsec(config, 2001)), 1000.0 * 5.0, 7.0);
    config.field.kind = FieldKind::steps;
    config.field.course.points = {{0.0, 0.5}, {2.5, -0.5}};
    EXPECT_NEAR(counted_arcsec(config, 2001), 0.0, 12.0);
}

// Mean counts of a half, signs taken off, of a gyro that turns enough to round anew in every half.
double mean_counts(TwinConfig config, double temperature_c) {
    config.gyro.bias_temperature_coefficient_per_c = 0.005;  // as its processor presumes
    config.gyro.bias_temperature_table.points = {{0.0, 0.0}, {20.0, 0.01}, {60.0, -0.03}};
    config.temperature.profile.points = {{0.0, temperature_c}, {1.0, temperature_c}};
    Twin twin{config, Motion::sines(1217.3, {})};
    const auto halves = advance(twin, frame(true, 1), 4001);
    double sum = 0.0;
    for (std::size_t h = 1; h < halves.size(); ++h)
        sum += halves[h].sensor.bias_sign * static_cast<double>(count_between(halves[h - 1], halves[h]));
    return sum / 4000.0;
}

TEST(TwinInEnvironment, the_bias_follows_its_table) {
    const double unchanged = mean_counts(held_gyro(), 0.0);
    for (const auto& [at_c, change] :
         {std::pair{-50.0, 0.0}, {10.0, 0.005}, {20.0, 0.01}, {40.0, -0.01}, {90.0, -0.03}})
        EXPECT_NEAR(mean_counts(held_gyro(), at_c) / unchanged - 1.0, change, 3e-4) << at_c;
}

TEST(TwinInEnvironment, the_bias_of_a_laser_follows_its_table) {
    TwinConfig laser = held_gyro();
    laser.gyro.fidelity = Fidelity::laser;
    laser.laser.beam_power_w = 0.0;
    EXPECT_NEAR(mean_counts(laser, 40.0) / mean_counts(laser, 0.0) - 1.0, -0.01, 3e-4);
}

TEST(TwinInEnvironment, refuses_a_table_that_turns_its_bias_over) {
    TwinConfig config = ramped_gyro();
    config.gyro.bias_temperature_table.points = {{0.0, 0.0}, {20.0, -1.0}};
    EXPECT_THROW((Twin{config, Motion::rest()}), std::invalid_argument);
}

TEST(TwinInEnvironment, refuses_a_profile_that_its_gyro_cannot_follow) {
    TwinConfig config = ramped_gyro();
    config.gyro.temperature_rise_c = 0.0;
    EXPECT_THROW((Twin{config, Motion::rest()}), std::invalid_argument);
    config = ramped_gyro();
    config.gyro.bias_temperature_coefficient_per_c = 0.04;
    EXPECT_THROW((Twin{config, Motion::rest()}), std::invalid_argument);
    config.gyro.bias_temperature_coefficient_per_c = 0.03;
    EXPECT_NO_THROW((Twin{config, Motion::rest()}));
}

}  // namespace zlg::twin::environment_test
