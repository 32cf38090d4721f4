
#include <zlg/study/what_happened.hpp>

#include "test.hpp"

namespace zlg::what_happened_test {

config::Config short_gyro(double duration_s, double interval_s) {
    config::Config config;
    config.run.duration_s = duration_s;
    config.switching.interval_s = interval_s;
    return config;
}

std::string said(const config::Config& config) {
    std::string all;
    for (const std::string& sentence : study::what_happened(config, study::run({.config = config, .threads = 2})))
        all += sentence + "\n";
    return all;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(WhatHappened, no_switch_was_due) {
    const std::string text = said(short_gyro(4.0, 5.0));
    EXPECT_TRUE(holds(text, "4 s, no switch: the run is shorter than switching.interval_s = 5")) << text;
    EXPECT_FALSE(holds(text, "fault")) << text;
}

TEST(WhatHappened, few_switches_are_called_few_and_many_are_not) {
    EXPECT_EQ(said(short_gyro(12.0, 5.0)),
              "12 s, 2 switches: too few for more than a first impression of their errors\n");
    EXPECT_EQ(said(short_gyro(56.0, 5.0)), "56 s, 11 switches\n");
}

TEST(WhatHappened, a_fault_and_what_the_core_made_of_it) {
    config::Config config = short_gyro(10.0, 90.0);
    config.faults.kind = {twin::FaultKind::laser_off};
    config.faults.at_s = {3.0};
    config.faults.duration_s = {0.3};
    config.faults.size = {0.0};
    const std::string text = said(config);
    EXPECT_TRUE(holds(text, "faults: laser_off at 3 s for 0.3 s; the core raised light_lost")) << text;
    // 0.3 s without light are 60 ticks of 5 ms.
    EXPECT_TRUE(holds(text, "60 of 2000 ticks outside the switches are invalid")) << text;
}

TEST(WhatHappened, a_fault_that_the_core_cannot_see_is_named_all_the_same) {
    config::Config config = short_gyro(4.0, 90.0);
    config.faults.kind = {twin::FaultKind::field_pulse};
    config.faults.at_s = {2.0};
    config.faults.duration_s = {1.0};
    config.faults.size = {0.3};
    const std::string text = said(config);
    EXPECT_TRUE(holds(text, "field_pulse at 2 s for 1 s; the core raised no health bit of trouble; no tick")) << text;
}

TEST(WhatHappened, switches_that_failed_are_told) {
    config::Config config = short_gyro(12.0, 5.0);
    config.perimeter.miss_lambda = 0.0;
    config.piezo.half_wave_error = -0.5;  // half a wavelength takes twice the voltage that the processor presumes
    EXPECT_TRUE(holds(said(config), "no switch of modes succeeded")) << said(config);
}

// Slope of a random walk by its definition: the weights of the least squares, applied to the increments.
TEST(RandomWalkShare, is_what_the_least_squares_make_of_a_walk) {
    config::Config config;
    config.drift.random_walk_arcsec_sqrt_s = 0.14;
    const study::RunResult result{.tick_s = 1.0, .ticks = 3600};
    const int n = 3600;
    const double mean_t = (n + 1) / 2.0;
    double tt = 0.0;
    for (int t = 1; t <= n; ++t) tt += (t - mean_t) * (t - mean_t);
    double variance = 0.0;
    double tail = 0.0;  // of the weights from t to the end: what an increment at t adds to the slope
    for (int t = n; t >= 1; --t) {
        tail += (t - mean_t) / tt;
        variance += tail * tail * 0.14 * 0.14;
    }
    const study::RandomWalkShare share = study::random_walk_share(config, result);
    EXPECT_NEAR(share.drift_arcsec_s, std::sqrt(variance), 1e-3 * share.drift_arcsec_s);
    EXPECT_NEAR(share.angle_arcsec, 0.14 * 60.0, 1e-12);
    config.gyro.fidelity = config::Fidelity::laser;
    EXPECT_EQ(study::random_walk_share(config, result).drift_arcsec_s, 0.0);
}

}  // namespace zlg::what_happened_test
