#include <gtest/gtest.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

TEST(Wiring, twin_and_compensation_share_the_gyro) {
    config::Config c;
    c.gyro.tick_s = 0.01;
    c.gyro.scale_arcsec = 0.816;
    c.gyro.bias_hz = 45e3;
    c.gyro.bias_chi = 5.0;
    c.gyro.light_samples = 25;
    c.gyro.bias_temperature_coefficient_per_c = -5e-4;
    const auto twin = rig::twin_config(c);
    const auto relock = rig::compensation_config(c, core::RelockMethod::detuning, core::BridgeMethod::linear).relock;
    EXPECT_EQ(twin.tick_s, relock.tick.value());
    EXPECT_EQ(twin.scale_arcsec, relock.scale.value());
    EXPECT_EQ(twin.bias_hz, relock.bias.value());
    EXPECT_EQ(twin.bias_chi, relock.chi);
    EXPECT_EQ(twin.light_samples, relock.light_samples);
    EXPECT_EQ(twin.bias_temperature_coefficient_per_c, relock.temperature_coefficient_per_c);
}

TEST(Wiring, control_presumes_the_half_wave_voltage_with_its_error) {
    config::Config c;
    c.piezo.half_wave_error = 0.05;
    EXPECT_EQ(rig::twin_config(c).half_wave_v, 40.0);
    EXPECT_DOUBLE_EQ(rig::control_config(c).half_wave.presumed.value(), 42.0);
}

TEST(Wiring, random_walk_enters_the_sigma_of_a_tick) {
    config::Config c;
    c.drift.random_walk_arcsec_sqrt_s = 2.0;
    const auto made = rig::compensation_config(c, core::RelockMethod::none, core::BridgeMethod::constant);
    EXPECT_EQ(made.random_walk.value(), 2.0);
}

TEST(Wiring, the_interval_is_counted_in_whole_ticks) {
    config::Config c;
    c.switching.interval_s = 7.0;
    c.switching.first_segment = config::FirstSegment::half;
    const auto schedule = rig::control_config(c).schedule;
    EXPECT_EQ(schedule.interval_ticks, 1400);
    EXPECT_EQ(first_tick(schedule), 700);
}

TEST(Wiring, a_run_lasts_an_hour_or_as_long_as_it_is_told) {
    config::Config c;
    const auto motion = rig::motion(c);
    EXPECT_EQ(rig::run_ticks(c, motion), 720000);
    c.run.duration_s = 0.3;  // 60 ticks of 5 ms, though 0.3/0.005 is below 60 in double
    EXPECT_EQ(rig::run_ticks(c, motion), 60);
    c.run.duration_s = 0.004;
    EXPECT_THROW((void)rig::run_ticks(c, motion), config::ConfigError);
}

TEST(Wiring, a_run_ends_with_its_sampled_motion) {
    const auto motion = twin::Motion::from_increments(std::vector<double>(100, 1.0), 100.0);
    config::Config c;
    EXPECT_EQ(rig::run_ticks(c, motion), 200);
    c.run.duration_s = 1.0;
    EXPECT_EQ(rig::run_ticks(c, motion), 200);
    c.run.duration_s = 1.01;
    EXPECT_THROW((void)rig::run_ticks(c, motion), config::ConfigError);
}

TEST(Wiring, a_polynomial_needs_more_points_than_its_order) {
    config::Config c;
    c.compensation.extrapolation_points = 2;
    EXPECT_NO_THROW((void)rig::compensation_config(c, core::RelockMethod::none, core::BridgeMethod::linear));
    EXPECT_THROW((void)rig::compensation_config(c, core::RelockMethod::none, core::BridgeMethod::quadratic),
                 config::ConfigError);
}

TEST(Wiring, one_phase_serves_all_sines_of_a_sum) {
    config::Config c;
    c.motion.kind = config::MotionKind::sum;
    c.motion.amplitude_arcsec_s = {100.0, 50.0};
    c.motion.frequency_hz = {1.0, 2.0};
    c.motion.phase_deg = {90.0};
    // Cosines: over a quarter of the slow period, A/(2 pi f) sin of the phase run through.
    constexpr double pi = 3.14159265358979323846;
    EXPECT_NEAR(rig::motion(c).increment_arcsec(0.0, 0.25), 100.0 / (2.0 * pi), 1e-9);
}

}  // namespace
