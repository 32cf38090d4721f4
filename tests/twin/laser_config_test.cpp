#include <zlg/twin/laser_config.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace zlg::twin {
namespace {

std::string refusal(const LaserConfig& config) {
    try {
        validate(config);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return {};
}

TEST(LaserConfig, TheDefaultsAreAccepted) { EXPECT_EQ(refusal(LaserConfig{}), ""); }

TEST(LaserConfig, NoMemberMayBeANumberThatIsNone) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    struct Member {
        const char* name;
        double LaserConfig::*member;
    };
    constexpr Member members[] = {
        {"perimeter_m", &LaserConfig::perimeter_m},
        {"round_trip_loss_ratio", &LaserConfig::round_trip_loss_ratio},
        {"gain_loss_ratio", &LaserConfig::gain_loss_ratio},
        {"doppler_half_width_hz", &LaserConfig::doppler_half_width_hz},
        {"homogeneous_half_width_hz", &LaserConfig::homogeneous_half_width_hz},
        {"isotope_shift_hz", &LaserConfig::isotope_shift_hz},
        {"upper_isotope_ratio", &LaserConfig::upper_isotope_ratio},
        {"zeeman_hz_per_g", &LaserConfig::zeeman_hz_per_g},
        {"opposite_sigma_coupling", &LaserConfig::opposite_sigma_coupling},
        {"bias_field_g", &LaserConfig::bias_field_g},
    };
    for (const Member& m : members) {
        for (const double bad : {none, infinite, -infinite}) {
            LaserConfig config;
            config.*m.member = bad;
            EXPECT_NE(refusal(config).find(m.name), std::string::npos) << m.name << " " << bad;
        }
    }
}

TEST(LaserConfig, ARefusalTellsMemberValueAndWhatIsAllowed) {
    LaserConfig config;
    config.upper_isotope_ratio = 1.5;
    EXPECT_EQ(refusal(config), "laser.upper_isotope_ratio is 1.5, allowed is 0..1");
}

// Four waves are two neighbouring modes. At gain/loss 1.7408 (independent computation: the ratio of the unsaturated
// gains at zero and half a wavelength) the mode on the other side reaches threshold too.
TEST(LaserConfig, GainForAThirdModeIsRefused) {
    LaserConfig config;
    config.gain_loss_ratio = 1.740;
    EXPECT_EQ(refusal(config), "");
    config.gain_loss_ratio = 1.742;
    EXPECT_NE(refusal(config).find("gain_loss_ratio is 1.742, allowed is below 1.741"), std::string::npos)
        << refusal(config);
}

}  // namespace
}  // namespace zlg::twin
