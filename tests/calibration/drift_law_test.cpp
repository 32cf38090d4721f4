#include <zlg/calibration/drift_law.hpp>

#include "synthetic_gyro.hpp"

using namespace zlg::calibration;
using namespace synthetic;
using std::numbers::pi;

namespace {

DriftLaw drift_of(const SyntheticGyro& gyro, double duration_s, double known_rate_arcsec_s = 0.0) {
    const auto logs = one_log(gyro, duration_s);
    return find_drift_law(logs, gyro.scale_arcsec, known_rate_arcsec_s, find_bias_law(logs, 20.0, 0.0));
}

SyntheticGyro warming_gyro() {
    return {.light_samples = 1,
            .magnetic_arcsec_s = 3.0,
            .thermal_arcsec_s = -8.0,
            .thermal_s = 40.0,
            .rate_arcsec_s = 2.0,
            .walk_arcsec_sqrt_s = 1.5};
}

}  // namespace

TEST(DriftLaw, tells_all_parts_of_a_log_that_bends) {
    const SyntheticGyro gyro = warming_gyro();
    const DriftLaw law = drift_of(gyro, 300.0);
    ASSERT_TRUE(law.rest.at_rest);
    ASSERT_TRUE(law.thermal_time_s.determined) << law.thermal_time_s.reason;
    EXPECT_LT(std::abs(errors_off(law.magnetic_arcsec_s, 3.0)), 4.0);
    EXPECT_LT(std::abs(errors_off(law.magnetic_thermal_arcsec_s, -8.0)), 4.0);
    EXPECT_LT(std::abs(errors_off(law.thermal_time_s, 40.0)), 4.0);
    EXPECT_LT(std::abs(errors_off(law.nonmagnetic_arcsec_s, 2.0)), 4.0);
    ASSERT_TRUE(law.random_walk_arcsec_sqrt_s.determined);
    EXPECT_LT(std::abs(errors_off(law.random_walk_arcsec_sqrt_s, 1.5)), 4.0);
    EXPECT_LT(law.nonmagnetic_arcsec_s.sigma, 0.15);
    EXPECT_LT(law.random_walk_arcsec_sqrt_s.sigma, 0.2);
}

TEST(DriftLaw, a_known_rate_is_no_drift) {
    SyntheticGyro gyro = warming_gyro();
    gyro.rate_arcsec_s = 502.0;
    EXPECT_LT(std::abs(errors_off(drift_of(gyro, 200.0, 500.0).nonmagnetic_arcsec_s, 2.0)), 4.0);
}

// s (T/4) df/dt: 120 Hz/s would pass for 0.15 counts/s, half an arcsecond a second.
TEST(DriftLaw, a_bias_that_warms_is_no_magnetic_drift) {
    for (const int first_sign : {1, -1}) {
        const SyntheticGyro gyro{.bias_per_c = 2e-3,
                                 .rise_c = 200.0,
                                 .light_samples = 1,
                                 .rate_arcsec_s = 20.0,
                                 .walk_arcsec_sqrt_s = 0.1,
                                 .first_sign = first_sign};
        const DriftLaw law = drift_of(gyro, 200.0);
        ASSERT_TRUE(law.magnetic_arcsec_s.determined);
        EXPECT_LT(law.magnetic_arcsec_s.sigma, 0.4);
        EXPECT_LT(std::abs(law.magnetic_arcsec_s.value), 0.3) << "uncorrected it is 0.49";
    }
}

TEST(DriftLaw, a_log_that_is_short_against_the_warming_tells_only_its_slope) {
    SyntheticGyro gyro = warming_gyro();
    gyro.thermal_s = 3000.0;
    gyro.thermal_arcsec_s = 300.0;
    const DriftLaw law = drift_of(gyro, 200.0);
    EXPECT_FALSE(law.magnetic_thermal_arcsec_s.determined);
    EXPECT_NE(law.thermal_time_s.reason.find("A/tau"), std::string::npos);
    ASSERT_TRUE(law.magnetic_arcsec_s.determined);
    EXPECT_LT(std::abs(errors_off(law.magnetic_arcsec_s, 3.0)), 4.0);
}

TEST(DriftLaw, no_warming_is_told_as_none) {
    SyntheticGyro gyro = warming_gyro();
    gyro.thermal_arcsec_s = 0.0;
    const DriftLaw law = drift_of(gyro, 200.0);
    EXPECT_FALSE(law.thermal_time_s.determined);
    EXPECT_NE(law.thermal_time_s.reason.find("does not change"), std::string::npos);
    EXPECT_LT(std::abs(errors_off(law.magnetic_arcsec_s, 3.0)), 4.0);
}

TEST(DriftLaw, rounding_hides_a_small_walk) {
    SyntheticGyro gyro = warming_gyro();
    gyro.walk_arcsec_sqrt_s = 0.05;
    const DriftLaw law = drift_of(gyro, 200.0);
    EXPECT_FALSE(law.random_walk_arcsec_sqrt_s.determined);
    EXPECT_NE(law.random_walk_arcsec_sqrt_s.reason.find("rounding"), std::string::npos);
}

