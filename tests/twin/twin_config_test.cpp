// What the twin refuses, and what it must not refuse.

#include <zlg/twin/twin_config.hpp>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <zlg/twin/averaged_laser.hpp>

#include "quiet_gyro.hpp"

namespace zlg::twin {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct BadMember {
    const char* name;
    std::function<void(TwinConfig&, double)> set;
    std::vector<double> bad;
};

#define ZLG_MEMBER(member, ...)                                                  \
    BadMember {                                                                  \
#member, [](TwinConfig & c, double v) { c.member = v; }, { __VA_ARGS__ } \
    }

TEST(Twin, AConfigurationThatArithmeticCannotCarryIsRefusedByName) {
    const std::vector<BadMember> members = {ZLG_MEMBER(tick_s, nan, 0.0, -1.0),
                                            ZLG_MEMBER(scale_arcsec, nan, 0.0, 1e7),
                                            ZLG_MEMBER(bias_hz, nan, -1.0, 2e12),
                                            ZLG_MEMBER(bias_chi, nan, -1.0),
                                            ZLG_MEMBER(bias_edge_s, nan, -1e-6, 0.0025),
                                            ZLG_MEMBER(bias_temperature_coefficient_per_c, nan),
                                            ZLG_MEMBER(reference_temperature_c, nan),
                                            ZLG_MEMBER(temperature_rise_c, nan),
                                            ZLG_MEMBER(light_noise_lambda, nan, -1e-9),
                                            ZLG_MEMBER(discriminator_per_lambda, nan, 0.0),
                                            ZLG_MEMBER(magnetic_arcsec_s, nan),
                                            ZLG_MEMBER(magnetic_thermal_arcsec_s, nan),
                                            ZLG_MEMBER(thermal_time_s, nan, 0.0),
                                            ZLG_MEMBER(nonmagnetic_arcsec_s, nan),
                                            ZLG_MEMBER(random_walk_arcsec_sqrt_s, nan, -1.0),
                                            ZLG_MEMBER(tau_s, nan, 0.0),
                                            ZLG_MEMBER(limit_lambda, nan, 0.0),
                                            ZLG_MEMBER(miss_lambda, nan, -0.1, 0.24),
                                            ZLG_MEMBER(expansion_lambda_per_c, nan),
                                            ZLG_MEMBER(half_wave_v, nan, 0.0, -40.0, 151.0),
                                            ZLG_MEMBER(half_wave_temperature_coefficient_per_c, nan, -0.06, 0.15),
                                            ZLG_MEMBER(rc_s, nan, 0.0),
                                            ZLG_MEMBER(slew_v_s, nan, 0.0),
                                            ZLG_MEMBER(range_min_v, nan),
                                            ZLG_MEMBER(range_max_v, nan, 0.0, -10.0),
                                            ZLG_MEMBER(adc_noise_v, nan, -1.0)};
    for (const BadMember& member : members) {
        for (const double bad : member.bad) {
            TwinConfig config;
            member.set(config, bad);
            try {
                Twin twin{config, Motion::rest()};
                ADD_FAILURE() << member.name << " = " << bad << " was accepted";
            } catch (const std::invalid_argument& error) {
                EXPECT_NE(std::string{error.what()}.find(member.name), std::string::npos) << error.what();
            }
        }
    }
}

TEST(Twin, WholeNumbersOutOfRangeAreRefusedByName) {
    const auto refused = [](const char* name, int TwinConfig::*member, int bad) {
        TwinConfig config;
        config.*member = bad;
        try {
            Twin twin{config, Motion::rest()};
            ADD_FAILURE() << name << " = " << bad << " was accepted";
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string{error.what()}.find(name), std::string::npos) << error.what();
        }
    };
    for (const int bad : {0, 65}) refused("light_samples", &TwinConfig::light_samples, bad);
    for (const int bad : {0, 2}) refused("first_bias_sign", &TwinConfig::first_bias_sign, bad);
    for (const int bad : {0, 25}) refused("dac_bits", &TwinConfig::dac_bits, bad);
    for (const int bad : {0, 25}) refused("adc_bits", &TwinConfig::adc_bits, bad);
}

TEST(Twin, UnusualGyrosAreValid) {
    TwinConfig config = quiet_gyro();
    config.scale_arcsec = 1e-6;
    config.bias_hz = 1e12;
    config.bias_edge_s = 0.0;
    config.light_samples = 64;
    config.miss_lambda = 0.0;
    config.half_wave_v = 1000.0;
    config.dac_bits = 1;
    Twin twin{config, Motion::sines(1e6, {})};
    const TwinHalf before = advance(twin, frame(true, 1), 2).back();
    const TwinHalf after = advance(twin, frame(true, 1), 2).back();
    EXPECT_NEAR(static_cast<double>(count_between(before, after)), 1e6 * 0.005 / 1e-6, 8.0);
}

TEST(Twin, MoreFringesThanTheCounterCanTellAreAnError) {
    TwinConfig config = quiet_gyro();
    config.scale_arcsec = 1e-6;
    Twin twin{config, Motion::sines(1e17, {})};
    EXPECT_THROW(twin.advance(frame(true, 1)), std::overflow_error);
}

TEST(Twin, AFrameThatHardwareCannotObeyIsRefused) {
    Twin twin{quiet_gyro(), Motion::rest()};
    EXPECT_THROW(twin.advance(frame(true, 0)), std::invalid_argument);
    EXPECT_THROW(twin.advance(frame(false, 1, nan)), std::invalid_argument);
    core::ActuatorFrame none = frame(false, 1);
    none.n_set_points = 0;
    EXPECT_THROW(twin.advance(none), std::invalid_argument);
    none.n_set_points = 17;
    EXPECT_THROW(twin.advance(none), std::invalid_argument);
    // A refused frame leaves no trace.
    Twin untouched{quiet_gyro(), Motion::rest()};
    const TwinHalf half = twin.advance(frame(true, 1));
    EXPECT_EQ(half.sensor.sequence, 0u);
    EXPECT_EQ(half.sensor.counter, untouched.advance(frame(true, 1)).sensor.counter);
}

TEST(TwinConfig, TheTwinIsToldTheMeanOfAHalfWithItsEdges) {
    TwinConfig config;
    config.tick_s = 0.005;
    config.bias_edge_s = 50e-6;
    const AveragedLaser a{.bias_hz = 60000.0, .bias_chi = 3.5, .discriminator_per_lambda = 0.3};
    const TwinConfig equivalent = with_laser(config, a);
    // A half of 2500 us loses a quarter of the 50 us at each of its ends.
    EXPECT_NEAR(equivalent.bias_hz, 60000.0 * (2500.0 - 25.0) / 2500.0, 1e-9);
    EXPECT_EQ(equivalent.bias_chi, 3.5);
    EXPECT_EQ(equivalent.discriminator_per_lambda, 0.3);
    EXPECT_EQ(equivalent.half_wave_v, config.half_wave_v);
}

}  // namespace
}  // namespace zlg::twin
