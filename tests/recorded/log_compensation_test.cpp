#include <zlg/recorded/log_compensation.hpp>

#include <zlg/logs/error.hpp>
#include <zlg/rig/asked_compensation.hpp>

#include "test.hpp"

namespace zlg::log_compensation_test {

using core::RelockMethod;

logs::RawHeader log_with_all() {
    logs::RawHeader log;
    static_cast<logs::RawColumns&>(log) = logs::all_raw_columns;
    log.light_samples = 16;
    return log;
}

config::Config of(RelockMethod method) {
    config::Config c;
    c.compensation.relock = method;
    return c;
}

// Signal = 2 sin(detuning): read with a slope of 1, a detuning of 0.1 looks like 2 sin 0.1.
config::Config with_curve(double size = 2.0) {
    config::Config c;
    c.gyro.discriminator_per_lambda = 1.0;
    for (const double detuning : {0.1, 0.2, 0.3}) {
        c.perimeter.discriminator_detuning_lambda.push_back(detuning);
        c.perimeter.discriminator_signal.push_back(size * std::sin(detuning));
    }
    return c;
}

double detuning_of(const core::DiscriminatorCurve& curve, double apparent_lambda) {
    return core::true_detuning(curve, apparent_lambda).detuning_lambda;
}

config::Settings settings_of(const config::Config& c) { return config::to_settings(c); }

std::string refusal(const config::Config& c, const logs::RawHeader& log) {
    return test::refusal_by<config::ConfigError>([&] { (void)recorded::log_compensation(c, log, "the log"); });
}

TEST(LogCompensation, of_a_log_is_by_the_columns_that_it_has) {
    logs::RawHeader log = log_with_all();
    EXPECT_EQ(recorded::log_compensation({}, log, "log").compensation.relock.method, RelockMethod::mean_square);
    log.has_detuning_sq = false;
    const recorded::LogCompensation made = recorded::log_compensation({}, log, "log");
    EXPECT_EQ(made.compensation.relock.method, RelockMethod::none);
    EXPECT_EQ(made.config.compensation.relock, RelockMethod::none);
    EXPECT_TRUE(made.notes.empty() && made.warnings.empty());
}

TEST(LogCompensation, a_method_without_its_column_is_refused) {
    logs::RawHeader log = log_with_all();
    for (const auto method : {RelockMethod::none, RelockMethod::frequency, RelockMethod::detuning,
                              RelockMethod::mean_square, RelockMethod::joint})
        EXPECT_EQ(recorded::log_compensation(of(method), log, "log").compensation.relock.method, method);
    log.has_detuning_sq = false;
    EXPECT_EQ(refusal(of(RelockMethod::mean_square), log),
              "compensation.relock = \"mean_square\" needs the column detuning_sq_lambda2, which the log lacks; "
              "allowed without it: \"none\", \"frequency\"");
    zlg::test::expect_contains(refusal(of(RelockMethod::joint), log), "\"joint\" needs the column detuning_sq_lambda2");
    EXPECT_EQ(refusal(of(RelockMethod::detuning), log), "");
    log.has_detuning = false;
    zlg::test::expect_contains(refusal(of(RelockMethod::detuning), log),
                               "\"detuning\" needs the column detuning_lambda");
    EXPECT_EQ(refusal(of(RelockMethod::none), log), "");
    EXPECT_EQ(refusal(of(RelockMethod::frequency), log), "");
}

TEST(LogCompensation, joint_without_light_is_done_another_way_with_a_note) {
    logs::RawHeader log = log_with_all();
    EXPECT_TRUE(recorded::log_compensation(of(RelockMethod::joint), log, "log").notes.empty());
    log.light_samples = 0;
    const auto notes = recorded::log_compensation(of(RelockMethod::joint), log, "log").notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0].find("log: holds no light samples"), 0u);
}

TEST(LogCompensation, says_which_constants_nobody_gave) {
    config::Config given = of(RelockMethod::mean_square);
    const auto said = [&] { return recorded::log_compensation(given, log_with_all(), "log").presumed; };
    EXPECT_EQ(said().find("log: presumed, given by neither log nor configuration: gyro.bias_hz = 60000, gyro.bias_chi"),
              0u);
    EXPECT_EQ(said().find("discriminator"), std::string::npos);
    for (const char* set : {"gyro.bias_chi=3.6", "gyro.bias_hz=6e4", "gyro.light_noise_lambda=0.0033",
                            "gyro.bias_temperature_coefficient_per_c=0", "drift.random_walk_arcsec_sqrt_s=0.14"})
        config::apply_set(given, set);
    EXPECT_EQ(said(), "");
    given = of(RelockMethod::none);
    EXPECT_EQ(said().find("chi"), std::string::npos);
}

