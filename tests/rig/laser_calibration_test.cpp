#include <zlg/rig/laser_calibration.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/four_wave.hpp>

#include "test.hpp"

namespace zlg::laser_calibration_test {

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

// The detunings are those of which chi times their square is what the bias lacks: the law that corrects a re-lock is a
// parabola, that of the laser bends away from it by a hundredth at 0.2 wavelength.
TEST(LaserCalibration, the_core_reads_the_detuning_of_the_four_wave_light) {
    const config::Config c = rig::calibrated_by_laser({});
    const core::DiscriminatorCurve curve = rig::control_config(c).detector.curve;
    const twin::FourWave laser{twin::LaserConfig{}};
    const double bias_hz = laser.at(0.0, 15.0).left.bias_hz;
    EXPECT_EQ(c.perimeter.discriminator_centre_lambda, 0.0);
    for (double dl = 0.001; dl < 0.235; dl += 0.0017) {
        const twin::LaserLight light = laser.at(dl, 15.0);
        const double read =
            core::true_detuning(curve, light.discriminator() / c.gyro.discriminator_per_lambda).detuning_lambda;
        const double lacks = 1.0 - light.left.bias_hz / bias_hz;
        EXPECT_NEAR(read, std::sqrt(lacks / c.gyro.bias_chi), dl < 0.2 ? 2e-4 : 1e-3) << dl;
        EXPECT_NEAR(read, dl, dl < 0.1 ? 2e-4 : 1e-2 * dl) << dl;
    }
}

// Where the beams are equal, about the middle of the mode.
double settled(const twin::FourWave& laser, double field_g) {
    double low = -0.06, high = 0.06;
    while (high - low > 1e-10) {
        const double middle = 0.5 * (low + high);
        (laser.at(middle, field_g).discriminator() < 0.0 ? low : high) = middle;
    }
    return low;
}

// Unequal isotopes move the place of equal beams away from the middle, make the two sides of it unlike, and the bias
// largest at a third place. What a half lacks of its bias is chi times the mean square that is recorded, on both sides.
TEST(LaserCalibration, of_unequal_isotopes_the_squares_are_what_the_bias_lacks_on_both_sides) {
    for (const double share : {0.465, 0.49, 0.515, 0.535, 0.55}) {
        config::Config c;
        c.laser.upper_isotope_ratio = share;
        const rig::LaserCalibration found = rig::calibration_of_laser(c);
        twin::LaserConfig gas;
        gas.upper_isotope_ratio = share;
        const twin::FourWave laser{gas};
        const double at = settled(laser, 15.0);
        const auto light = [&](double dl) { return laser.at(at + dl, 15.0); };
        const double slope = found.config.gyro.discriminator_per_lambda;
        EXPECT_NEAR((light(1e-4).discriminator() - light(-1e-4).discriminator()) / 2e-4, slope, 0.01 * slope) << share;

        const core::DiscriminatorCurve curve = rig::control_config(found.config).detector.curve;
        const double centre = found.config.perimeter.discriminator_centre_lambda;
        // Edges take a hundredth of the plateau.
        const double max_hz = found.config.gyro.bias_hz / 0.99;
        const double settled_hz = light(0.0).left.bias_hz;
        EXPECT_NEAR(settled_hz, max_hz * (1.0 - found.config.gyro.bias_chi * centre * centre), 1e-6 * max_hz);
        const double max_lambda = found.third_wave_lambda;
        EXPECT_GT(max_lambda, 0.1);
        for (double dl = -0.99 * max_lambda; dl < 0.99 * max_lambda; dl += 0.003) {
            const double read = core::true_detuning(curve, light(dl).discriminator() / slope).detuning_lambda;
            EXPECT_NEAR(read, dl, 0.06 * std::abs(dl) + 1e-4) << share << " at " << dl;
            const double from_centre = read - centre;
            const double lacks = found.config.gyro.bias_chi * from_centre * from_centre;
            // A ten-thousandth of the bias is 0.05 arcsec in a half.
            EXPECT_NEAR(light(dl).left.bias_hz, max_hz * (1.0 - lacks), 2e-4 * max_hz) << share << " at " << dl;
        }
        EXPECT_LT(found.curve_error_lambda, 5e-4) << share;
        EXPECT_EQ(centre > 0.0, share > 0.5);
    }
}

TEST(LaserCalibration, refuses_a_laser_without_light) {
    config::Config c;
    c.laser.gain_loss_ratio = 0.9;
    EXPECT_THROW((void)rig::calibrated_by_laser(c), config::ConfigError);
}

}  // namespace zlg::laser_calibration_test
