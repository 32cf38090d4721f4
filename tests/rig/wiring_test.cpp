#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::wiring_test {

TEST(Wiring, twin_and_compensation_share_the_gyro) {
    config::Config c;
    c.gyro.tick_s = 0.01;
    c.gyro.scale_arcsec = 0.816;
    c.gyro.bias_hz = 45e3;
    c.gyro.bias_chi = 5.0;
    c.gyro.light_samples = 25;
    c.gyro.bias_temperature_coefficient_per_c = -5e-4;
    const auto twin = rig::twin_config(c);
    const auto gyro = rig::compensation_config(c, core::RelockMethod::detuning, core::BridgeMethod::linear).gyro;
    EXPECT_EQ(twin.gyro.tick_s, gyro.tick.value());
    EXPECT_EQ(twin.gyro.scale_arcsec, gyro.scale.value());
    EXPECT_EQ(twin.gyro.bias_hz, gyro.bias.value());
    EXPECT_EQ(twin.gyro.bias_chi, gyro.chi);
    EXPECT_EQ(twin.gyro.light_samples, gyro.light_samples);
    EXPECT_EQ(twin.gyro.bias_temperature_coefficient_per_c, gyro.temperature_coefficient_per_c);
}

// The sections are the same structs on both sides; one member of each shows that none is left out.
TEST(Wiring, every_section_of_the_gyro_reaches_the_twin) {
    config::Config c;
    c.run.seed = 7;
    c.gyro.fidelity = config::Fidelity::laser;
    c.drift.thermal_time_s = 1234.0;
    c.perimeter.loop = config::Loop::digital;
    c.piezo.rc_s = 0.002;
    c.laser.quadrature = config::Quadrature::x4;
    c.faults = {.kind = {twin::FaultKind::shock}, .at_s = {1.0}, .duration_s = {0.01}, .size = {0.1}};
    const twin::TwinConfig made = rig::twin_config(c);
    EXPECT_EQ(made.seed, 7u);
    EXPECT_EQ(made.gyro.fidelity, twin::Fidelity::laser);
    EXPECT_EQ(made.drift.thermal_time_s, 1234.0);
    EXPECT_EQ(made.perimeter.loop, twin::Loop::digital);
    EXPECT_EQ(made.piezo.rc_s, 0.002);
    EXPECT_EQ(made.laser.quadrature, twin::Quadrature::x4);
    EXPECT_EQ(made.faults.size(), 1u);
}

TEST(Wiring, control_presumes_the_half_wave_voltage_with_its_error) {
    config::Config c;
    c.piezo.half_wave_error = 0.05;
    EXPECT_EQ(rig::twin_config(c).piezo.half_wave_v, 40.0);
    EXPECT_DOUBLE_EQ(rig::control_config(c).half_wave.half_wave.value(), 42.0);
}

TEST(Wiring, random_walk_enters_the_sigma_of_a_tick) {
    config::Config c;
    c.drift.random_walk_arcsec_sqrt_s = 2.0;
    const auto made = rig::compensation_config(c, core::RelockMethod::none, core::BridgeMethod::constant);
    EXPECT_EQ(made.gyro.random_walk.value(), 2.0);
}

TEST(Wiring, the_interval_is_counted_in_whole_ticks) {
    config::Config c;
    c.switching.interval_s = 7.0;
    c.switching.first_segment = config::FirstSegment::half;
    const auto schedule = rig::control_config(c).schedule;
    EXPECT_EQ(schedule.interval_ticks, 1400);
    EXPECT_EQ(first_tick(schedule), 700);
}

TEST(Wiring, a_schedule_is_given_its_limits) {
    config::Config c;
    c.switching.schedule = config::Schedule::measured;
    c.switching.interval_min_s = 12.0;
    c.switching.interval_max_s = 345.0;
    const auto schedule = rig::control_config(c).schedule;
    EXPECT_EQ(schedule.kind, core::ScheduleKind::measured);
    EXPECT_EQ(schedule.min_ticks, 2400);
    EXPECT_EQ(schedule.max_ticks, 69000);
    EXPECT_EQ(schedule.tick_s, 0.005);
    EXPECT_EQ(rig::control_config(rig::without_switching(c)).schedule.kind, core::ScheduleKind::fixed);
}

TEST(Wiring, the_magnetic_estimate_is_told_the_calibration) {
    config::Config c;
    c.compensation.magnetic = core::MagneticMethod::estimate;
    c.compensation.magnetic_arcsec_s = 0.6;
    c.compensation.magnetic_sigma_arcsec_s = 0.05;
    c.compensation.magnetic_thermal_arcsec_s = 0.5;
    c.compensation.magnetic_thermal_sigma_arcsec_s = 0.1;
    c.compensation.magnetic_thermal_time_s = 2500.0;
    const auto made = rig::compensation_config(c, core::RelockMethod::none, core::BridgeMethod::constant).magnetic;
    EXPECT_EQ(made.method, core::MagneticMethod::estimate);
    EXPECT_EQ(made.presumed_arcsec_s, 0.6);
    EXPECT_EQ(made.presumed_sigma_arcsec_s, 0.05);
    EXPECT_EQ(made.warming_arcsec_s, 0.5);
    EXPECT_EQ(made.warming_sigma_arcsec_s, 0.1);
    EXPECT_EQ(made.thermal_time.value(), 2500.0);
}

