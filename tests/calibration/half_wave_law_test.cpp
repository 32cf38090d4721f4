#include <zlg/calibration/half_wave_law.hpp>

#include "synthetic_gyro.hpp"

using namespace zlg::calibration;
using namespace synthetic;

namespace {

// 0, 20 and 40 C, 1e-3 per C.
std::vector<LabLog> at_three_temperatures(double half_wave_v, double quantum_v, double noise_v, double duration_s,
                                          unsigned first_seed = 1) {
    std::vector<LabLog> logs;
    for (unsigned k = 0; k < 3; ++k)
        logs.push_back(log_of({.start_c = 20.0 * k,
                               .half_wave_v = half_wave_v * (1.0 + 1e-3 * (20.0 * k - 20.0)),
                               .quantum_v = quantum_v,
                               .noise_v = noise_v,
                               .seed = first_seed + k},
                              duration_s));
    return logs;
}

}  // namespace

TEST(HalfWaveLaw, finds_the_voltage_and_its_law) {
    const auto logs = one_log({.rise_c = 10.0, .half_wave_v = 43.0, .half_wave_per_c = 2e-3}, 120.0);
    const HalfWaveLaw law = find_half_wave_law(logs, 20.0, 0.0);
    ASSERT_TRUE(law.half_wave_v.determined) << law.half_wave_v.reason;
    EXPECT_LT(std::abs(errors_off(law.half_wave_v, 43.0)), 4.0);
    EXPECT_LT(std::abs(errors_off(law.temperature_coefficient_per_c, 2e-3)), 4.0);
    EXPECT_LT(law.half_wave_v.sigma, 0.005);
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

// Every log meets codes of its own, as often as it switches: three errors of q/sqrt 12 at 0, 20 and 40 C make a slope
// of variance q^2/12 / (20^2 + 20^2). That of the lower voltage is common to all.
TEST(HalfWaveLaw, logs_of_a_converter_without_noise_know_the_law_to_its_codes) {
    const double q_v = 0.073;
    for (const double duration_s : {30.0, 120.0}) {
        const HalfWaveLaw law = find_half_wave_law(at_three_temperatures(43.0, q_v, 0.0, duration_s), 20.0, 0.0);
        ASSERT_TRUE(law.temperature_coefficient_per_c.determined);
        const double sigma_per_c = q_v / std::sqrt(12.0 * 800.0) / 43.0;
        EXPECT_NEAR(law.temperature_coefficient_per_c.sigma, sigma_per_c, 0.1 * sigma_per_c) << duration_s;
    }
}

TEST(HalfWaveLaw, errors_of_many_gyros_with_a_coarse_converter_are_those_stated) {
    constexpr int n = 20;
    for (const double noise_v : {0.0, 0.02, 0.04}) {
        double voltage_sq = 0.0;
        double coefficient_sq = 0.0;
        for (int k = 0; k < n; ++k) {
            const double half_wave_v = 40.0 + 0.6417 * k;
            const auto logs = at_three_temperatures(half_wave_v, 0.073, noise_v, 24.0, 3 * static_cast<unsigned>(k));
            const HalfWaveLaw law = find_half_wave_law(logs, 20.0, 0.0);
            const double voltage = errors_off(law.half_wave_v, half_wave_v);
            const double coefficient = errors_off(law.temperature_coefficient_per_c, 1e-3);
            EXPECT_LT(std::abs(voltage), 4.0) << noise_v << " V, gyro " << k;
            EXPECT_LT(std::abs(coefficient), 4.0) << noise_v << " V, gyro " << k;
            voltage_sq += voltage * voltage / n;
            coefficient_sq += coefficient * coefficient / n;
        }
        // Noise of a third of a code is distinguished from none only where a voltage is not in the middle of a code:
        // there the standard error is cautious.
        for (const double mean_sq : {voltage_sq, coefficient_sq}) {
            EXPECT_LT(mean_sq, 2.0) << noise_v;
            EXPECT_GT(mean_sq, 0.1) << noise_v;
        }
    }
}

// The upper voltage passes a dozen codes, the lower one stands still in a single code.
TEST(HalfWaveLaw, a_voltage_that_moves_does_not_make_up_for_one_that_stands) {
    const auto logs = one_log(
        {.rise_c = 10.0, .half_wave_v = 43.0, .half_wave_per_c = 2e-3, .quantum_v = 0.073, .noise_v = 0.0}, 120.0);
    const HalfWaveLaw law = find_half_wave_law(logs, 25.0, 0.0);
    EXPECT_GT(law.half_wave_v.sigma, 0.95 * 0.073 / std::sqrt(12.0));
    EXPECT_LT(law.half_wave_v.sigma, 1.2 * 0.073 / std::sqrt(12.0));
}

// The control goes up from readings that are too low: the readings by which it decides do not count.
TEST(HalfWaveLaw, readings_that_direct_a_switch_do_not_pull_the_voltage) {
    const SyntheticGyro gyro;
    const auto directed = [&](HalfRecord& r) {
        if (r.half / 2 % gyro.segment_ticks >= gyro.segment_ticks - 4) r.piezo_v -= 0.1 * r.mode;
    };
    const std::vector<LabLog> pulled{log_of(gyro, 60.0, directed)};
    EXPECT_EQ(find_half_wave_law(pulled, 20.0, 0.0).half_wave_v.value,
              find_half_wave_law(one_log(gyro, 60.0), 20.0, 0.0).half_wave_v.value);
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
