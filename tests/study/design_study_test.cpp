
#include <zlg/config/schema.hpp>
#include <zlg/design/error.hpp>
#include <zlg/study/design_study.hpp>

#include "test.hpp"

namespace zlg::design_study_test {

using design::IntervalMethod;

const study::IntervalLine& line(const study::DesignResult& r, double run_s, IntervalMethod method) {
    for (const auto& l : r.intervals)
        if (l.run_s == run_s && l.method == method) return l;
    throw std::out_of_range{"no such line"};
}

const study::SubstitutionLine& line(const study::DesignResult& r, int order, int gap_ticks) {
    for (const auto& l : r.substitution)
        if (l.order == order && l.gap_ticks == gap_ticks) return l;
    throw std::out_of_range{"no such line"};
}

// Optima of the paper's gyro (A = Om = 0.7 arcsec/s, tau = 3000 s, dP = 10 arcsec), computed apart from this code.
TEST(DesignGyro, finds_the_intervals_of_the_papers_gyro) {
    const auto r = study::design_gyro({});
    EXPECT_NEAR(line(r, 600, IntervalMethod::corrected).optimum.interval_s, 88.7, 0.05);
    EXPECT_NEAR(line(r, 3600, IntervalMethod::corrected).optimum.interval_s, 195.2, 0.05);
    EXPECT_NEAR(line(r, 3600, IntervalMethod::corrected).optimum.drift_arcsec_s, 0.152, 5e-4);
    EXPECT_NEAR(line(r, 36000, IntervalMethod::as_printed).optimum.interval_s, 294.8, 0.05);
    EXPECT_NEAR(line(r, 36000, IntervalMethod::closed_form).optimum.interval_s, std::sqrt(10.0 * 36000 / 0.7), 0.05);
}

TEST(DesignGyro, gives_the_substitution_errors_of_the_configured_oscillation) {
    config::Config c;
    c.motion.frequency_hz = {20.0};
    const auto r = study::design_gyro(c);
    // Worst phase at 12 000 arcsec/s and 20 Hz, from direct integration of the ticks.
    EXPECT_NEAR(line(r, 0, 3).worst_arcsec, 154.51, 0.005);
    EXPECT_NEAR(line(r, 1, 3).worst_arcsec, 154.51, 0.005);
    EXPECT_NEAR(line(r, 2, 3).worst_arcsec, 26.85, 0.005);
    EXPECT_NEAR(line(r, 2, 1).worst_arcsec, 1.44, 0.005);
    EXPECT_NEAR(line(r, 2, 3).rms_arcsec, 26.85 / std::sqrt(2.0), 0.005);
    EXPECT_NEAR(line(r, 0, 3).noise_gain, 1.5, 1e-12);
    EXPECT_NEAR(line(r, 2, 3).noise_gain, 3.808, 5e-4);
}

TEST(DesignGyro, every_sine_of_a_sum_has_its_lines) {
    config::Config c;
    c.motion.kind = config::MotionKind::sum;
    c.motion.amplitude_arcsec_s = {100.0, 200.0};
    c.motion.frequency_hz = {3.0, 9.0};
    const auto r = study::design_gyro(c);
    ASSERT_EQ(r.substitution.size(), 3u * 5u * 4u) << "each, and both together";
    const auto& slow = r.substitution[0];
    const auto& fast = r.substitution[1];
    const auto& both = r.substitution[2];
    EXPECT_TRUE(std::isnan(both.frequency_hz));
    EXPECT_DOUBLE_EQ(both.worst_arcsec, slow.worst_arcsec + fast.worst_arcsec);
    EXPECT_DOUBLE_EQ(both.rms_arcsec, std::hypot(slow.rms_arcsec, fast.rms_arcsec));
}

TEST(DesignGyro, lays_the_gap_at_every_place_of_a_recorded_motion) {
    const std::string path = testing::TempDir() + "zlg-design-motion.txt";
    // An angle of k^3/6 at the end of row k: every second difference of the increments is 1, and a parabola follows.
    std::ofstream file{path};
    for (int k = 0; k < 400; ++k) file << (k * k) / 2.0 + k / 2.0 << '\n';
    file.close();
    config::Config c;
    c.gyro.tick_s = 0.01;
    c.motion.kind = config::MotionKind::file;
    c.motion.path = path;
    c.motion.column = "1";  // it rises as times do
    const auto r = study::design_gyro(c);
    EXPECT_NEAR(line(r, 2, 3).worst_arcsec, 0.0, 1e-6);
    // A constant through 2 + 2 points misses the curvature 1: -n (n + 2)(n + 4)/12 in the sum.
    EXPECT_NEAR(line(r, 0, 3).worst_arcsec, 3.0 * 5.0 * 7.0 / 12.0, 1e-6);
    EXPECT_NEAR(line(r, 0, 3).rms_arcsec, 3.0 * 5.0 * 7.0 / 12.0, 1e-6);
    std::remove(path.c_str());
}

TEST(DesignGyro, runs_the_digital_loop_itself_instead_of_a_model) {
    config::Config c;
    c.perimeter.loop = config::Loop::digital;
    c.perimeter.miss_lambda = 0.05;
    for (const double tau_s : {0.0065, 0.003, 0.0003}) {
        c.perimeter.tau_s = tau_s;
        const auto loop = study::design_gyro(c).loop;
        EXPECT_TRUE(loop.margins.stable) << tau_s;
        EXPECT_LT(loop.relock_s, 0.03) << tau_s;
        // A faster loop does not make the false angle smaller: 2.2 arcsec by the law, up to 3.9 for the loops of the
        // field.
        EXPECT_GT(loop.false_angle_arcsec, 0.95 * loop.false_angle_law_arcsec) << tau_s;
        EXPECT_LT(loop.false_angle_arcsec, 3.9) << tau_s;
    }
}

TEST(DesignGyro, a_miss_that_comes_of_itself_has_a_re_lock_too) {
    config::Config c;
    c.perimeter.miss_lambda = 0.0;
    const auto formula = study::design_gyro(c).loop;
    EXPECT_EQ(formula.relock_from_lambda, formula.miss.root_sum_square_lambda);
    c.perimeter.miss_lambda = formula.relock_from_lambda;
    EXPECT_EQ(study::design_gyro(c).loop.false_angle_arcsec, formula.false_angle_arcsec);
}

TEST(DesignGyro, says_why_a_re_lock_has_no_time) {
    config::Config c;
    c.perimeter.tau_s = 1000.0;
    const auto loop = study::design_gyro(c).loop;
    EXPECT_FALSE(std::isfinite(loop.relock_s));
    EXPECT_FALSE(loop.relock_note.empty());
    c.perimeter.tau_s = 0.0065;
    c.perimeter.limit_lambda = 0.005;
    // A limiter of 0.005 wavelength in 6.5 ms needs 0.21/0.005 * 6.5 ms to come down from 0.22.
    EXPECT_NEAR(study::design_gyro(c).loop.relock_s, 0.28, 0.01);
}

TEST(DesignGyro, adds_what_re_lock_leaves) {
    config::Config c;
    c.compensation.relock = core::RelockMethod::none;
    const auto uncorrected = study::design_gyro(c);
    EXPECT_GT(line(uncorrected, 0, 3).relock_arcsec, 44.0) << "the false angle itself, and its part in the fit";
    const auto corrected = study::design_gyro({});
    EXPECT_LT(line(corrected, 0, 3).relock_arcsec, 3.0);
    EXPECT_NEAR(line(corrected, 2, 3).total_arcsec,
                std::hypot(line(corrected, 2, 3).rms_arcsec, line(corrected, 2, 3).counter_arcsec,
                           line(corrected, 2, 3).relock_arcsec),
                1e-12);
}

TEST(DesignGyro, judges_the_perimeter_loop) {
    const auto r = study::design_gyro({});
    EXPECT_TRUE(r.loop.margins.stable);
    EXPECT_NEAR(r.loop.margins.phase_margin_deg, 82.0, 1.0) << "integrator of 6.5 ms and RC of 1 ms: 90 - atan(RC/tau)";
    ASSERT_GE(r.loop.false_drift_arcsec_s.size(), 4u);
    EXPECT_NEAR(r.loop.false_drift_arcsec_s[0], 4130.0, 0.03 * 4130);
    EXPECT_NEAR(r.loop.false_angle_arcsec, 44.1, 1.0);
}

TEST(OptimalInterval, takes_the_place_of_the_word_for_the_length_of_the_run) {
    config::Config c;
    c.switching.interval_optimal = true;
    c.run.duration_s = 600.0;
    const config::Config resolved = study::with_interval(c, 2.0);
    EXPECT_FALSE(resolved.switching.interval_optimal);
    const double end_arcsec_s = 0.7 + 0.7 * (1.0 - std::exp(-0.2));
    // Of S = Om(0) L/2 and a third of the square of K = Om(t) L/2, to first order.
    EXPECT_NEAR(resolved.switching.interval_s,
                std::cbrt(4.0 * 600.0 / (2.0 * (0.7 * 0.7 + end_arcsec_s * end_arcsec_s / 3.0) / 4.0)), 0.05);
    c.switching.first_segment = config::FirstSegment::half;
    EXPECT_NEAR(study::with_interval(c, 2.0).switching.interval_s,
                std::cbrt(4.0 * 600.0 / (end_arcsec_s * end_arcsec_s / 6.0)), 0.1);
    EXPECT_EQ(study::with_interval({}, 2.0).switching.interval_s, 90.0);
}

TEST(DesignGyro, takes_what_a_switch_leaves_from_a_trial_unless_it_is_given) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    const auto tried = study::design_gyro(c);
    EXPECT_FALSE(tried.switch_error_is_given);
    EXPECT_LT(tried.switch_error_arcsec, 3.0);
    EXPECT_LT(tried.runs.back().best.interval_s,
              0.5 * line(tried, 36000, IntervalMethod::corrected).optimum.interval_s);
    config::apply_set(c, "design.switch_error_arcsec=10");
    const auto given = study::design_gyro(c);
    EXPECT_TRUE(given.switch_error_is_given);
    EXPECT_EQ(given.switch_error_arcsec, 10.0);
    EXPECT_NEAR(given.runs.back().best.interval_s / tried.runs.back().best.interval_s,
                std::pow(10.0 / tried.switch_error_arcsec, 2.0 / 3.0), 0.05 * std::pow(10.0, 2.0 / 3.0));
}

TEST(DesignGyro, refuses_a_gyro_whose_switches_cost_nothing) {
    config::Config c;
    c.design.switch_error_arcsec = 0.0;
    EXPECT_THROW((void)study::design_gyro(c), design::DesignError);
}

TEST(DesignPage, has_a_section_for_each_question) {
    const config::Config c;
    const auto page = study::design_page(c, study::design_gyro(c));
    ASSERT_EQ(page.sections.size(), 4u);
    EXPECT_EQ(page.verdict.find("Switch every "), 0u) << page.verdict;
    EXPECT_EQ(page.sections[0].figures.at(0).series.size(), 5u) << "four runs and their optima";
}

}  // namespace zlg::design_study_test