TEST(Wiring, the_threshold_of_lock_in_is_counted_as_the_beat_is) {
    config::Config c;
    c.compensation.lock_in_hz = 140.0;
    c.compensation.lock_in_sigma_hz = 2.0;
    const auto made = [&] {
        return rig::compensation_config(c, core::RelockMethod::none, core::BridgeMethod::constant).lock_in;
    };
    EXPECT_EQ(made().threshold.value(), 140.0);
    EXPECT_EQ(made().sigma.value(), 2.0);
    c.laser.quadrature = config::Quadrature::x4;
    EXPECT_EQ(made().threshold.value(), 560.0);
    EXPECT_EQ(made().sigma.value(), 8.0);
    c.compensation.lock_in_hz = -1.0;
    EXPECT_THROW((void)made(), config::ConfigError);
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

TEST(Wiring, a_recorded_motion_is_refused_where_no_files_are_read) {
    config::Config c;
    c.motion.kind = config::MotionKind::file;
    c.motion.path = "motion.txt";
    EXPECT_THROW((void)rig::motion(c), config::ConfigError);
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

TEST(Wiring, control_and_compensation_share_the_timer_and_the_plateau) {
    config::Config c;
    EXPECT_EQ(rig::control_config(c).commutator.dither.method, core::DitherMethod::none);
    c.gyro.dither = core::DitherMethod::automatic;
    c.gyro.bias_hz = 45e3;
    c.gyro.bias_edge_s = 50e-6;
    c.run.seed = 7;
    const core::EdgeDitherConfig dither = rig::control_config(c).commutator.dither;
    const auto made = rig::compensation_config(c, core::RelockMethod::none, core::BridgeMethod::constant);
    EXPECT_EQ(dither.method, core::DitherMethod::automatic);
    EXPECT_EQ(dither.seed, 7u);
    EXPECT_EQ(made.gyro.timer.value(), 1e7);
    // 50 us of 5 ms are edges; the rest is a plateau of 45e3/0.99 Hz.
    EXPECT_DOUBLE_EQ(made.gyro.plateau_ratio, 1.0 / 0.99);
    EXPECT_DOUBLE_EQ(dither.cycle_ticks, 1e7 * 0.99 / 45e3);
}

TEST(Wiring, a_bias_that_the_timer_cannot_resolve_is_not_dithered) {
    config::Config c;
    c.gyro.dither = core::DitherMethod::paired;
    c.gyro.bias_hz = 1e8;
    EXPECT_THROW((void)rig::control_config(c), config::ConfigError);
    c.gyro.dither = core::DitherMethod::none;
    EXPECT_NO_THROW((void)rig::control_config(c));
}

TEST(Wiring, the_detector_reads_through_the_calibrated_curve) {
    config::Config c;
    EXPECT_EQ(rig::control_config(c).detector.curve.n_nodes, 0);
    for (const double sign : {1.0, -1.0}) {
        c.gyro.discriminator_per_lambda = 0.5 * sign;
        c.perimeter.discriminator_detuning_lambda = {0.1, 0.2};
        c.perimeter.discriminator_signal = {0.05, 0.2};
        const core::DiscriminatorCurve curve = rig::control_config(c).detector.curve;
        EXPECT_NEAR(core::true_detuning(curve, 0.05 / 0.5).detuning_lambda, 0.1, 1e-15);
        EXPECT_NEAR(core::true_detuning(curve, -0.2 / 0.5).detuning_lambda, -0.2, 1e-15);
    }
    c.perimeter.discriminator_signal = {0.05, 900.0};
    EXPECT_THROW((void)rig::control_config(c), config::ConfigError);
}

// Joint estimation reads the light as the control does.
TEST(Wiring, light_samples_of_joint_are_read_through_the_discriminator_of_the_control) {
    config::Config c;
    c.gyro.discriminator_per_lambda = -0.4;
    c.gyro.light_noise_lambda = 0.002;
    c.gyro.light_samples = 25;
    c.perimeter.discriminator_detuning_lambda = {0.1, 0.2};
    c.perimeter.discriminator_signal = {0.05, 0.2};
    const auto made = rig::compensation_config(c, core::RelockMethod::joint, core::BridgeMethod::constant);
    EXPECT_EQ(made.profile.discriminator_per_lambda, -0.4);
    EXPECT_EQ(made.profile.curve, rig::control_config(c).detector.curve);
    EXPECT_EQ(made.gyro.light_noise.value(), 0.002);
    EXPECT_EQ(made.gyro.light_samples, 25);
    EXPECT_EQ(made.gyro.record_curve.n_nodes, 0) << "the control has been through the curve";
}

}  // namespace zlg::wiring_test
