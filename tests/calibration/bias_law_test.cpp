#include <zlg/calibration/bias_law.hpp>

#include "synthetic_gyro.hpp"

using namespace zlg;
using namespace zlg::calibration;
using namespace synthetic;

TEST(BiasLaw, finds_bias_and_coefficient_with_either_half_first) {
    for (const int first_sign : {1, -1}) {
        SyntheticGyro gyro{.bias_per_c = -5e-4, .rise_c = 10.0, .first_sign = first_sign};
        const auto logs = one_log(gyro, 120.0);
        const BiasLaw law = find_bias_law(logs, 20.0, 0.0);
        ASSERT_TRUE(law.bias_hz.determined) << law.bias_hz.reason;
        ASSERT_TRUE(law.temperature_coefficient_per_c.determined);
        EXPECT_LT(std::abs(errors_off(law.bias_hz, gyro.bias_hz)), 4.0);
        EXPECT_LT(std::abs(errors_off(law.temperature_coefficient_per_c, -5e-4)), 4.0);
        // A thousandth of a count a half is 0.4 Hz.
        EXPECT_LT(law.bias_hz.sigma, 10.0);
        EXPECT_LT(law.temperature_coefficient_per_c.sigma, 2e-5);
        EXPECT_NEAR(law.at_hz(30.0), gyro.bias_hz * (1.0 - 5e-3), 15.0);
    }
}

TEST(BiasLaw, refers_to_the_reference_temperature_that_is_asked_for) {
    const SyntheticGyro gyro{.bias_per_c = -5e-4, .start_c = 30.0, .rise_c = 10.0};
    const auto logs = one_log(gyro, 120.0);
    const BiasLaw law = find_bias_law(logs, 20.0, 0.0);
    // f(20) = f(30) (1 + 5e-3), and the coefficient is relative to f(20).
    EXPECT_LT(std::abs(errors_off(law.bias_hz, gyro.bias_hz * 1.005)), 4.0);
    EXPECT_LT(std::abs(errors_off(law.temperature_coefficient_per_c, -5e-4 / 1.005)), 4.0);
}

