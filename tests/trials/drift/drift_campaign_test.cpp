#include <zlg/trials/drift_campaign.hpp>

#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::trials::drift_campaign_test {

// A strong drift that does not warm up, on a base at rest, and switches that leave little.
config::Config gyro() {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.gyro.scale_arcsec = 0.05;
    c.gyro.bias_hz = 60e3 * 3.263 / 0.05;
    c.gyro.counter_max_hz = 1e9;
    c.gyro.tick_s = 0.05;
    c.drift = {.magnetic_arcsec_s = 10.0, .magnetic_thermal_arcsec_s = 0.0, .random_walk_arcsec_sqrt_s = 0.14};
    c.perimeter.miss_lambda = 1e-4;
    c.perimeter.tau_s = 0.2;
    c.switching.interval_s = 40.0;
    return c;
}

DriftMethod method(core::MagneticMethod magnetic) {
    DriftMethod m{.name = magnetic == core::MagneticMethod::none ? "alone" : "magnetic", .compensation = {}};
    m.compensation.bridge = core::BridgeMethod::constant;
    m.compensation.magnetic = magnetic;
    m.compensation.magnetic_sigma_arcsec_s = 10.0;
    return m;
}

DriftCampaign campaign(std::vector<DriftGyro> gyros) {
    return {.gyros = std::move(gyros), .times_s = {500.0, 1000.0}, .seeds = 3};
}

TEST(DriftCampaign, FindsTheSawtoothOfPlainSwitching) {
    // 1000 s are 25 intervals, so that one segment is left over: 10 arcsec/s for 40 s.
    const auto figures = run(campaign({{"plain", gyro(), {method(core::MagneticMethod::none)}}}));
    ASSERT_EQ(figures.size(), 1u);
    ASSERT_EQ(figures[0].at.size(), 2u);
    EXPECT_EQ(figures[0].switches, 24.0);
    EXPECT_NEAR(figures[0].at[1].mean_arcsec_s, 10.0 * 40.0 / 1000.0, 0.02);
    EXPECT_NEAR(figures[0].at[1].rms_arcsec_s, 0.4, 0.02);
    EXPECT_GE(figures[0].at[1].max_arcsec_s, figures[0].at[1].rms_arcsec_s);
    EXPECT_EQ(figures[0].at[1].max_arcsec_s, figures[0].at[1].percentile_95_arcsec_s);
    // The last 50 s: all between 0 and 400 arcsec.
    EXPECT_LT(figures[0].at[1].rms_before_arcsec_s, 0.4);
    EXPECT_GT(figures[0].at[1].rms_before_arcsec_s, 0.1);
}

TEST(DriftCampaign, TheMagneticEstimateTakesItAwayAtAnyTime) {
    const auto figures =
        run(campaign({{"both", gyro(), {method(core::MagneticMethod::none), method(core::MagneticMethod::estimate)}}}));
    ASSERT_EQ(figures.size(), 2u);
    EXPECT_LT(figures[1].at[1].rms_before_arcsec_s, 0.1 * figures[0].at[1].rms_before_arcsec_s);
    EXPECT_LT(figures[1].at[1].rms_arcsec_s, 0.02);
}

TEST(DriftCampaign, AMeasuredScheduleMakesUseOfIt) {
    config::Config c = gyro();
    c.switching.schedule = config::Schedule::measured;
    c.switching.first_segment = config::FirstSegment::half;
    c.switching.interval_max_s = 400.0;
    const auto figures = run(campaign({{"measured", c, {method(core::MagneticMethod::none)}},
                                       {"measured", c, {method(core::MagneticMethod::estimate)}}}));
    // Where the drift is taken out there is less need to switch.
    EXPECT_LT(figures[1].switches, 0.7 * figures[0].switches);
    EXPECT_LT(figures[1].at[1].rms_before_arcsec_s, figures[0].at[1].rms_before_arcsec_s);
}

TEST(DriftCampaign, KnowsTheWalkOfTheGyro) {
    config::Config c = gyro();
    c.drift.magnetic_arcsec_s = 0.0;
    c.drift.random_walk_arcsec_sqrt_s = 5.0;
    const DriftAtTime with = run(campaign({{"walks", c, {method(core::MagneticMethod::none)}}}))[0].at[1];
    // Three gyros after 1000 s: 5/sqrt(1000) = 0.16 arcsec/s. Without the walk the gaps remain, 3 ticks in 800, in
    // which it is interpolated: sqrt(3/800) of it and less.
    EXPECT_GT(with.rms_arcsec_s, 0.04);
    EXPECT_LT(with.rms_less_walk_arcsec_s, 0.2 * with.rms_arcsec_s);
    EXPECT_GT(with.rms_less_walk_arcsec_s, 0.0);
}

// Of the paper's gyro by phase, over 20.06 Hz; docs/drift.md has the figures of 36 000 s.
TEST(DriftCampaign, ByPhaseASwitchHasNoErrorWithTheSignOfTheFalseAngle) {
    config::Config c;
    c.gyro.readout = config::Readout::phase;
    c.motion.frequency_hz = {20.06};
    c.drift.magnetic_arcsec_s = 7.0;  // ten times the paper's: what a step between the modes does is ten times as large
    c.drift.magnetic_thermal_arcsec_s = 0.0;
    c.switching.interval_s = 4.3;
    c.switching.first_segment = config::FirstSegment::half;
    DriftMethod alone{.name = "alone", .compensation = {.relock = core::RelockMethod::joint}};
    alone.compensation.magnetic_sigma_arcsec_s = 10.0;
    DriftMethod magnetic = alone;
    magnetic.compensation.magnetic = core::MagneticMethod::estimate;
    const auto figures = run({.gyros = {{"phase", c, {alone, magnetic}}}, .times_s = {1300.0}, .seeds = 2});
    for (const DriftFigures& f : figures) {
        SCOPED_TRACE(f.method);
        // 600 switches: a standard error of 0.005.
        EXPECT_LT(std::abs(f.switch_mean_arcsec), 0.02);
        // Of eight seeds 0.11 before 0.2 changed the random numbers and 0.12 since; of one seed 0.06 to 0.17.
        EXPECT_LT(f.switch_rms_arcsec, 0.2);
    }
}

// None worse than without by more than a tenth and 3 arcsec.
TEST(DriftCampaign, APureToneIsNoMagneticDrift) {
    constexpr double time_s = 300.0;
    const auto figures = run({.gyros = over_tones(12, 1), .times_s = {time_s}, .seeds = 1});
    for (std::size_t k = 0; k < figures.size(); k += 2)
        EXPECT_LE(figures[k + 1].at[0].rms_before_arcsec_s, 1.1 * figures[k].at[0].rms_before_arcsec_s + 3.0 / time_s)
            << figures[k].gyro;
}

TEST(DriftCampaign, DoesNotDependOnTheNumberOfThreads) {
    DriftCampaign c = campaign({{"a", gyro(), {method(core::MagneticMethod::estimate)}}});
    c.times_s = {100.0};
    const std::string one = markdown(run(c));
    c.threads = 3;
    EXPECT_EQ(markdown(run(c)), one);
    c.seed = 2;
    EXPECT_NE(markdown(run(c)), one);
}

TEST(DriftCampaign, AGyroThatIsNoneIsSaid) {
    config::Config c = gyro();
    c.switching.interval_s = 1e-9;
    c.piezo.range_max_v = c.piezo.range_min_v;
    EXPECT_THROW((void)run(campaign({{"none", c, {method(core::MagneticMethod::none)}}})), config::ConfigError);
}

}  // namespace zlg::trials::drift_campaign_test
