#include <zlg/core/compensation/joint_relock.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "compensation/compensation_support.hpp"

namespace joint_relock_test {

using compensation_test::not_a_number;
using namespace zlg::core;

HalfRecord half_of(int k, double mean_sq, int first_sign) {
    HalfRecord half;
    half.half = k;
    half.bias_sign = static_cast<std::int8_t>(k % 2 == 0 ? first_sign : -first_sign);
    half.detuning_lambda = std::sqrt(mean_sq);
    half.detuning_sq_lambda2 = mean_sq;
    half.piezo_v = half.temperature_c = not_a_number;
    return half;
}

// 16 halves after a gap with mean squares 0.04, 0.02, 0.01, ..., without light.
JointRelockState after_gap(int first_sign, const CompensationConstants& gyro = {}) {
    JointRelockState state;
    step(gyro, {}, state, half_of(-1, 0.0, 1), {}, false, 99);
    double mean_sq = 0.04;
    for (int k = 0; k < profile_halves; ++k, mean_sq *= 0.5) {
        EXPECT_FALSE(is_due(state));
        step(gyro, {}, state, half_of(k, mean_sq, first_sign), {}, true, 100 + k / 2);
    }
    return state;
}

TEST(JointRelock, EachHalfGetsItsShareOfTheFalseAngle) {
    const CompensationConstants gyro{.light_noise = Wavelengths{0.0}};
    for (const int sign : {1, -1}) {
        JointRelockState state = after_gap(sign, gyro);
        ASSERT_TRUE(is_due(state));
        JointRelock delivered;
        deliver(gyro, state, Celsius{not_a_number}, delivered);
        EXPECT_FALSE(is_due(state));
        ASSERT_TRUE(delivered.known);
        EXPECT_EQ(delivered.first_tick, 100);
        // A bias of f0 (1 - chi dl^2) reads s chi f0 dl^2 K T/2 too little; sums of pairs are the false angle of a tick.
        double mean_sq = 0.04;
        for (unsigned k = 0; k < profile_halves; ++k, mean_sq *= 0.5) {
            const double expected = sign * (k % 2 == 0 ? 1.0 : -1.0) * 3.6 * 60e3 * mean_sq * 3.263 * 0.0025;
            EXPECT_NEAR(delivered.correction_arcsec[k], expected, 1e-9 + 1e-6 * std::abs(expected)) << k;
        }
    }
}

TEST(JointRelock, ErrorsOfNeighboursHaveTheSignsOfTheirHalves) {
    JointRelockState state = after_gap(-1);
    state.profile.profile.covariance_lambda4[0][1] = 1e-8;
    JointRelock delivered;
    deliver({}, state, Celsius{20.0}, delivered);
    const double arcsec = 3.6 * 60e3 * 3.263 * 0.0025;
    EXPECT_NEAR(delivered.covariance_arcsec2[0][1], -1e-8 * arcsec * arcsec, 1e-12);
    EXPECT_GT(delivered.covariance_arcsec2[3][3], 0.0);
}

TEST(JointRelock, ASecondGapForgetsTheFirst) {
    JointRelockState state = after_gap(1);
    step({}, {}, state, half_of(0, 0.0, 1), {}, false, 108);
    ASSERT_TRUE(is_due(state));
    JointRelock delivered;
    deliver({}, state, Celsius{20.0}, delivered);
    EXPECT_EQ(delivered.first_tick, 100);
    EXPECT_FALSE(delivered.known);
    EXPECT_FALSE(is_due(state));
}

TEST(JointRelock, AProfileThatAGapBreaksOffIsGivenUpAtOnce) {
    JointRelockState state;
    step({}, {}, state, half_of(-1, 0.0, 1), {}, false, 99);
    EXPECT_FALSE(is_due(state));
    for (int k = 0; k < 5; ++k) step({}, {}, state, half_of(k, 0.01, 1), {}, true, 100 + k / 2);
    step({}, {}, state, half_of(5, 0.0, 1), {}, false, 102);
    ASSERT_TRUE(is_due(state));
    JointRelock delivered;
    deliver({}, state, Celsius{20.0}, delivered);
    EXPECT_EQ(delivered.first_tick, 100);
    EXPECT_FALSE(delivered.known);
}

TEST(JointRelock, WithoutAnyDetuningItIsGivenUp) {
    JointRelockState state;
    step({}, {}, state, half_of(-1, 0.0, 1), {}, false, 4);
    for (int k = 0; k < 40 && !is_due(state); ++k)
        step({}, {}, state, half_of(k, not_a_number, 1), {}, true, 5 + k / 2);
    ASSERT_TRUE(is_due(state));
    JointRelock delivered;
    deliver({}, state, Celsius{20.0}, delivered);
    EXPECT_FALSE(delivered.known);
}

TEST(JointRelock, BeforeAnyGapNothingIsOwed) {
    JointRelockState state;
    for (int k = 0; k < 60; ++k) step({}, {}, state, half_of(k, 0.01, 1), {}, true, k / 2);
    EXPECT_FALSE(is_due(state));
    EXPECT_EQ(state, JointRelockState{});
}

}  // namespace joint_relock_test
