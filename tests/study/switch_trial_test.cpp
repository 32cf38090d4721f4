
#include <zlg/config/schema.hpp>
#include <zlg/study/compensated_run.hpp>
#include <zlg/study/switch_trial.hpp>

#include "test.hpp"

namespace zlg::switch_trial_test {

config::Config at_rest() {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    return c;
}

// Other runs, with other seeds and a longer interval, whose errors are those of a run that switches seldom. One trial's
// figure is known to a sixth at rest, where a few switches have most of the error: four of each.
TEST(SwitchTrial, says_what_the_switches_of_a_run_leave) {
    for (const bool is_bridged_badly : {false, true}) {
        double of_trials = 0.0;
        double of_runs = 0.0;
        for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
            config::Config c = is_bridged_badly ? config::Config{} : at_rest();
            if (is_bridged_badly) c.compensation.bridge = core::BridgeMethod::constant;
            c.run.seed = seed;
            const study::SwitchTrial trial = study::try_switches(c);
            EXPECT_GE(trial.switches, 50);
            of_trials += trial.rms_arcsec * trial.rms_arcsec;
            c.run.seed = 76 + seed;
            c.drift.magnetic_arcsec_s = 0.0;
            c.drift.magnetic_thermal_arcsec_s = 0.0;
            c.switching.interval_s = 4.9;
            const auto run = study::compensated_run(c, 200 * 400, 1000);
            ASSERT_GE(run.switches().size(), 75u);
            const auto s = study::statistics(run.switches()).value();
            of_runs += s.rms_arcsec * s.rms_arcsec - s.mean_arcsec * s.mean_arcsec;
        }
        EXPECT_NEAR(std::sqrt(of_trials / of_runs), 1.0, 0.35) << is_bridged_badly;
    }
}

TEST(SwitchTrial, a_drift_or_a_fault_of_the_run_is_none_of_it) {
    config::Config c = at_rest();
    const double alone = study::try_switches(c).rms_arcsec;
    c.drift.magnetic_arcsec_s = 50.0;
    c.faults.kind = {twin::FaultKind::laser_off};
    c.faults.at_s = {3.0};
    c.faults.duration_s = {20.0};
    c.faults.size = {1.0};
    EXPECT_EQ(study::try_switches(c).rms_arcsec, alone);
}

// Of n differences that walk by sigma^2 each the mean square is known to sigma^2 sqrt(2/n); the error is far below.
TEST(SwitchTrial, claims_no_less_than_the_walk_lets_it_resolve) {
    config::Config c = at_rest();
    c.drift.random_walk_arcsec_sqrt_s = 10.0;
    int n_hidden = 0;
    for (c.run.seed = 1; c.run.seed <= 6; ++c.run.seed) {
        const study::SwitchTrial trial = study::try_switches(c);
        // Windows of the gap and the re-lock: 23 ticks.
        const double min_walk = 10.0 * 10.0 * 23.0 * c.gyro.tick_s;
        EXPECT_GE(trial.rms_arcsec, std::sqrt(min_walk * std::sqrt(2.0 / static_cast<double>(trial.switches))));
        if (trial.is_resolved) continue;
        ++n_hidden;
        EXPECT_NE(text(study::switch_cost(c).source).find("drift.random_walk_arcsec_sqrt_s"), std::string_view::npos);
    }
    EXPECT_GE(n_hidden, 1);
    EXPECT_TRUE(study::try_switches(at_rest()).is_resolved);
    EXPECT_EQ(text(study::switch_cost(at_rest()).source), "as tried on the twin");
}

TEST(SwitchTrial, what_is_given_is_obeyed) {
    config::Config c = at_rest();
    EXPECT_EQ(study::switch_error_arcsec(c), study::try_switches(c).rms_arcsec);
    config::apply_set(c, "design.switch_error_arcsec=10");
    EXPECT_EQ(study::switch_error_arcsec(c), 10.0);
}

TEST(SwitchTrial, no_switch_begins_before_the_last_is_over) {
    config::Config c = at_rest();
    EXPECT_NEAR(study::shortest_interval_s(c), (3 + 20 + 40) * 0.005, 1e-12);
    c.compensation.relock_ticks = 30;
    EXPECT_NEAR(study::shortest_interval_s(c), (3 + 30 + 40) * 0.005, 1e-12);
}

}  // namespace zlg::switch_trial_test
