#include <zlg/twin/discriminator_curve.hpp>

#include <zlg/twin/laser_zones.hpp>

#include "test.hpp"

namespace zlg::twin::discriminator_curve_test {

TEST(DiscriminatorCurve, TurnsTheSignalBackIntoItsDetuning) {
    const FourWave laser{LaserConfig{}};
    for (const double tolerance : {1e-5, 1e-4, 1e-3}) {
        const DiscriminatorCurve curve = discriminator_curve(laser, 15.0, tolerance);
        EXPECT_LE(curve.error_lambda, tolerance);
        for (double dl = -0.2459; dl < 0.246; dl += 0.00037) {
            EXPECT_NEAR(curve.detuning_of(laser.at(dl, 15.0).discriminator()), dl, 1.1 * tolerance);
        }
    }
}

TEST(DiscriminatorCurve, AFewKnotsSufficeForATenThousandthOfAWavelength) {
    EXPECT_LE(discriminator_curve(FourWave{LaserConfig{}}, 15.0, 1e-4).signal.size(), 80U);
}

// Where the third wave comes up the signal has a kink, which no line between two knots may cross.
TEST(DiscriminatorCurve, HasAKnotAtTheKink) {
    const FourWave laser{LaserConfig{}};
    const DiscriminatorCurve curve = discriminator_curve(laser, 15.0, 1e-6);
    const double edge = laser_zones(laser, 15.0, 0.0, 0.24).at(1).from_lambda;
    for (const double dl : {edge - 3e-5, edge, edge + 3e-5}) {
        EXPECT_NEAR(curve.detuning_of(laser.at(dl, 15.0).discriminator()), dl, 1.2e-6);
    }
}

TEST(DiscriminatorCurve, BothColumnsGrow) {
    const DiscriminatorCurve curve = discriminator_curve(FourWave{LaserConfig{}}, 15.0);
    ASSERT_EQ(curve.signal.size(), curve.detuning_lambda.size());
    for (std::size_t k = 1; k < curve.signal.size(); ++k) {
        EXPECT_GT(curve.signal[k], curve.signal[k - 1]);
        EXPECT_GT(curve.detuning_lambda[k], curve.detuning_lambda[k - 1]);
    }
}

TEST(DiscriminatorCurve, IsOddForEqualIsotopes) {
    const DiscriminatorCurve curve = discriminator_curve(FourWave{LaserConfig{}}, 15.0);
    EXPECT_NEAR(curve.detuning_of(0.0), 0.0, 1e-12);
    for (const double signal : {0.01, 0.1, 0.3, 0.7}) {
        EXPECT_NEAR(curve.detuning_of(-signal), -curve.detuning_of(signal), 1e-9);
    }
}

// At 0.1 the signal is 1.24 times its linear law: read linearly it would overrate the square of the detuning by 54 %.
TEST(DiscriminatorCurve, DoesWhatALinearLawCannot) {
    const FourWave laser{LaserConfig{}};
    const double signal = laser.at(0.1, 15.0).discriminator();
    EXPECT_NEAR(std::pow(signal / 0.332 / 0.1, 2), 1.54, 0.02);
    EXPECT_NEAR(std::pow(discriminator_curve(laser, 15.0).detuning_of(signal) / 0.1, 2), 1.0, 1e-3);
}

TEST(DiscriminatorCurve, EndsWhereTheLightRunsOneWay) {
    const DiscriminatorCurve curve = discriminator_curve(FourWave{LaserConfig{}}, 20.0);
    EXPECT_NEAR(curve.max_detuning_lambda(), 0.243, 0.002);
    EXPECT_NEAR(curve.min_detuning_lambda(), -0.243, 0.002);
    EXPECT_NEAR(curve.signal.back(), 1.0, 1e-12);
    EXPECT_EQ(curve.detuning_of(1.0), curve.max_detuning_lambda());
    EXPECT_EQ(curve.detuning_of(-7.0), curve.min_detuning_lambda());
}

TEST(DiscriminatorCurve, SpansAtLeastTheZoneOfThreeWavesAt15Gauss) {
    EXPECT_GE(discriminator_curve(FourWave{LaserConfig{}}, 15.0).max_detuning_lambda(), 0.2458);
}

TEST(DiscriminatorCurve, RefusesWhatHasNoCurve) {
    const FourWave laser{LaserConfig{}};
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)discriminator_curve(laser, 0.0), std::invalid_argument);
    EXPECT_THROW((void)discriminator_curve(laser, none), std::invalid_argument);
    EXPECT_THROW((void)discriminator_curve(laser, 15.0, none), std::invalid_argument);
    EXPECT_THROW((void)discriminator_curve(laser, 15.0, 1e-9), std::invalid_argument);
    EXPECT_THROW((void)discriminator_curve(FourWave{LaserConfig{.gain_loss_ratio = 0.9}}, 15.0), std::runtime_error);
}

}  // namespace zlg::twin::discriminator_curve_test
