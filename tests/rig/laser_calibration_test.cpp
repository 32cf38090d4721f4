#include <zlg/rig/laser_calibration.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <zlg/config/schema.hpp>
#include <zlg/core/discriminator_curve.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/four_wave.hpp>

namespace {

using namespace zlg;

TEST(LaserCalibration, tells_the_processor_the_published_figures_of_the_default_gyro) {
    const config::Config c = rig::calibrated_by_laser({});
    EXPECT_NEAR(c.gyro.bias_hz, 60430.0 * 0.99, 5.0);
    EXPECT_NEAR(c.gyro.bias_chi, 3.59, 0.005);
    EXPECT_NEAR(c.gyro.discriminator_per_lambda, 0.332, 0.003);
    EXPECT_NO_THROW(config::check(c));
}

TEST(LaserCalibration, counts_by_quarters_have_four_times_the_bias) {
    config::Config c;
    c.laser.quadrature = config::Quadrature::x4;
    EXPECT_NEAR(rig::calibrated_by_laser(c).gyro.bias_hz, 4.0 * 60430.0 * 0.99, 20.0);
}

TEST(LaserCalibration, the_core_reads_the_detuning_of_the_four_wave_light) {
    const config::Config c = rig::calibrated_by_laser({});
    const core::DiscriminatorCurve curve = rig::control_config(c).detector.curve;
    const twin::FourWave laser{twin::LaserConfig{}};
    for (double dl = 0.001; dl < 0.235; dl += 0.0017) {
        const double apparent = laser.at(dl, 15.0).discriminator() / c.gyro.discriminator_per_lambda;
        EXPECT_NEAR(core::true_detuning(curve, apparent).detuning_lambda, dl, dl < 0.2 ? 2e-4 : 1e-3);
    }
}

// Unequal isotopes move the place of equal beams away from the middle, and make the two sides of it unlike.
TEST(LaserCalibration, of_unequal_isotopes_holds_on_both_sides_of_where_the_loop_settles) {
    for (const double share : {0.465, 0.49, 0.515, 0.535}) {
        config::Config c;
        c.laser.upper_isotope_ratio = share;
        const rig::LaserCalibration found = rig::calibration_of_laser(c);
        twin::LaserConfig gas;
        gas.upper_isotope_ratio = share;
        const twin::FourWave laser{gas};
        const auto signal = [&laser](double dl) { return laser.at(dl, 15.0).discriminator(); };
        double low = -0.05, high = 0.05;
        while (high - low > 1e-9) (signal(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);

        const double slope = found.config.gyro.discriminator_per_lambda;
        EXPECT_NEAR((signal(low + 1e-4) - signal(low - 1e-4)) / 2e-4, slope, 0.01 * slope) << share;
        const core::DiscriminatorCurve curve = rig::control_config(found.config).detector.curve;
        double worst_lambda = 0.0;
        for (double dl = -0.99 * found.third_wave_lambda; dl < 0.99 * found.third_wave_lambda; dl += 0.003) {
            const double read = core::true_detuning(curve, signal(low + dl) / slope).detuning_lambda;
            worst_lambda = std::max(worst_lambda, std::abs(read - dl));
        }
        EXPECT_LE(worst_lambda, found.curve_error_lambda + 1e-6) << share;
        EXPECT_GT(worst_lambda, 0.5 * found.curve_error_lambda) << share;
        EXPECT_LT(found.curve_error_lambda, 0.02) << share;
    }
}

TEST(LaserCalibration, refuses_a_laser_without_light) {
    config::Config c;
    c.laser.gain_loss_ratio = 0.9;
    EXPECT_THROW((void)rig::calibrated_by_laser(c), config::ConfigError);
}

}  // namespace
