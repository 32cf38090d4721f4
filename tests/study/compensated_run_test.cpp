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

}  // namespace zlg::compensated_run_test
