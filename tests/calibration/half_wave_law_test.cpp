#include <zlg/calibration/half_wave_law.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "synthetic_gyro.hpp"

using namespace zlg::calibration;
using namespace synthetic;

TEST(HalfWaveLaw, finds_the_voltage_and_its_law) {
    const auto logs = one_log({.rise_c = 10.0, .half_wave_v = 43.0, .half_wave_per_c = 2e-3}, 120.0);
    const HalfWaveLaw law = find_half_wave_law(logs, 20.0, 0.0);
    ASSERT_TRUE(law.half_wave_v.determined) << law.half_wave_v.reason;
    EXPECT_LT(std::abs(errors_off(law.half_wave_v, 43.0)), 4.0);
    EXPECT_LT(std::abs(errors_off(law.temperature_coefficient_per_c, 2e-3)), 4.0);
    EXPECT_LT(law.half_wave_v.sigma, 0.005);
    EXPECT_NEAR(law.at_v(25.0), 43.0 * 1.01, 0.02);
    EXPECT_EQ(law.n_switches, 59);
}

TEST(HalfWaveLaw, one_temperature_gives_the_voltage_by_the_presumed_coefficient) {
    const auto logs = one_log({.start_c = 30.0, .half_wave_v = 43.0}, 60.0);
    const HalfWaveLaw law = find_half_wave_law(logs, 20.0, 1e-3);
    EXPECT_FALSE(law.temperature_coefficient_per_c.determined);
    EXPECT_LT(std::abs(errors_off(law.half_wave_v, 43.0 / 1.01)), 4.0);
}

TEST(HalfWaveLaw, a_converter_that_meets_the_same_codes_is_not_believed_beyond_them) {
    const auto logs = one_log({.half_wave_v = 40.03, .quantum_v = 0.073, .noise_v = 0.0}, 120.0);
    const HalfWaveLaw law = find_half_wave_law(logs, 20.0, 0.0);
    ASSERT_TRUE(law.half_wave_v.determined);
    EXPECT_NEAR(law.half_wave_v.sigma, 0.073 / std::sqrt(6.0), 0.006);
    EXPECT_LT(std::abs(errors_off(law.half_wave_v, 40.03)), 3.0);
    // Noise of half a code and more lets the mean resolve it.
    const auto noisy = one_log({.half_wave_v = 40.03, .quantum_v = 0.073, .noise_v = 0.05}, 120.0);
    EXPECT_LT(find_half_wave_law(noisy, 20.0, 0.0).half_wave_v.sigma, 0.004);
}

TEST(HalfWaveLaw, refuses_without_switches_or_voltages) {
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<LabLog> blind{log_of(SyntheticGyro{}, 60.0, [nan](HalfRecord& r) { r.piezo_v = nan; })};
    EXPECT_NE(find_half_wave_law(blind, 20.0, 0.0).half_wave_v.reason.find("piezo_v"), std::string::npos);
    const auto same_mode = one_log({.mode_changes = 0}, 60.0);
    EXPECT_FALSE(find_half_wave_law(same_mode, 20.0, 0.0).half_wave_v.determined);
}

// A switch now and then by three half wavelengths counts as three.
TEST(HalfWaveLaw, odd_multiples_are_divided) {
    auto logs = one_log({}, 60.0);
    logs.push_back(log_of({.half_waves = 3, .seed = 2}, 20.0));
    const HalfWaveLaw law = find_half_wave_law(logs, 20.0, 0.0);
    EXPECT_EQ(law.n_switches, 29 + 9);
    EXPECT_LT(std::abs(errors_off(law.half_wave_v, 40.0)), 4.0);
}

// Forty ticks leave exp(-4) of the miss, 0.29 V of a voltage that is known to millivolts.
TEST(HalfWaveLaw, a_slow_loop_is_waited_for) {
    const auto logs = one_log({.tau_s = 0.05, .segment_ticks = 2000}, 400.0);
    EXPECT_GT(logs[0].rest_after_ticks, 79.0);
    const HalfWaveLaw law = find_half_wave_law(logs, 20.0, 0.0);
    ASSERT_TRUE(law.half_wave_v.determined) << law.half_wave_v.reason;
    EXPECT_LT(std::abs(errors_off(law.half_wave_v, 40.0)), 4.0);
    const auto never = one_log({.tau_s = 5.0, .segment_ticks = 400}, 100.0);
    EXPECT_FALSE(find_half_wave_law(never, 20.0, 0.0).half_wave_v.determined);
}