TEST(BiasLaw, several_logs_make_a_law_that_none_of_them_shows) {
    std::vector<LabLog> logs;
    for (const double t_c : {0.0, 20.0, 40.0}) {
        SyntheticGyro gyro{.bias_hz = 60'123.4 * (1.0 - 5e-4 * (t_c - 20.0)), .start_c = t_c};
        gyro.seed = static_cast<std::uint64_t>(t_c) + 1;
        logs.push_back(log_of(gyro, 40.0));
    }
    const BiasLaw law = find_bias_law(logs, 20.0, 0.0);
    ASSERT_TRUE(law.temperature_coefficient_per_c.determined);
    EXPECT_LT(std::abs(errors_off(law.temperature_coefficient_per_c, -5e-4)), 4.0);
    EXPECT_FALSE(find_bias_law({logs.data(), 1}, 20.0, 0.0).temperature_coefficient_per_c.determined);
}

TEST(BiasLaw, one_temperature_determines_the_bias_by_the_presumed_coefficient) {
    const SyntheticGyro gyro{.start_c = 30.0};
    const auto logs = one_log(gyro, 60.0);
    const BiasLaw law = find_bias_law(logs, 20.0, -1e-3);
    EXPECT_FALSE(law.temperature_coefficient_per_c.determined);
    EXPECT_NE(law.temperature_coefficient_per_c.reason.find("span"), std::string::npos);
    ASSERT_TRUE(law.bias_hz.determined);
    EXPECT_LT(std::abs(errors_off(law.bias_hz, gyro.bias_hz / 0.99)), 4.0);
}

TEST(BiasLaw, no_column_of_temperature_is_no_reason_against_the_bias) {
    const SyntheticGyro gyro;
    const std::vector<LabLog> logs{
        log_of(gyro, 60.0, [](HalfRecord& r) { r.temperature_c = std::numeric_limits<double>::quiet_NaN(); })};
    const BiasLaw law = find_bias_law(logs, 20.0, -1e-3);
    EXPECT_FALSE(law.temperature_coefficient_per_c.determined);
    ASSERT_TRUE(law.bias_hz.determined);
    EXPECT_LT(std::abs(errors_off(law.bias_hz, gyro.bias_hz)), 4.0);
}

TEST(BiasLaw, a_counter_that_shows_one_number_is_not_taken_for_certain) {
    // 150.004 counts a half, and an angle that does not move: every half shows 150.
    const SyntheticGyro gyro{.bias_hz = 60'001.6, .rate_arcsec_s = 0.0};
    const auto logs = one_log(gyro, 60.0);
    const BiasLaw law = find_bias_law(logs, 20.0, 0.0);
    ASSERT_TRUE(law.bias_hz.determined);
    EXPECT_GT(law.bias_hz.sigma, 1.0);
    EXPECT_LT(std::abs(errors_off(law.bias_hz, gyro.bias_hz)), 4.0);
}

// Whether a counter steps in a segment is bound up with how it is rounded there: weights that looked at it would pull.
TEST(BiasLaw, a_gyro_that_hardly_turns_is_estimated_without_bias) {
    double sum = 0.0;
    double sum_sq = 0.0;
    constexpr int trials = 60;
    for (int trial = 0; trial < trials; ++trial) {
        const SyntheticGyro gyro{.bias_hz = 60e3 + 6.7 * trial,
                                 .light_samples = 1,
                                 .rate_arcsec_s = 0.7,
                                 .walk_arcsec_sqrt_s = 0.3,
                                 .segment_ticks = 200,
                                 .seed = 40 + static_cast<std::uint64_t>(trial)};
        const auto logs = one_log(gyro, 60.0);
        const double off = errors_off(find_bias_law(logs, 20.0, 0.0).bias_hz, gyro.bias_hz);
        sum += off;
        sum_sq += off * off;
    }
    EXPECT_NEAR(sum / trials, 0.0, 3.0 / std::sqrt(trials));
    EXPECT_NEAR(sum_sq / trials, 1.0, 0.6);
}

TEST(BiasLaw, refuses_a_bias_that_part_of_the_log_contradicts_and_one_below_its_error) {
    auto logs = one_log(SyntheticGyro{.rise_c = 10.0}, 60.0);
    EXPECT_FALSE(find_bias_law(logs, 20.0, 0.0).contradicts);
    for (Block& block : logs.front().blocks)
        if (block.first_tick > 8000) block.difference = -block.difference;
    const BiasLaw part = find_bias_law(logs, 20.0, 0.0);
    EXPECT_TRUE(part.contradicts);
    EXPECT_FALSE(part.bias_hz.determined);
    EXPECT_FALSE(part.temperature_coefficient_per_c.determined);
    std::int64_t sign = 1;
    for (Block& block : logs.front().blocks) block.difference *= sign = -sign;
    const BiasLaw none = find_bias_law(logs, 20.0, 0.0);
    EXPECT_TRUE(none.contradicts);
    EXPECT_FALSE(none.bias_hz.determined) << none.bias_hz.value;
}

TEST(BiasLaw, refuses_what_is_too_short_and_a_sign_that_is_wrong) {
    const auto logs = one_log(SyntheticGyro{}, 0.3);
    EXPECT_FALSE(find_bias_law(logs, 20.0, 0.0).bias_hz.determined);
    EXPECT_NE(find_bias_law(logs, 20.0, 0.0).bias_hz.reason.find("stretches"), std::string::npos);
    const auto turned = one_log(SyntheticGyro{.bias_hz = -60e3}, 60.0);
    const numeric::Estimate bias = find_bias_law(turned, 20.0, 0.0).bias_hz;
    EXPECT_FALSE(bias.determined);
    EXPECT_NE(bias.reason.find("sign"), std::string::npos);
}

TEST(BiasLaw, a_table_has_its_slope_up_to_its_ends) {
    BiasLaw law{.bias_hz = numeric::estimated(60e3, 1.0), .table = {.knots = {{0.0, 1e-3}, {20.0, 0.0}, {22.0, 4e-4}}}};
    for (const double t_c : {-5.0, 0.0, 0.3, 10.0}) EXPECT_NEAR(law.slope_hz_per_c(t_c), -3.0, 1e-9) << t_c;
    for (const double t_c : {21.0, 21.9, 22.0, 30.0}) EXPECT_NEAR(law.slope_hz_per_c(t_c), 12.0, 1e-9) << t_c;
    EXPECT_NEAR(law.slope_hz_per_c(20.0), 4.5, 1e-9);
    law.table.knots = {{20.0, 0.0}, {20.5, 1e-4}};
    EXPECT_NEAR(law.slope_hz_per_c(20.5), 12.0, 1e-9);
    law.table.knots.clear();
    law.coefficient_taken_per_c = -5e-4;
    EXPECT_NEAR(law.slope_hz_per_c(60.0), -30.0, 1e-9);
}