TEST(LogCompensation, detunings_read_by_a_slope_come_through_the_curve_here) {
    const recorded::LogCompensation made = recorded::log_compensation(with_curve(), log_with_all(), "log");
    EXPECT_NEAR(detuning_of(made.compensation.gyro.record_curve, 2.0 * std::sin(0.2)), 0.2, 1e-12);
    EXPECT_EQ(made.compensation.gyro.control_curve.n_nodes, 0);
    EXPECT_TRUE(made.warnings.empty());
}

TEST(LogCompensation, the_slope_is_that_of_the_log) {
    logs::RawHeader log = log_with_all();
    log.settings = {{"gyro.discriminator_per_lambda", "4.0"}};
    const recorded::LogCompensation made = recorded::log_compensation(with_curve(), log, "log");
    EXPECT_NEAR(detuning_of(made.compensation.gyro.record_curve, 0.5 * std::sin(0.2)), 0.2, 1e-12);
}

TEST(LogCompensation, detunings_that_have_come_through_a_curve_do_not_come_through_another) {
    logs::RawHeader log = log_with_all();
    log.settings = settings_of(with_curve());
    recorded::LogCompensation made = recorded::log_compensation(with_curve(), log, "log");
    EXPECT_EQ(made.compensation.gyro.record_curve.n_nodes, 0);
    EXPECT_NEAR(detuning_of(made.compensation.gyro.control_curve, 2.0 * std::sin(0.2)), 0.2, 1e-12);
    EXPECT_TRUE(made.warnings.empty());

    made = recorded::log_compensation(with_curve(3.0), log, "log");
    EXPECT_NEAR(detuning_of(made.compensation.gyro.control_curve, 2.0 * std::sin(0.2)), 0.2, 1e-12);
    ASSERT_EQ(made.warnings.size(), 1u);
    EXPECT_EQ(made.warnings[0].find("log: its detunings were read through a discriminator curve of its own"), 0u);
    // To ask for none is not to ask for another.
    EXPECT_TRUE(recorded::log_compensation({}, log, "log").warnings.empty());
}

TEST(LogCompensation, shifted_edges_need_a_timer_and_leave_a_plateau) {
    logs::RawHeader log = log_with_all();
    config::Config c;
    c.gyro.bias_edge_s = 0.5 * c.gyro.tick_s;
    log.timer_hz = 0.0;
    EXPECT_EQ(refusal({}, log), "") << "no edge is shifted";
    log.has_edge_offset = true;
    log.timer_hz = 2e6;
    EXPECT_EQ(recorded::log_compensation({}, log, "log").compensation.gyro.timer.value(), 2e6);
    EXPECT_EQ(refusal(c, log),
              "gyro.bias_edge_s = 0.0025: allowed is below half of gyro.tick_s = 0.005, where edges are shifted");
    for (const double bad : {0.0, 0.5, 2e15, std::numeric_limits<double>::quiet_NaN()}) {
        log.timer_hz = bad;
        EXPECT_NE(refusal({}, log).find("allowed is 1..1e15"), std::string::npos) << bad;
    }
}

TEST(LogCompensation, as_recorded_knows_no_curve_but_the_one_of_the_log) {
    EXPECT_TRUE(recorded::as_recorded(with_curve(), {}, "log").perimeter.discriminator_signal.empty());
    EXPECT_EQ(recorded::as_recorded(with_curve(), {}, "log").gyro.discriminator_per_lambda, 1.0);
    const config::Config read = recorded::as_recorded({}, settings_of(with_curve(3.0)), "log");
    EXPECT_EQ(read.perimeter.discriminator_signal, with_curve(3.0).perimeter.discriminator_signal);
    EXPECT_EQ(read.gyro.discriminator_per_lambda, 1.0);
}

TEST(LogCompensation, a_log_without_a_whole_tick_is_refused) {
    rig::Replay replay{rig::asked_compensation({})};
    EXPECT_THROW(recorded::require_a_tick(replay, "log"), logs::FormatError);
    replay.take({.half = 0, .bias_sign = 1});
    EXPECT_THROW(recorded::require_a_tick(replay, "log"), logs::FormatError);
    replay.take({.half = 1, .bias_sign = -1});
    EXPECT_NO_THROW(recorded::require_a_tick(replay, "log"));
}

}  // namespace zlg::log_compensation_test
