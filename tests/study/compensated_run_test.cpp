#include <zlg/study/compensated_run.hpp>
#include <zlg/study/run.hpp>

#include "test.hpp"

namespace zlg::compensated_run_test {

TEST(CompensatedRun, has_the_errors_of_the_configured_variant_of_a_run) {
    config::Config c;
    c.switching.interval_s = 2.0;
    c.run.duration_s = 15.0;
    const auto alone = study::compensated_run(c, 3000, 1);
    const study::RunResult whole = study::run({.config = c});
    const study::VariantResult& configured = whole.variants.back();
    EXPECT_EQ(alone.angle_error_arcsec(), configured.angle_error_arcsec);
    ASSERT_EQ(alone.switches().size(), configured.switches.size());
    for (std::size_t k = 0; k < alone.switches().size(); ++k)
        EXPECT_EQ(alone.switches()[k].error_arcsec, configured.switches[k].error_arcsec);
}

// Item of the definition: 14 arcsec/s over 20 ticks would be 1.4 arcsec, always of one sign.
TEST(CompensatedRun, a_large_magnetic_drift_is_no_error_of_the_switches) {
    const auto mean_of_modes = [](double magnetic_arcsec_s) {
        config::Config c;
        c.motion.kind = config::MotionKind::rest;
        c.drift.magnetic_arcsec_s = magnetic_arcsec_s;
        c.drift.magnetic_thermal_arcsec_s = 0.0;
        c.switching.interval_s = 1.0;
        double mean = 0.0;
        const auto run = study::compensated_run(c, 200 * 80, 1000);
        for (const auto& e : run.switches())
            mean += e.window.mode_after * e.error_arcsec / static_cast<double>(run.switches().size());
        return mean;
    };
    // 79 switches of 1.3 arcsec know their mean to 0.15.
    EXPECT_NEAR(mean_of_modes(14.0), mean_of_modes(0.0), 0.6);
}

// A line of points, at once or one by one.
TEST(CompensatedRun, a_leap_of_the_meter_is_so_many_ticks_on_a_line) {
    study::Drift lived, leapt;
    double error = 0.0;
    int tick = 0;
    const auto live = [&](study::Drift& drift, int n, double step) {
        for (int k = 1; k <= n; ++k) drift.add(0.005 * (tick + k), error + k * step);
    };
    for (const auto& [n, step] : std::vector<std::pair<int, double>>{{5, 0.3}, {1000, -0.01}, {1, 2.0}, {700, 0.02}}) {
        live(lived, n, step);
        leapt.add(n, 0.005, 0.005 * (tick + n), error, error + n * step);
        tick += n;
        error += n * step;
    }
    EXPECT_NEAR(leapt.slope_arcsec_s(), lived.slope_arcsec_s(), 1e-9);
}

// The same gyros by halves and by events: errors of switches, drift and angle at the end have the same scatter.
TEST(CompensatedRun, from_event_to_event_the_errors_have_the_same_law) {
    std::array<double, 2> switch_sq{}, end_sq{};
    std::array<double, 2> n_switches{};
    constexpr int n_gyros = 40;
    for (const std::size_t fidelity : {std::size_t{0}, std::size_t{1}}) {
        for (int gyro = 0; gyro < n_gyros; ++gyro) {
            config::Config c;
            c.run.seed = static_cast<std::uint64_t>(gyro + 1);
            c.gyro.fidelity = fidelity == 0 ? config::Fidelity::averaged : config::Fidelity::events;
            c.switching.interval_s = 10.0;
            c.compensation.relock = core::RelockMethod::mean_square;
            c.compensation.bridge = core::BridgeMethod::quadratic;
            c.drift.magnetic_arcsec_s = c.drift.magnetic_thermal_arcsec_s = 0.0;
            const auto run = study::compensated_run(c, 200 * 45, 1000);
            for (const auto& e : run.switches()) switch_sq[fidelity] += e.error_arcsec * e.error_arcsec;
            n_switches[fidelity] += static_cast<double>(run.switches().size());
            end_sq[fidelity] += std::pow(run.angle_error_without_nonmagnetic_arcsec(), 2);
        }
    }
    ASSERT_EQ(n_switches[0], n_switches[1]);
    const auto apart = [](const std::array<double, 2>& sq, double n) {
        return std::log(sq[1] / sq[0]) / (2.0 * std::sqrt(1.0 / n));
    };
    EXPECT_LT(std::abs(apart(switch_sq, n_switches[0])), 3.5);
    EXPECT_LT(std::abs(apart(end_sq, n_gyros)), 3.5);
}

TEST(CompensatedRun, of_events_has_a_fingerprint_of_its_own) {
    const auto fingerprint = [](config::Fidelity fidelity, double duration_s) {
        config::Config c;
        c.gyro.fidelity = fidelity;
        c.run.duration_s = duration_s;
        return study::run({.config = c, .variants = std::vector<std::string>{}}).fingerprint;
    };
    for (const double duration_s : {1.0, 30.0}) {
        EXPECT_NE(fingerprint(config::Fidelity::events, duration_s),
                  fingerprint(config::Fidelity::averaged, duration_s));
        EXPECT_EQ(fingerprint(config::Fidelity::events, duration_s), fingerprint(config::Fidelity::events, duration_s));
    }
}

}  // namespace zlg::compensated_run_test
