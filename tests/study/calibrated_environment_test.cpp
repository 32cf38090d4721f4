// Calibration against the twin in ramps, soaks and a chamber's cycle, with a bias that bends and a field that is known.

#include <zlg/calibration/calibration.hpp>
#include <zlg/calibration/lab_reader.hpp>
#include <zlg/chance/draw.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/environment.hpp>

#include "test.hpp"

namespace zlg::calibrated_environment_test {

constexpr double log_s = 200.0;
constexpr double rate_arcsec_s = 50.0;

// A ramp, a soak or a chamber's cycle, quick, with a sensor that follows at once; a field that swings, steps or stands.
// Of two gyros one walks as the default does, the other ten times as far.
config::Config gyro(std::uint64_t number) {
    const chance::Draws draws{.seed = 3, .cause = chance::Cause::environment, .trial = number};
    config::Config c;
    c.run.seed = number + 1;
    c.gyro.light_samples = 8;
    c.gyro.bias_hz = draws.of("bias").within(50e3, 70e3);
    if (number / 3 % 2 == 0) c.drift.random_walk_arcsec_sqrt_s = draws.of("walk").within(1.0, 2.0);
    c.switching.interval_s = 2.0;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = rate_arcsec_s;
    const double swing_c = draws.of("swing").within(20.0, 40.0);
    auto& points = c.temperature.profile.points;
    if (number % 3 == 0)
        points = {{0.0, 0.0}, {log_s, swing_c}};
    else if (number % 3 == 1)
        points = {{0.0, 0.0}, {0.25 * log_s, swing_c}, {log_s, 0.4 * swing_c}};
    else
        points = {{0.0, 10.0}, {0.25 * log_s, 10.0 + swing_c}, {0.75 * log_s, 10.0 - swing_c}, {log_s, 10.0}};
    c.field = {.kind = static_cast<config::FieldKind>(1 + number % 3),
               .field_g = draws.of("field").within(0.4, 0.6),
               .frequency_hz = draws.of("frequency").within(0.005, 0.02),
               .course = {{{0.0, 0.5}, {0.3 * log_s, -0.3}, {0.6 * log_s, 0.4}}, {}},
               .sensitivity_arcsec_s_g = draws.of("sensitivity").within(15.0, 30.0),
               .sensitivity_per_c = draws.of("per_c").within(-0.02, -0.005)};
    return c;
}

// A parabola with its top somewhere near the temperatures of the log, or one kink.
void bend(config::Config& c, std::uint64_t number) {
    const chance::Draws draws{.seed = 4, .cause = chance::Cause::environment, .trial = number};
    auto& table = c.gyro.bias_temperature_table.points;
    if (draws.of("kink").is_one_in(2)) {
        table = {{-40.0, -0.015}, {draws.of("at").within(15.0, 25.0), 0.0}, {80.0, -0.04}};
        return;
    }
    const double top_c = draws.of("top").within(0.0, 40.0);
    const double per_c2 = draws.of("bend").within(5e-6, 5e-5);
    for (double at_c = -40.0; at_c <= 80.0; at_c += 1.0)
        table.push_back({at_c, per_c2 * ((20.0 - top_c) * (20.0 - top_c) - (at_c - top_c) * (at_c - top_c))});
}

calibration::Calibration calibrated(const config::Config& c) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    calibration::LabReader reader{"twin", c.gyro.tick_s};
    for (std::int64_t h = 0; h < std::llround(2.0 * log_s / c.gyro.tick_s); ++h) reader.take(loop.advance().record);
    const std::vector<calibration::LabLog> logs{reader.finish()};
    calibration::Presumed presumed{.rate_arcsec_s = rate_arcsec_s};
    if (c.field.kind != config::FieldKind::none)
        presumed.field.of_logs = {[field = c.field](double time_s) { return twin::field_g(field, time_s); }};
    return calibration::calibrate(logs, presumed);
}

const numeric::Estimate& estimate(const calibration::Calibration& found, std::string_view key) {
    return std::ranges::find(found.constants, key, &calibration::Constant::key)->estimate;
}

struct Errors {
    double sum_sq = 0.0, n = 0.0, worst = 0.0;

    void add(double error_in_sigma) {
        sum_sq += error_in_sigma * error_in_sigma;
        n += 1.0;
        worst = std::max(worst, std::abs(error_in_sigma));
    }
    void add(const numeric::Estimate& e, double truth) {
        ASSERT_TRUE(e.determined) << e.reason;
        add((e.value - truth) / e.sigma);
    }
    void expect_true(const char* what) const {
        EXPECT_GT(sum_sq / n, 0.5) << what << ", " << n << " of them";
        EXPECT_LT(sum_sq / n, 1.5) << what << ", " << n << " of them";
        EXPECT_LT(worst, 4.5) << what;
    }
};

