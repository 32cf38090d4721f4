#include <zlg/twin/discriminator_range.hpp>

#include <zlg/twin/laser_zones.hpp>

#include "test.hpp"

namespace zlg::twin::discriminator_range_test {

TEST(DiscriminatorRange, TheSignalGrowsUpToItsEnds) {
    const FourWave laser{LaserConfig{.upper_isotope_ratio = 0.4}};
    for (const double field_g : {5.0, 15.0, 20.0}) {
        const DiscriminatorRange range = discriminator_range(laser, field_g);
        double before = -2.0;
        for (double dl = range.min_detuning_lambda; dl <= range.max_detuning_lambda; dl += 0.00037) {
            const double signal = laser.at(dl, field_g).discriminator();
            EXPECT_GT(signal, before) << dl;
            before = signal;
        }
        // Behind its end the signal falls, or the next mode is nearer.
        for (const double end : {range.min_detuning_lambda, range.max_detuning_lambda}) {
            ASSERT_LE(std::abs(end), 0.25);
            const double beyond = laser.at(end + std::copysign(1e-4, end), field_g).discriminator();
            EXPECT_TRUE(std::abs(end) == 0.25 || std::abs(beyond) <= std::abs(laser.at(end, field_g).discriminator()))
                << end;
        }
    }
}

TEST(DiscriminatorRange, IsOddForEqualIsotopes) {
    const DiscriminatorRange range = discriminator_range(FourWave{LaserConfig{}}, 15.0);
    EXPECT_NEAR(range.max_detuning_lambda, -range.min_detuning_lambda, 1e-9);
}

TEST(DiscriminatorRange, EndsWhereTheLightRunsOneWay) {
    const FourWave laser{LaserConfig{}};
    const DiscriminatorRange range = discriminator_range(laser, 20.0);
    EXPECT_NEAR(range.max_detuning_lambda, 0.243, 0.002);
    EXPECT_NEAR(range.min_detuning_lambda, -0.243, 0.002);
    EXPECT_NEAR(laser.at(range.max_detuning_lambda, 20.0).discriminator(), 1.0, 1e-12);
}

TEST(DiscriminatorRange, SpansAtLeastTheZoneOfThreeWavesAt15Gauss) {
    EXPECT_GE(discriminator_range(FourWave{LaserConfig{}}, 15.0).max_detuning_lambda, 0.2458);
}

TEST(DiscriminatorRange, RefusesWhatHasNone) {
    const FourWave laser{LaserConfig{}};
    EXPECT_THROW((void)discriminator_range(laser, 0.0), std::invalid_argument);
    EXPECT_THROW((void)discriminator_range(laser, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
    EXPECT_THROW((void)discriminator_range(FourWave{LaserConfig{.gain_loss_ratio = 0.9}}, 15.0), std::runtime_error);
}

}  // namespace zlg::twin::discriminator_range_test
