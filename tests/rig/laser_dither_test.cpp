// Lock-in and its cure in the whole gyro: laser with phases, control that shifts the reversals, compensation that takes
// the known area off the counts.

#include <cmath>

#include <gtest/gtest.h>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

constexpr double fringe_arcsec = 3.263;
constexpr double zone_arcsec_s = fringe_arcsec / 0.005;  // distance of the dynamic zones

config::Config gyro(double lock_hz, double rate_arcsec_s, core::DitherMethod dither) {
    config::Config c;
    c.gyro.fidelity = config::Fidelity::laser;
    c.gyro.light_samples = 4;
    c.gyro.scale_arcsec = fringe_arcsec / 4.0;
    c.laser.quadrature = config::Quadrature::x4;
    c.laser.lock_in_left_hz = lock_hz;
    c.laser.lock_in_right_hz = lock_hz;
    c.drift.magnetic_arcsec_s = 0.0;
    c.drift.magnetic_thermal_arcsec_s = 0.0;
    c.drift.nonmagnetic_arcsec_s = 0.0;
    c.switching.interval_s = 1e6;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = rate_arcsec_s;
    c.gyro.dither = dither;
    return rig::calibrated_by_laser(c);
}

class GyroRun {
public:
    explicit GyroRun(const config::Config& c)
        : loop_{c, rig::motion(c)},
          compensation_{rig::compensation_config(c, core::RelockMethod::mean_square, c.compensation.bridge)} {}

    // Angle read less angle turned.
    double error_arcsec(int ticks) {
        double turned = 0.0;
        const double before = angle_;
        for (int h = 0; h < 2 * ticks; ++h) {
            const rig::LoopHalf half = loop_.advance();
            turned += half.truth.dtheta_arcsec;
            angle_ = step(compensation_, state_, half.record).angle_arcsec;
        }
        return angle_ - before - turned;
    }

    // After the loop has settled and the law is found.
    double mean_error_arcsec_s(int ticks) {
        error_arcsec(2000);
        return error_arcsec(ticks) / (ticks * 0.005);
    }

private:
    rig::ClosedLoop loop_;
    core::GyroCompensationConfig compensation_;
    core::GyroCompensationState state_;
    double angle_ = 0.0;
};

// 250 s can hide a quarter of a fringe, 0.0033 arcsec/s.
TEST(LaserDither, at_rest_there_is_no_bias) {
    GyroRun run{gyro(300.0, 0.0, core::DitherMethod::automatic)};
    EXPECT_NEAR(run.mean_error_arcsec_s(50'000), 0.0, 0.005);
}

TEST(LaserDither, a_slow_rotation_is_read_within_half_a_percent_that_would_be_held_without) {
    GyroRun plain{gyro(300.0, 2.0, core::DitherMethod::none)};
    EXPECT_NEAR(plain.mean_error_arcsec_s(8000), -2.0, 0.05);
    GyroRun cured{gyro(300.0, 2.0, core::DitherMethod::automatic)};
    EXPECT_NEAR(cured.mean_error_arcsec_s(100'000), 0.0, 0.005 * 2.0);
}

// A half that a shift made longer holds more counts than an even one; neither the counter nor its monitor may mind.
TEST(LaserDither, the_highest_rate_leaves_every_half_valid) {
    for (const double rate_arcsec_s : {-1.44e6, 1.44e6}) {
        const config::Config c = gyro(150.0, rate_arcsec_s, core::DitherMethod::automatic);
        rig::ClosedLoop loop{c, rig::motion(c)};
        for (int h = 0; h < 4000; ++h) ASSERT_TRUE(loop.advance().record.valid) << rate_arcsec_s << ", half " << h;
    }
}

// 100 s of a walk of 0.28 arcsec/sqrt(s) leave 0.028 arcsec/s.
TEST(LaserDither, there_is_no_step_at_the_dynamic_zones) {
    GyroRun plain{gyro(300.0, zone_arcsec_s + 2.0, core::DitherMethod::none)};
    EXPECT_NEAR(plain.mean_error_arcsec_s(8000), -2.0, 0.05);
    for (const double near : {-2.0, 0.0, 2.0}) {
        GyroRun cured{gyro(300.0, zone_arcsec_s + near, core::DitherMethod::automatic)};
        EXPECT_NEAR(cured.mean_error_arcsec_s(20'000), 0.0, 0.11) << near;
    }
    GyroRun other{gyro(300.0, -zone_arcsec_s + 2.0, core::DitherMethod::automatic)};
    EXPECT_NEAR(other.mean_error_arcsec_s(20'000), 0.0, 0.11);
}

// Over stretches of 2 s, rounding of the counter taken off. At f_L = 150 Hz random slips make 0.0024; one of 100
// numbers is good to a tenth or so.
double walk_deg_sqrt_h(double rate_arcsec_s) {
    const config::Config c = gyro(150.0, rate_arcsec_s, core::DitherMethod::automatic);
    constexpr int n = 100;
    constexpr int ticks = 400;
    GyroRun run{c};
    run.error_arcsec(2000);
    double sum = 0.0;
    double square = 0.0;
    for (int i = 0; i < n; ++i) {
        const double error = run.error_arcsec(ticks);
        sum += error / n;
        square += error * error / n;
    }
    const double rounding = c.gyro.scale_arcsec * c.gyro.scale_arcsec / 6.0;
    return std::sqrt(std::fmax(square - sum * sum - rounding, 0.0) / (ticks * 0.005)) / 60.0;
}

TEST(LaserDither, the_walk_is_that_of_random_slips_at_most) {
    EXPECT_LT(walk_deg_sqrt_h(2.0), 0.0024);
    EXPECT_LT(walk_deg_sqrt_h(150.0), 0.0040);
    EXPECT_NEAR(walk_deg_sqrt_h(5000.0), 0.0024, 0.3 * 0.0024);
}

}  // namespace
