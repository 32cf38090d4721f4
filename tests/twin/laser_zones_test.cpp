#include <zlg/twin/laser_zones.hpp>

#include "test.hpp"

namespace zlg::twin::laser_zones_test {

constexpr double tolerance_lambda = 0.002;

struct Expected {
    double from_lambda;
    unsigned lit;
};

void expect_zones(const LaserConfig& config, double field_g, const std::vector<Expected>& expected) {
    const std::vector<LaserZone> zones = laser_zones(FourWave{config}, field_g, 0.0, 0.5);
    ASSERT_EQ(zones.size(), expected.size());
    for (std::size_t k = 0; k < zones.size(); ++k) {
        EXPECT_EQ(zones[k].lit, expected[k].lit) << "zone " << k;
        EXPECT_NEAR(zones[k].from_lambda, expected[k].from_lambda, tolerance_lambda) << "zone " << k;
    }
}

constexpr unsigned left_cw = 1;
constexpr unsigned left_ccw = 2;
constexpr unsigned right_cw = 4;
constexpr unsigned right_ccw = 8;
constexpr unsigned left_pair = left_cw | left_ccw;
constexpr unsigned right_pair = right_cw | right_ccw;

// Published edges of the four-wave model.
TEST(LaserZones, At15GaussTwoThreeFourThreeTwoWaves) {
    expect_zones(LaserConfig{}, 15.0,
                 {{0.0, left_pair},
                  {0.201, left_pair | right_cw},
                  {0.246, left_pair | right_pair},
                  {0.255, left_cw | right_pair},
                  {0.300, right_pair}});
}

TEST(LaserZones, At20GaussTheMiddleIsOneWay) {
    expect_zones(LaserConfig{}, 20.0,
                 {{0.0, left_pair},
                  {0.196, left_pair | right_cw},
                  {0.243, left_cw | right_cw},
                  {0.258, left_cw | right_pair},
                  {0.304, right_pair}});
}

TEST(LaserZones, FullCrossSaturationMakesTheMiddleOneWayAt15Gauss) {
    const auto zones = laser_zones(FourWave{LaserConfig{.opposite_sigma_coupling = 1.0}}, 15.0, 0.0, 0.5);
    ASSERT_EQ(zones.size(), 5U);
    EXPECT_TRUE(zones[2].one_way());
    EXPECT_NEAR(zones[2].from_lambda, 0.223, tolerance_lambda);
    EXPECT_NEAR(zones[2].to_lambda, 0.277, tolerance_lambda);
}

TEST(LaserZones, LittleGainLeavesTheMiddleDark) {
    const auto zones = laser_zones(FourWave{LaserConfig{.gain_loss_ratio = 1.1}}, 15.0, 0.0, 0.5);
    ASSERT_EQ(zones.size(), 5U);
    EXPECT_TRUE(zones[1].one_way());
    EXPECT_NEAR(zones[1].from_lambda, 0.189, tolerance_lambda);
    EXPECT_TRUE(zones[2].dark());
    EXPECT_NEAR(zones[2].from_lambda, 0.228, tolerance_lambda);
    EXPECT_NEAR(zones[2].to_lambda, 0.273, tolerance_lambda);
    EXPECT_FALSE(zones[2].one_way());
}

TEST(LaserZones, CoverTheStretchAndRepeatEveryHalfWavelength) {
    const auto zones = laser_zones(FourWave{LaserConfig{}}, 15.0, -1.0, 1.0);
    EXPECT_EQ(zones.front().from_lambda, -1.0);
    EXPECT_EQ(zones.back().to_lambda, 1.0);
    for (std::size_t k = 1; k < zones.size(); ++k) {
        EXPECT_EQ(zones[k].from_lambda, zones[k - 1].to_lambda);
        EXPECT_NE(zones[k].lit, zones[k - 1].lit);
        EXPECT_GT(zones[k].to_lambda, zones[k].from_lambda);
    }
    EXPECT_EQ(zones.size(), 17U);  // four zones in each of four half wavelengths, and the one that is cut in two
    for (std::size_t k = 2; k < 13; ++k) {
        EXPECT_NEAR(zones[k + 4].from_lambda - zones[k].from_lambda, 0.5, 2e-9) << k;
    }
}

TEST(LaserZones, EdgesAreWhereAWaveGoesOut) {
    const FourWave laser{LaserConfig{}};
    for (const LaserZone& zone : laser_zones(laser, 15.0, 0.1, 0.4)) {
        EXPECT_EQ(laser.at(zone.from_lambda + 2e-9, 15.0).lit(), zone.lit);
        EXPECT_EQ(laser.at(zone.to_lambda - 2e-9, 15.0).lit(), zone.lit);
    }
}

TEST(LaserZones, RefusesAStretchThatIsNone) {
    const FourWave laser{LaserConfig{}};
    EXPECT_THROW((void)laser_zones(laser, 15.0, 0.2, 0.2), std::invalid_argument);
    EXPECT_THROW((void)laser_zones(laser, 15.0, 0.0, 11.0), std::invalid_argument);
    EXPECT_THROW((void)laser_zones(laser, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.5), std::invalid_argument);
}

}  // namespace zlg::twin::laser_zones_test
