// What the twin refuses, and what it must not refuse.

#include <zlg/twin/twin_config.hpp>

#include <zlg/core/common/maths.hpp>

#include <zlg/twin/averaged_laser.hpp>

#include "quiet_gyro.hpp"

namespace zlg::twin::twin_config_test {

using core::not_a_number;

struct BadMember {
    const char* key;
    std::function<void(TwinConfig&, double)> set;
    std::vector<double> bad;
};

#define ZLG_MEMBER(member, ...)                                                  \
    BadMember {                                                                  \
#member, [](TwinConfig & c, double v) { c.member = v; }, { __VA_ARGS__ } \
    }

std::string refusal_of(const TwinConfig& config) {
    return test::message_of<std::invalid_argument>([&] { Twin twin{config, Motion::rest()}; });
}

// What no range of a single key can express.
TEST(Twin, MembersThatDoNotMakeAGyroTogetherAreRefusedByKey) {
    const std::vector<BadMember> members = {
        ZLG_MEMBER(perimeter.expansion_lambda_per_c, not_a_number, -1e6, 1e6),
        ZLG_MEMBER(piezo.half_wave_v, not_a_number, 0.0, -40.0, 151.0),
        ZLG_MEMBER(piezo.half_wave_temperature_coefficient_per_c, not_a_number, -0.06, 0.15),
        ZLG_MEMBER(piezo.hysteresis_stroke_v, not_a_number, 0.03, 41e3),
    };
    for (const BadMember& member : members) {
        for (const double bad : member.bad) {
            TwinConfig config;
            member.set(config, bad);
            test::expect_contains(refusal_of(config), member.key);
        }
    }
}

// 1 + coefficient * 20 C would be -1, 0 and -0.2: a bias of the other sign, or none. Of either fidelity.
TEST(Twin, ABiasThatWarmingTurnsOverIsRefused) {
    for (const Fidelity fidelity : {Fidelity::averaged, Fidelity::laser}) {
        TwinConfig config;
        config.gyro.fidelity = fidelity;
        for (const double bad : {-0.1, -0.05, -0.06, not_a_number}) {
            config.gyro.bias_temperature_coefficient_per_c = bad;
            test::expect_contains(refusal_of(config),
                                  "1 + gyro.bias_temperature_coefficient_per_c * gyro.temperature_rise_c is ");
        }
        config.gyro.bias_temperature_coefficient_per_c = -0.04;
        EXPECT_NO_THROW((Twin{config, Motion::rest()})) << "a fifth of the bias is left";
    }
}

TEST(Twin, UnusualGyrosAreValid) {
    TwinConfig config = quiet_gyro();
    config.gyro.scale_arcsec = 1e-6;
    config.gyro.bias_hz = 1e12;
    config.gyro.bias_edge_s = 0.0;
    config.gyro.light_samples = 64;
    config.perimeter.miss_lambda = 0.0;
    config.piezo.half_wave_v = 1000.0;
    config.piezo.dac_bits = 1;
    Twin twin{config, Motion::sines(1e6, {})};
    const TwinHalf before = advance(twin, frame(true, 1), 2).back();
    const TwinHalf after = advance(twin, frame(true, 1), 2).back();
    EXPECT_NEAR(static_cast<double>(count_between(before, after)), 1e6 * 0.005 / 1e-6, 8.0);
}

TEST(Twin, MoreFringesThanTheCounterCanTellAreAnError) {
    TwinConfig config = quiet_gyro();
    config.gyro.scale_arcsec = 1e-6;
    Twin twin{config, Motion::sines(1e17, {})};
    EXPECT_THROW(twin.advance(frame(true, 1)), std::overflow_error);
}

TEST(Twin, AFrameThatHardwareCannotObeyIsRefused) {
    Twin twin{quiet_gyro(), Motion::rest()};
    EXPECT_THROW(twin.advance(frame(true, 0)), std::invalid_argument);
    EXPECT_THROW(twin.advance(frame(false, 1, not_a_number)), std::invalid_argument);
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
    const GyroConfig gyro{.tick_s = 0.005, .bias_edge_s = 50e-6};
    const AveragedLaser a{.bias_hz = 60000.0, .bias_chi = 3.5, .discriminator_per_lambda = 0.3};
    const GyroConfig equivalent = with_laser(gyro, Quadrature::x1, a);
    // A half of 2500 us loses a quarter of the 50 us at each of its ends.
    EXPECT_NEAR(equivalent.bias_hz, 60000.0 * (2500.0 - 25.0) / 2500.0, 1e-9);
    EXPECT_EQ(equivalent.bias_chi, 3.5);
    EXPECT_EQ(equivalent.discriminator_per_lambda, 0.3);
    EXPECT_EQ(equivalent.scale_arcsec, gyro.scale_arcsec);
}

}  // namespace zlg::twin::twin_config_test
