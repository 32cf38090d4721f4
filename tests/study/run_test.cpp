
#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/study/run.hpp>

#include "test.hpp"

namespace zlg::run_test {

config::Config short_run() {
    config::Config c;
    c.run.duration_s = 200.0;
    c.switching.interval_s = 5.0;
    return c;
}

study::RunResult run_of(const config::Config& c, int threads = 2) {
    study::RunTask task;
    task.config = c;
    task.threads = threads;
    return study::run(task);
}

const study::VariantResult& named(const study::RunResult& r, std::string_view name) {
    for (const auto& v : r.variants)
        if (v.name == name) return v;
    throw std::out_of_range{std::string{name}};
}

double rms(const study::RunResult& r, const std::string& name) {
    return named(r, name).switch_error.value().rms_arcsec;
}

TEST(Run, gives_the_variants_in_their_order) {
    std::vector<std::string> names;
    for (const auto& v : run_of(short_run()).variants) names.push_back(v.name);
    EXPECT_EQ(names, (std::vector<std::string>{"one_mode", "switching", "relock_frequency", "relock_detuning",
                                               "relock_mean_square", "bridge_constant", "bridge_linear",
                                               "bridge_quadratic", "configured"}));
}

TEST(Run, ranks_the_methods_as_the_paper_does) {
    const auto r = run_of(short_run());
    EXPECT_GT(rms(r, "switching"), rms(r, "relock_frequency"));
    EXPECT_GT(rms(r, "relock_frequency"), 1.5 * rms(r, "relock_detuning"));
    EXPECT_NEAR(rms(r, "relock_detuning"), rms(r, "relock_mean_square"), 0.5);
    EXPECT_GT(rms(r, "bridge_constant"), 1.5 * rms(r, "bridge_quadratic"));
    EXPECT_NEAR(rms(r, "bridge_constant"), rms(r, "bridge_linear"), 1e-9) << "equal in sum for symmetric points";
}

TEST(Run, false_drift_after_re_lock_is_that_of_table_1) {
    // Paper, Table 1: 4056, 2956, 1306, 207 deg/h.
    const auto drift = run_of(short_run()).relock_false_drift_deg_h;
    ASSERT_GE(drift.size(), 4u);
    EXPECT_NEAR(drift[0], 4056.0, 0.15 * 4056.0);
    EXPECT_NEAR(drift[1], 2956.0, 0.15 * 2956.0);
    EXPECT_NEAR(drift[2], 1306.0, 0.15 * 1306.0);
    EXPECT_NEAR(drift[3], 207.0, 75.0);
    EXPECT_NEAR(drift[0] + drift[1] + drift[2] + drift[3], 8525.0, 0.08 * 8525.0);
}

TEST(Run, switching_turns_the_magnetic_drift_into_a_sawtooth) {
    config::Config c = short_run();
    c.switching.interval_s = 20.0;
    c.drift.magnetic_thermal_arcsec_s = 0.0;
    c.drift.magnetic_arcsec_s = 5.0;
    c.drift.nonmagnetic_arcsec_s = 0.5;
    c.drift.random_walk_arcsec_sqrt_s = 0.0;
    c.motion.kind = config::MotionKind::rest;
    const auto r = run_of(c);
    EXPECT_NEAR(named(r, "one_mode").drift_arcsec_s, 5.5, 0.01);
    const auto& curve = named(r, "configured").curve;
    const auto error_at = [&](double t_s) {
        for (std::size_t k = 0; k < curve.t_s.size(); ++k)
            if (curve.t_s[k] >= t_s - 1e-9) return curve.error_arcsec[k];
        return std::nan("");
    };
    // Up by interval * magnetic drift, then down again; the non-magnetic drift stays. A switch may leave some arcsec.
    EXPECT_NEAR(error_at(20.0) - error_at(0.1), 20.0 * 5.5, 5.0);
    EXPECT_NEAR(error_at(40.0) - error_at(20.2), 20.0 * -4.5, 10.0);
    EXPECT_NEAR(named(r, "configured").angle_error_arcsec, 200.0 * 0.5, 60.0);
}

TEST(Run, figures_without_the_non_magnetic_drift_are_those_of_a_gyro_that_has_none) {
    config::Config c = short_run();
    c.drift.nonmagnetic_arcsec_s = 0.0;
    const auto without = run_of(c);
    c.drift.nonmagnetic_arcsec_s = 0.5;
    const auto with = run_of(c);
    const auto& theirs = named(without, "one_mode");
    const auto& ours = named(with, "one_mode");
    // The two gyros are rounded differently, to a count of 3.263 arcsec, in 200 s.
    EXPECT_NEAR(ours.drift_arcsec_s - theirs.drift_arcsec_s, 0.5, 0.005);
    EXPECT_NEAR(ours.drift_without_nonmagnetic_arcsec_s, theirs.drift_arcsec_s, 0.005);
    EXPECT_NEAR(ours.angle_error_without_nonmagnetic_arcsec, theirs.angle_error_arcsec, 3.27);
    EXPECT_EQ(theirs.drift_without_nonmagnetic_arcsec_s, theirs.drift_arcsec_s);
}

TEST(Run, the_magnetic_estimate_is_the_configured_compensation_where_that_estimates) {
    config::Config c = short_run();
    c.run.duration_s = 60.0;
    const auto asked_not = run_of(c);
    c.compensation.magnetic = core::MagneticMethod::estimate;
    const auto asked = run_of(c);
    EXPECT_EQ(asked.variants.size(), asked_not.variants.size());
    EXPECT_EQ(asked.magnetic_estimate.curve.error_arcsec, asked.variants.back().curve.error_arcsec);
    EXPECT_EQ(asked.magnetic_estimate.name, "magnetic_estimate");
    EXPECT_EQ(asked.variants.back().name, "configured");
    EXPECT_EQ(asked_not.magnetic_estimate.curve.error_arcsec, asked.magnetic_estimate.curve.error_arcsec);
}

TEST(Run, same_bits_on_one_thread_and_on_two) {
    const auto one = run_of(short_run(), 1);
    const auto two = run_of(short_run(), 2);
    for (std::size_t k = 0; k < one.variants.size(); ++k) {
        EXPECT_EQ(one.variants[k].drift_arcsec_s, two.variants[k].drift_arcsec_s);
        EXPECT_EQ(one.variants[k].curve.error_arcsec, two.variants[k].curve.error_arcsec);
    }
}

TEST(Run, its_sinks_get_every_half_and_every_tick_in_order) {
    study::RunTask task;
    task.config = short_run();
    task.config.run.duration_s = 12.0;
    std::int64_t halves = 0;
    std::int64_t ticks = 0;
    double true_arcsec = 0.0;
    double final_arcsec = 0.0;
    task.on_record = [&](const core::HalfRecord& r, const core::LightSamples& light) {
        EXPECT_EQ(r.half, halves++);
        EXPECT_EQ(light.a.size(), 16u);
        EXPECT_EQ(light.b.size(), 16u);
    };
    task.on_row = [&](const core::AngleRow& row, double truth) {
        EXPECT_EQ(row.tick, ticks++);
        final_arcsec += row.dtheta_final_arcsec;
        true_arcsec += truth;
    };
    const auto r = study::run(task);
    EXPECT_EQ(halves, 4800);
    EXPECT_EQ(ticks, 2400);
    EXPECT_NEAR(final_arcsec - true_arcsec, r.variants.back().angle_error_arcsec, 1e-6);
    ASSERT_EQ(r.switches.size(), 2u);
    EXPECT_EQ(r.switches[0].tick, 1000);
    EXPECT_EQ(r.switches[0].gap_ticks, 3);
    EXPECT_EQ(r.switches[0].mode, -1);
    EXPECT_NEAR(std::abs(r.switches[0].miss_lambda), 0.21, 0.01) << "mean of the first closed half";
    EXPECT_NEAR(r.switches[0].half_wave_v, 40.0, 1.0);
    EXPECT_GT(r.switches[0].sigma_arcsec, 0.0);
}

TEST(Run, a_sink_that_fails_ends_the_run) {
    study::RunTask task;
    task.config = short_run();
    task.threads = 2;
    task.on_record = [](const core::HalfRecord& r, const core::LightSamples&) {
        if (r.half == 100) throw logs::IoError{"disk full"};
    };
    EXPECT_THROW((void)study::run(task), logs::IoError);
}

}  // namespace zlg::run_test