TEST(DriftLaw, one_mode_cannot_tell_the_kinds_apart) {
    SyntheticGyro gyro = warming_gyro();
    gyro.mode_changes = 0;
    const DriftLaw law = drift_of(gyro, 100.0);
    EXPECT_FALSE(law.magnetic_arcsec_s.determined);
    EXPECT_NE(law.nonmagnetic_arcsec_s.reason.find("one mode"), std::string::npos);
}

TEST(DriftLaw, a_gyro_that_is_moved_is_refused) {
    for (const auto& [rate_arcsec_s, hz] : {std::pair{12'000.0, 7.03}, {300.0, 1.3}, {60.0, 0.31}}) {
        SyntheticGyro gyro = warming_gyro();
        gyro.sway_arcsec_s = rate_arcsec_s;
        gyro.sway_hz = hz;
        const DriftLaw law = drift_of(gyro, 200.0);
        EXPECT_FALSE(law.rest.at_rest) << hz;
        EXPECT_NE(law.magnetic_arcsec_s.reason.find("moved"), std::string::npos);
    }
}

// Of the warmings over which the mean is taken the quickest fits so badly that its weight vanishes.
TEST(DriftLaw, a_warming_that_cannot_be_does_not_spoil_the_mean) {
    SyntheticGyro gyro = warming_gyro();
    gyro.thermal_s = 30'000.0;
    gyro.thermal_arcsec_s = 10'000.0;
    gyro.walk_arcsec_sqrt_s = 0.05;
    const DriftLaw law = drift_of(gyro, 200.0);
    EXPECT_FALSE(law.thermal_time_s.determined);
    ASSERT_TRUE(law.magnetic_arcsec_s.determined) << law.magnetic_arcsec_s.reason;
    EXPECT_LT(std::abs(errors_off(law.magnetic_arcsec_s, 3.0)), 4.0);
    EXPECT_LT(std::abs(errors_off(law.nonmagnetic_arcsec_s, 2.0)), 4.0);
}

// A growth that shows, but not how quick it is: over 1/40 of the record, at twice and more its error. And none.
TEST(DriftLaw, the_start_is_as_uncertain_as_it_is_said_to_be_where_the_warming_is_not_known) {
    for (const double a : {-6.0, 0.0}) {
        double squares = 0.0;
        constexpr int n = 16;
        for (std::uint64_t seed = 1; seed <= n; ++seed) {
            SyntheticGyro gyro = warming_gyro();
            gyro.seed = seed;
            gyro.thermal_s = 5.0;
            gyro.thermal_arcsec_s = a;
            squares += std::pow(errors_off(drift_of(gyro, 200.0).magnetic_arcsec_s, 3.0), 2);
        }
        // chi-square of 16 degrees: 3.9 and 39.3 at 0.001 and 0.999. Without a warming the mean is known better than
        // any one of those over which it is taken, by about a third.
        EXPECT_GT(squares, a == 0.0 ? 0.6 * 3.9 : 3.9) << a;
        EXPECT_LT(squares, 39.3) << a;
    }
}

// Pieces of 3000 whole periods and a quarter: the quarter alone tells, 1/(2 pi f) of the amplitude of 1 G.
TEST(DriftLaw, a_field_is_integrated_over_long_pieces) {
    constexpr double hz = fastest_field_hz, sensitivity_arcsec_s_g = 1e4, scale_arcsec = 3.263;
    constexpr std::int64_t ticks = 600'050;
    LabLog log;
    for (std::int64_t k = 0; k < 16; ++k) {
        const std::int8_t mode = k % 2 == 0 ? 1 : -1;
        const double from = hz * 0.005 * static_cast<double>(k * ticks);
        const double g_s = (std::cos(2.0 * pi * from) - std::cos(2.0 * pi * (from + 0.25))) / (2.0 * pi * hz);
        log.segments.push_back({.mode = mode, .first_tick = k * ticks, .n_ticks = ticks, .n_settled = ticks});
        log.blocks.push_back({.segment = k, .first_tick = k * ticks, .n_ticks = ticks, .mode = mode});
        log.blocks.back().counts = std::llround(mode * sensitivity_arcsec_s_g * g_s / scale_arcsec);
    }
    const FieldCourse field = [](double time_s) { return std::sin(2.0 * pi * hz * time_s); };
    const DriftLaw law = find_drift_law(std::span{&log, 1}, scale_arcsec, 0.0, {}, std::span{&field, 1});
    ASSERT_TRUE(law.sensitivity_arcsec_s_g.determined) << law.sensitivity_arcsec_s_g.reason;
    EXPECT_NEAR(law.sensitivity_arcsec_s_g.value, sensitivity_arcsec_s_g, 0.003 * sensitivity_arcsec_s_g);
}