// by_c  what the sensor is behind.
void add_knots(const config::Config& c, const calibration::Calibration& found, double by_c, Errors& errors) {
    const calibration::BiasTable& table = found.bias_table;
    EXPECT_FALSE(table.knots.empty()) << table.reason;
    const double line_hz = estimate(found, "gyro.bias_hz").value;
    for (std::size_t k = 0; k < table.knots.size(); ++k) {
        const double change = twin::bias_change(c.gyro, table.knots[k][0] + by_c - c.gyro.reference_temperature_c);
        errors.add((line_hz * (1.0 + table.knots[k][1]) - c.gyro.bias_hz * (1.0 + change)) /
                   (line_hz * table.sigma[k]));
    }
}

TEST(CalibratedEnvironment, the_sensitivity_and_the_knots_of_the_bias_are_true_within_their_errors) {
    Errors sensitivity, per_c, knots;
    for (std::uint64_t number = 0; number < 24; ++number) {
        config::Config c = gyro(number);
        bend(c, number);
        const calibration::Calibration found = calibrated(c);
        sensitivity.add(estimate(found, "field.sensitivity_arcsec_s_g"), c.field.sensitivity_arcsec_s_g);
        per_c.add(estimate(found, "field.sensitivity_per_c"), c.field.sensitivity_per_c);
        add_knots(c, found, 0.0, knots);
    }
    sensitivity.expect_true("sensitivity");
    per_c.expect_true("per C");
    knots.expect_true("knots");
}

TEST(CalibratedEnvironment, a_sensor_that_lags_shifts_the_knots_by_lag_times_ramp) {
    Errors shifted, knots;
    for (std::uint64_t number = 0; number < 24; number += 3) {
        config::Config c = gyro(number);
        bend(c, number);
        c.temperature.sensor_lag_s = 3.0;
        const double ramp_c_s = c.temperature.profile.points.back().value / log_s;
        const calibration::Calibration found = calibrated(c);
        add_knots(c, found, c.temperature.sensor_lag_s * ramp_c_s, shifted);
        add_knots(c, found, 0.0, knots);
    }
    shifted.expect_true("knots at what the gyro was");
    EXPECT_GT(knots.sum_sq / knots.n, 4.0);
}

TEST(CalibratedEnvironment, nothing_is_found_that_the_logs_do_not_tell) {
    config::Config c = gyro(0);
    c.gyro.bias_temperature_coefficient_per_c = -1e-3;
    const calibration::Calibration straight = calibrated(c);
    EXPECT_TRUE(straight.bias_table.knots.empty());
    EXPECT_TRUE(straight.bias_table.reason.starts_with("the line of bias_temperature_coefficient_per_c holds"));
    EXPECT_TRUE(estimate(straight, "drift.magnetic_arcsec_s").reason.starts_with("the field is known"));

    c.field.field_g = 0.0;
    const calibration::Calibration in_no_field = calibrated(c);
    EXPECT_EQ(estimate(in_no_field, "field.sensitivity_arcsec_s_g").reason, "the field is 0");
    EXPECT_TRUE(estimate(in_no_field, "field.sensitivity_per_c").reason.starts_with("the sensitivity itself"));
    EXPECT_TRUE(estimate(in_no_field, "drift.nonmagnetic_arcsec_s").determined);

    c = gyro(0);
    c.temperature.profile.points = {{0.0, 20.0}, {log_s, 20.5}};
    const calibration::Calibration at_one = calibrated(c);
    EXPECT_TRUE(at_one.bias_table.reason.starts_with("the temperature spans 0.")) << at_one.bias_table.reason;
    EXPECT_TRUE(estimate(at_one, "field.sensitivity_arcsec_s_g").determined);
    EXPECT_TRUE(estimate(at_one, "field.sensitivity_per_c").reason.starts_with("the temperature spans 0."));

    c.field.kind = config::FieldKind::none;
    const calibration::Calibration unknown = calibrated(c);
    EXPECT_EQ(estimate(unknown, "field.sensitivity_arcsec_s_g").reason, "the field of a log is not known");
    EXPECT_EQ(estimate(unknown, "field.sensitivity_per_c").reason, "the field of a log is not known");
}

}  // namespace zlg::calibrated_environment_test
