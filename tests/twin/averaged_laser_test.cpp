#include <zlg/twin/averaged_laser.hpp>

#include "test.hpp"

namespace zlg::twin::averaged_laser_test {

TEST(AveragedLaser, HasThePublishedFiguresOfTheDefaultGyro) {
    const AveragedLaser a = averaged_laser(FourWave{LaserConfig{}}, 15.0);
    EXPECT_NEAR(a.scale_pull, 60430.0 / (2.0 * 15.0 * 1.82e6), 2e-6);
    EXPECT_NEAR(a.bias_hz, 60430.0, 5.0);
    EXPECT_NEAR(a.bias_chi, 3.59, 0.005);
    EXPECT_NEAR(a.discriminator_per_lambda, 0.332, 0.02 * 0.332);
    EXPECT_EQ(a.settled_lambda, 0.0);
}

TEST(AveragedLaser, FarFitsTakeTheQuarticTermIntoChi) {
    const AveragedLaser a = averaged_laser(FourWave{LaserConfig{}}, 15.0, 0.2);
    EXPECT_GT(a.bias_chi, 3.555);
    EXPECT_LT(a.bias_chi, 3.587);
    EXPECT_LT(a.bias_residual_ratio, 0.001);
}

// The two fidelities where both are valid: eq (2) and a straight discriminator against the laser's own.
TEST(AveragedLaser, AgreesWithTheLaserWithinAHundredthUpToAFifthOfAWavelength) {
    const FourWave laser{LaserConfig{}};
    const AveragedLaser a = averaged_laser(laser, 15.0);
    for (double dl = -0.2; dl <= 0.2; dl += 0.01) {
        EXPECT_NEAR(a.bias_hz * (1.0 - a.bias_chi * dl * dl) / laser.at(dl, 15.0).left.bias_hz, 1.0, 0.01) << dl;
    }
    for (double dl = -0.02; dl <= 0.02; dl += 0.001) {
        EXPECT_NEAR(laser.at(dl, 15.0).discriminator(), a.discriminator_per_lambda * dl, 0.01 * 0.332 * 0.02) << dl;
    }
}

// At the place where the loop settles the beams are equal, and the slope is that of the light there.
TEST(AveragedLaser, UnequalIsotopesMoveThePlaceWhereTheLoopSettles) {
    const FourWave laser{LaserConfig{.upper_isotope_ratio = 0.465}};
    const AveragedLaser a = averaged_laser(laser, 15.0);
    EXPECT_LT(a.settled_lambda, -0.01);
    EXPECT_NEAR(laser.at(a.settled_lambda, 15.0).discriminator(), 0.0, 1e-12);
    EXPECT_NEAR(laser.at(a.settled_lambda + 1e-4, 15.0).discriminator(), 1e-4 * a.discriminator_per_lambda, 1e-7);
}

TEST(AveragedLaser, RefusesWhatHasNoAverage) {
    const FourWave laser{LaserConfig{}};
    EXPECT_THROW((void)averaged_laser(laser, 0.0), std::invalid_argument);
    EXPECT_THROW((void)averaged_laser(laser, 15.0, 0.3), std::invalid_argument);
    EXPECT_THROW((void)averaged_laser(FourWave{LaserConfig{.gain_loss_ratio = 0.99}}, 15.0), std::runtime_error);
}

}  // namespace zlg::twin::averaged_laser_test
