// The numbers of docs/physics.md that are of the default gas at 15 G, to their last digit.

#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/discriminator_range.hpp>
#include <zlg/twin/laser_table.hpp>
#include <zlg/twin/laser_zones.hpp>

#include "test.hpp"

namespace zlg::twin::default_gas::waves_of_default_gas_test {

constexpr double field_g = 15.0;

double slope_per_lambda(const FourWave& laser) { return laser.at(1e-5, field_g).discriminator() / 1e-5; }

TEST(DefaultGas, HasTheZonesThatItIsSaidToHave) {
    const auto zones = laser_zones(FourWave{LaserConfig{}}, field_g, 0.0, 0.5);
    const double edges[] = {0.2000, 0.2459, 0.2541, 0.3000};
    ASSERT_EQ(zones.size(), std::size(edges) + 1);
    for (std::size_t k = 0; k < std::size(edges); ++k) EXPECT_NEAR(zones[k + 1].from_lambda, edges[k], 1e-4);
    EXPECT_NEAR((LaserTable{LaserConfig{}, field_g}.error()), 2.7e-7, 0.1e-7);
}

TEST(DefaultGas, HasABiasThatIsNearlyAParabola) {
    const FourWave laser{LaserConfig{}};
    const AveragedLaser law = averaged_laser(laser, field_g);
    EXPECT_NEAR(law.bias_chi, 3.589, 1e-3);
    double worst = 0.0;
    for (double dl = -0.2; dl <= 0.2; dl += 0.0025) {
        const double parabola_hz = law.bias_hz * (1.0 - law.bias_chi * dl * dl);
        worst = std::max(worst, std::abs(laser.at(dl, field_g).left.bias_hz - parabola_hz) / law.bias_hz);
    }
    EXPECT_NEAR(100.0 * worst, 0.14, 0.01);
}

TEST(DefaultGas, HasADiscriminatorThatGrowsFasterThanTheDetuning) {
    const FourWave laser{LaserConfig{}};
    const double growth[] = {1.05, 1.24, 1.78, 3.67};
    for (int k = 1; k <= 4; ++k)
        EXPECT_NEAR(laser.at(0.05 * k, field_g).discriminator() / (slope_per_lambda(laser) * 0.05 * k), growth[k - 1],
                    0.01);
    EXPECT_NEAR(discriminator_range(laser, field_g).max_detuning_lambda, 0.250, 1e-3);
}

TEST(DefaultGas, HasABiasThatGrowsWithItsGainAndASlopeThatFalls) {
    const double gain_loss[] = {1.1, 1.2, 1.3}, bias_hz[] = {55394, 60429, 65465}, slope[] = {0.666, 0.332, 0.220};
    for (std::size_t k = 0; k < 3; ++k) {
        const FourWave laser{LaserConfig{.gain_loss_ratio = gain_loss[k]}};
        EXPECT_NEAR(laser.at(0.0, field_g).left.bias_hz, bias_hz[k], 1.0);
        EXPECT_NEAR(slope_per_lambda(laser), slope[k], 1e-3);
    }
}

}  // namespace zlg::twin::default_gas::waves_of_default_gas_test
