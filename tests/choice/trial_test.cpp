#include <zlg/choice/trial.hpp>
#include <zlg/config/schema.hpp>

#include "forecast.hpp"
#include "ramps.hpp"
#include "test.hpp"

namespace zlg::trial_test {

using namespace choice;

Requirement required(const std::string& more = "") {
    return parse_requirement("[require]\nrun_s = 60\nangle_error_arcsec = 10\n" + more, "r.toml");
}

// Segment by segment, by Simpson's rule of eq (5).
double by_segments(const design::GyroDrift& gyro, double run_s, double interval_s, double first_s) {
    const auto om = [&](double t) {
        return gyro.magnetic_arcsec_s + gyro.magnetic_thermal_arcsec_s * (1.0 - std::exp(-t / gyro.thermal_time_s));
    };
    double sum = 0.0, sign = 1.0, at = 0.0, end = first_s;
    while (at < run_s) {
        const double to = std::min(end, run_s);
        constexpr int parts = 50;
        const double step = (to - at) / parts;
        for (int k = 0; k < parts; ++k) {
            const double from = at + k * step;
            sum += sign * step / 6.0 * (om(from) + 4.0 * om(from + 0.5 * step) + om(from + step));
        }
        sign = -sign;
        at = to;
        end += interval_s;
    }
    return sum;
}

TEST(Forecast, the_magnetic_angle_is_the_sum_of_the_segments) {
    const design::GyroDrift gyro{.magnetic_arcsec_s = 0.7, .magnetic_thermal_arcsec_s = -1.1, .thermal_time_s = 500.0};
    for (const double run_s : {60.0, 600.0, 613.0})
        for (const double interval_s : {7.0, 60.0, 100.0, 600.0, 700.0}) {
            const Candidate full{.interval_s = interval_s};
            const Candidate half{.interval_s = interval_s, .first_segment = config::FirstSegment::half};
            EXPECT_NEAR(magnetic_angle_arcsec(gyro, run_s, full), by_segments(gyro, run_s, interval_s, interval_s),
                        1e-4)
                << run_s << ", " << interval_s;
            EXPECT_NEAR(magnetic_angle_arcsec(gyro, run_s, half),
                        by_segments(gyro, run_s, interval_s, 0.5 * interval_s), 1e-4)
                << run_s << ", " << interval_s;
        }
}

// Over unlike rates the places within a fringe are even and independent. Counts round both ends: of the difference the
// mean square is K^2/6, the mean fourth power K^4/15. By phase the first ticks are counted, until the ellipse is
// learnt: the start alone is rounded, K^2/12 and K^4/80.
TEST(Forecast, rounding_is_that_of_both_ends_by_counts_and_of_the_start_by_phase) {
    const Requirement r = required(
        "[motion]\nkind = \"constant\"\n[drift]\nrandom_walk_arcsec_sqrt_s = 0\nmagnetic_arcsec_s = 0.001\n"
        "magnetic_thermal_arcsec_s = 0\n"
        "[[tolerance]]\nkeys = [\"motion.rate_arcsec_s\"]\ndraw = \"uniform\"\nmin = 1000\nmax = 3000\n");
    constexpr int n = 200;
    const double count2 = 3.263 * 3.263;
    const Population gyros{r, 1, n};
    Forecast forecast{gyros, 1, {}};
    for (const Reading reading : {Reading::x1, Reading::phase}) {
        const bool is_phase = reading == Reading::phase;
        const double expected = count2 / (is_phase ? 12.0 : 6.0);
        const double fourth = count2 * count2 / (is_phase ? 80.0 : 15.0);
        const Candidate no_switch{.method = {.reading = reading}, .interval_s = 60.0};
        double square = 0.0;
        for (int k = 0; k < n; ++k)
            square += std::pow(gyros.run(k, no_switch, config::Fidelity::events, {}).error_arcsec, 2) / n;
        EXPECT_NEAR(forecast.parts(no_switch).rounding, expected, 1e-12);
        EXPECT_NEAR(square, expected, 4.0 * std::sqrt((fourth - expected * expected) / n)) << in_words(no_switch);
    }
}

TEST(Trial, a_gyro_without_chance_ends_with_what_the_magnetic_drift_leaves) {
    Requirement r = required(
        "[motion]\nkind = \"constant\"\nrate_arcsec_s = 37.3\n[drift]\nrandom_walk_arcsec_sqrt_s = "
        "0\nmagnetic_arcsec_s = 20\n[compensation]\nrelock_ticks = 20\n");
    const Candidate candidate{.interval_s = 40.0};  // one switch: 40 - 20 s of 20 arcsec/s
    const Population one{r, 1, 1};
    const Trial trial = one.run(0, candidate, config::Fidelity::averaged, {});
    ASSERT_EQ(trial.state, TrialState::good) << trial.reason;
    EXPECT_EQ(trial.switches, 1);
    const double expected = magnetic_angle_arcsec({.magnetic_arcsec_s = 20.0}, 60.0, candidate);
    EXPECT_NEAR(expected, 400.0, 1.0);
    // One switch of some 6 arcsec by mean_square, two roundings, and 15 ms of a gap without the drift.
    EXPECT_NEAR(trial.error_arcsec, expected, 30.0);
}

TEST(Trial, the_gyros_of_a_population_do_not_depend_on_what_is_chosen) {
    const Requirement r = required(
        "[[tolerance]]\nkeys = [\"perimeter.miss_lambda\"]\ndraw = \"uniform\"\nmin = 0.1\n"
        "max = 0.2\n");
    const Population gyros{r, 3, 50};
    const config::Config a = gyros.gyro(7, {.interval_s = 20.0});
    const config::Config b = gyros.gyro(7, {.method = {.reading = Reading::x4}, .interval_s = 50.0});
    EXPECT_EQ(a.perimeter.miss_lambda, b.perimeter.miss_lambda);
    EXPECT_EQ(a.run.seed, b.run.seed);
    EXPECT_NE(a.run.seed, gyros.gyro(8, {.interval_s = 20.0}).run.seed);
    EXPECT_NE(a.run.seed, (Population{r, 4, 50}.gyro(7, {.interval_s = 20.0}).run.seed));
}

TEST(Trial, a_gyro_that_the_tolerances_make_impossible_is_refused) {
    const Requirement r = required(
        "[[tolerance]]\nkeys = [\"drift.thermal_time_s\"]\ndraw = \"normal\"\nmean = 1\n"
        "sd = 1000\n");
    const Population gyros{r, 1, 20};
    int refused = 0;
    for (int k = 0; k < 20; ++k) try {
            (void)gyros.gyro(k, {.interval_s = 60.0});
        } catch (const config::ConfigError&) {
            ++refused;
            EXPECT_EQ(gyros.run(k, {.interval_s = 60.0}, config::Fidelity::averaged, {}).state, TrialState::refused);
        }
    EXPECT_GT(refused, 2) << "half of the times are negative";
    EXPECT_LT(refused, 18);
}

TEST(Ramps, lie_over_each_switch_up_and_down_in_turn) {
    const Requirement r = required("angular_acceleration_arcsec_s2 = 100\n[motion]\nkind = \"rest\"\n");
    config::Config gyro = with(r.base, {.interval_s = 10.0});
    const twin::Motion motion = with_ramps(r, gyro, twin::Motion::rest());
    const auto rate = [&](double at_s) { return motion.increment_arcsec(at_s - 1e-4, at_s + 1e-4) / 2e-4; };
    EXPECT_EQ(rate(5.0), 0.0);
    EXPECT_NEAR(rate(15.0), 100.0, 1e-6);
    EXPECT_NEAR(rate(25.0), 0.0, 1e-6);
    for (int k = 1; k <= 5; ++k) {
        const double slope = (rate(10.0 * k + 1e-3) - rate(10.0 * k - 1e-3)) / 2e-3;
        EXPECT_NEAR(slope, k % 2 == 1 ? 100.0 : -100.0, 1e-3) << k;
    }
}

}  // namespace zlg::trial_test
