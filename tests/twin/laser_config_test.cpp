#include <zlg/twin/laser_config.hpp>

#include "test.hpp"

namespace zlg::twin::laser_config_test {

std::string refusal(const LaserConfig& config) {
    return test::refusal_by<std::invalid_argument>([&] { validate(config); });
}

// A ring of 0.16 m; wavelength 632.8 nm; neon at 400 K, of which half is neon 22; a field of 15 G.
TEST(LaserConfig, TheDefaultsAreAGasOfEqualIsotopesLittleAboveThreshold) {
    const LaserConfig laser;
    EXPECT_EQ(laser.perimeter_m, 0.160);
    EXPECT_EQ(laser.round_trip_loss_ratio, 0.007);
    EXPECT_EQ(laser.gain_loss_ratio, 1.20);
    EXPECT_EQ(laser.homogeneous_half_width_hz, 130e6);
    EXPECT_EQ(laser.isotope_shift_hz, 2.0 * 442.5e6);
    EXPECT_EQ(laser.upper_isotope_ratio, 0.5);
    EXPECT_EQ(laser.zeeman_hz_per_g, 1.82e6);
    EXPECT_EQ(laser.opposite_sigma_coupling, 0.6);
    EXPECT_EQ(laser.bias_field_g, 15.0);
    EXPECT_EQ(laser.quadrature, Quadrature::x1);

    // Most probable speed sqrt(2 k T/m) of 21 atomic mass units at 400 K, over the wavelength.
    const double speed_m_s = 562.8;
    EXPECT_NEAR(laser.doppler_half_width_hz, speed_m_s / 632.8e-9, 0.03 * laser.doppler_half_width_hz);
}

TEST(LaserConfig, TheDefaultsAreAccepted) { EXPECT_EQ(refusal(LaserConfig{}), ""); }

// Lines are measured by the Doppler width; what no relation holds, the range of its key does.
TEST(LaserConfig, NoLineMayHaveANumberThatIsNone) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    struct Member {
        const char* name;
        double LaserConfig::*member;
    };
    constexpr Member members[] = {
        {"homogeneous_half_width_hz", &LaserConfig::homogeneous_half_width_hz},
        {"isotope_shift_hz", &LaserConfig::isotope_shift_hz},
        {"zeeman_hz_per_g", &LaserConfig::zeeman_hz_per_g},
    };
    for (const Member& m : members) {
        for (const double bad : {none, infinite, -infinite}) {
            LaserConfig config;
            config.*m.member = bad;
            EXPECT_NE(refusal(config).find(m.name), std::string::npos) << m.name << " " << bad;
        }
    }
    for (const auto member : {&LaserConfig::perimeter_m, &LaserConfig::gain_loss_ratio,
                              &LaserConfig::doppler_half_width_hz, &LaserConfig::upper_isotope_ratio}) {
        LaserConfig config;
        config.*member = none;
        EXPECT_NE(refusal(config), "");
    }
}

TEST(LaserConfig, ARefusalTellsMemberValueAndWhatIsAllowed) {
    LaserConfig config;
    config.zeeman_hz_per_g = 1e9;
    EXPECT_EQ(refusal(config), "laser.zeeman_hz_per_g is 1000000000, allowed is 0..907000000");
}

// Four waves are two neighbouring modes. The mode on the other side reaches threshold where the holes of the nearest
// leave it gain: at these gains over loss by the same equations of six waves in another language. The gain of the gas
// without light reaches it at 1.189, 1.087 and 1.027.
TEST(LaserConfig, GainForAThirdModeBesideTheLightOfTheNearestIsRefused) {
    const std::tuple<double, double, const char*> rings[] = {
        {0.28, 1.2965, "1.29"}, {0.40, 1.1312, "1.13"}, {0.70, 1.0491, "1.04"}};
    for (const auto& [perimeter_m, limit, text] : rings) {
        LaserConfig config{.perimeter_m = perimeter_m, .gain_loss_ratio = limit - 0.001};
        EXPECT_EQ(refusal(config), "");
        config.gain_loss_ratio = limit + 0.001;
        EXPECT_NE(refusal(config).find(std::string{"allowed is below "} + text), std::string::npos) << refusal(config);
    }
}

}  // namespace zlg::twin::laser_config_test
