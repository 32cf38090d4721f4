// Lock-in and its cure in the whole gyro: laser with phases, control that shifts the reversals, compensation that takes
// the known area off the counts, and is told the threshold or is not.

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::laser_dither_test {

constexpr double fringe_arcsec = 3.263;

config::Config gyro(double lock_hz, double rate_arcsec_s, core::DitherMethod dither) {
    config::Config c;
    c.gyro.fidelity = config::Fidelity::laser;
    c.gyro.light_samples = 4;
    c.gyro.scale_arcsec = fringe_arcsec / 4.0;
    c.laser.quadrature = config::Quadrature::x4;
    c.laser.lock_in_left_hz = lock_hz;
    c.laser.lock_in_right_hz = lock_hz;
    c.laser.beam_power_w = 0.0;  // quantum noise walks more than what lock-in leaves
    c.drift.magnetic_arcsec_s = 0.0;
    c.drift.magnetic_thermal_arcsec_s = 0.0;
    c.drift.nonmagnetic_arcsec_s = 0.0;
    c.switching.interval_s = 1e6;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = rate_arcsec_s;
    c.gyro.dither = dither;
    return c;
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
    GyroRun run{rig::calibrated_by_laser(gyro(300.0, 0.0, core::DitherMethod::automatic))};
    EXPECT_NEAR(run.mean_error_arcsec_s(50'000), 0.0, 0.005);
}

TEST(LaserDither, a_slow_rotation_is_read_within_half_a_percent_that_would_be_held_without) {
    GyroRun plain{rig::calibrated_by_laser(gyro(300.0, 2.0, core::DitherMethod::none))};
    EXPECT_NEAR(plain.mean_error_arcsec_s(8000), -2.0, 0.05);
    GyroRun cured{rig::calibrated_by_laser(gyro(300.0, 2.0, core::DitherMethod::automatic))};
    EXPECT_NEAR(cured.mean_error_arcsec_s(100'000), 0.0, 0.005 * 2.0);
}

// A half that a shift made longer holds more counts than an even one; neither the counter nor its monitor may mind.
TEST(LaserDither, the_highest_rate_leaves_every_half_valid) {
    for (const double rate_arcsec_s : {-1.44e6, 1.44e6}) {
        const config::Config c = rig::calibrated_by_laser(gyro(150.0, rate_arcsec_s, core::DitherMethod::automatic));
        rig::ClosedLoop loop{c, rig::motion(c)};
        for (int h = 0; h < 4000; ++h) ASSERT_TRUE(loop.advance().record.valid) << rate_arcsec_s << ", half " << h;
    }
}

// In a minute with five switches.
TEST(LockInLoop, a_calibrated_threshold_takes_the_scale_error_away_in_the_whole_gyro) {
    for (const double rate_arcsec_s : {188e3, -188e3}) {
        const auto scale_error_ppm = [&](double calibrated_hz, double sigma_hz) {
            config::Config c = gyro(300.0, rate_arcsec_s, core::DitherMethod::automatic);
            c.switching.interval_s = 10.0;
            c.compensation.lock_in_hz = calibrated_hz;
            c.compensation.lock_in_sigma_hz = sigma_hz;
            return 1e6 * GyroRun{rig::calibrated_by_laser(c)}.mean_error_arcsec_s(12'000) / rate_arcsec_s;
        };
        EXPECT_NEAR(scale_error_ppm(0.0, 300.0), 136.0, 10.0);
        EXPECT_NEAR(scale_error_ppm(300.0, 3.0), 0.0, 0.06 * 136.0);
    }
}

}  // namespace zlg::laser_dither_test
