// Lock-in in the whole gyro: laser with phases, control, compensation that is told the threshold or is not.

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace {

using namespace zlg;

constexpr double lock_hz = 300.0;

config::Config gyro(double rate_arcsec_s, double calibrated_hz, double sigma_hz) {
    config::Config c;
    c.gyro.fidelity = config::Fidelity::laser;
    c.gyro.light_samples = 4;
    c.gyro.dither = core::DitherMethod::automatic;
    c.laser.lock_in_left_hz = lock_hz;
    c.laser.lock_in_right_hz = lock_hz;
    c.drift.magnetic_arcsec_s = 0.0;
    c.drift.magnetic_thermal_arcsec_s = 0.0;
    c.drift.nonmagnetic_arcsec_s = 0.0;
    c.switching.interval_s = 10.0;
    c.compensation.lock_in_hz = calibrated_hz;
    c.compensation.lock_in_sigma_hz = sigma_hz;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = rate_arcsec_s;
    return rig::calibrated_by_laser(c);
}

struct Sums {
    double scale_error_ppm = 0.0;
    double delivered_less_final_arcsec = 0.0;
};

// Of the ticks of a minute with five switches; both increments over those that are final.
Sums run(const config::Config& c) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    const auto compensation =
        rig::compensation_config(c, core::RelockMethod::mean_square, core::BridgeMethod::automatic);
    core::GyroCompensationState state;
    constexpr int n_ticks = 12'000;
    double turned = 0.0, delivered = 0.0, final_sum = 0.0;
    for (int h = 0; h < 2 * n_ticks; ++h) {
        const rig::LoopHalf half = loop.advance();
        turned += half.truth.dtheta_arcsec;
        const core::CompensationOutput out = step(compensation, state, half.record);
        if (!out.has_sample) continue;
        delivered += out.sample.dtheta_arcsec;
        if (out.sample.has_final) final_sum += out.sample.final_row.dtheta_final_arcsec;
    }
    for (;;) {
        const core::DrainOutput out = drain(compensation, state);
        if (out.has_row) final_sum += out.row.dtheta_final_arcsec;
        if (!out.has_row && !out.has_gap) break;
    }
    return {1e6 * (delivered - turned) / turned, delivered - final_sum};
}

TEST(LockInLoop, a_calibrated_threshold_takes_the_scale_error_away_in_the_whole_gyro) {
    for (const double rate_arcsec_s : {188e3, -188e3}) {
        const Sums plain = run(gyro(rate_arcsec_s, 0.0, 300.0));
        const Sums corrected = run(gyro(rate_arcsec_s, lock_hz, 3.0));
        EXPECT_NEAR(plain.scale_error_ppm, 136.0, 10.0);
        EXPECT_NEAR(corrected.scale_error_ppm, 0.0, 0.06 * 136.0);
        EXPECT_NEAR(corrected.delivered_less_final_arcsec, 0.0, 1e-6);
    }
}

}  // namespace
