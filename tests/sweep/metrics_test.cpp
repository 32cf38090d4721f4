// Claims about metrics: each name is a number of the summary, and costs what it asks for.

#include <zlg/sweep/metrics.hpp>

#include "test.hpp"

namespace zlg::sweep::metrics_test {

TEST(Metrics, every_name_gives_a_number_of_a_run) {
    study::RunTask task;
    task.config.run.duration_s = 12.0;
    task.config.switching.interval_s = 3.0;
    const study::RunResult result = study::run(task);
    EXPECT_GT(metric_names().size(), 60u);
    for (const std::string& name : metric_names()) EXPECT_TRUE(std::isfinite(metric_of(result, name))) << name;
    EXPECT_EQ(metric_of(result, "duration_s"), 12.0);
    EXPECT_EQ(metric_of(result, "switches"), 3.0);
    EXPECT_EQ(metric_of(result, "relock_mean_square.switch_error_rms_arcsec"),
              result.variant("relock_mean_square")->switch_error->rms_arcsec);
    EXPECT_EQ(metric_of(result, "relock_false_drift_deg_h.2"), result.relock_false_drift_deg_h[1]);
}

TEST(Metrics, of_a_run_that_lacks_it_is_not_a_number) {
    EXPECT_TRUE(std::isnan(metric_of({}, "configured.switch_error_rms_arcsec")));
    EXPECT_TRUE(std::isnan(metric_of({}, "no.such_number")));
}

TEST(Metrics, need_the_variant_that_they_name) {
    EXPECT_EQ(variant_of("one_mode.drift_arcsec_s"), "one_mode");
    EXPECT_EQ(variant_of("magnetic_estimate.drift_arcsec_s"), "magnetic_estimate");
    EXPECT_EQ(variant_of("configured.drift_arcsec_s"), std::nullopt);
    EXPECT_EQ(variant_of("switches_failed"), std::nullopt);
}

TEST(Metrics, have_units_and_neighbours) {
    EXPECT_EQ(unit_of("configured.drift_arcsec_s"), "arcsec/s");
    EXPECT_EQ(unit_of("configured.switch_error_rms_arcsec"), "arcsec");
    EXPECT_EQ(unit_of("relock_false_drift_deg_h.1"), "deg/h");
    EXPECT_EQ(unit_of("duration_s"), "s");
    EXPECT_EQ(unit_of("switches"), "1");
    EXPECT_FALSE(is_metric("configurd.drift_arcsec_s"));
    EXPECT_EQ(nearest_metric("configurd.drift_arcsec_s"), "configured.drift_arcsec_s");
}

}  // namespace zlg::sweep::metrics_test
