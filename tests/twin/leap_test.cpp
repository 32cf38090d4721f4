#include <zlg/chance/address.hpp>
#include <zlg/twin/leap.hpp>
#include <zlg/twin/twin.hpp>

#include "quiet_gyro.hpp"

namespace zlg::twin::leap_test {

struct Ends {
    std::int64_t counts = 0;
    double phase_counts = 0.0;
    double dtheta_arcsec = 0.0;
    TwinHalf next;
};

// Phase from the end of the first halves on, and the half after it.
Ends lived(const TwinConfig& config, const Motion& motion, int first, int n) {
    Twin twin{config, motion};
    const TwinHalf before = advance(twin, frame(true, 1), first).back();
    Ends ends;
    TwinHalf half;
    for (int h = 0; h < n; ++h) {
        half = twin.advance(frame(true, 1));
        ends.dtheta_arcsec += half.truth.dtheta_arcsec;
    }
    ends.counts = static_cast<std::int64_t>(half.sensor.counter - before.sensor.counter);
    ends.phase_counts = static_cast<double>(ends.counts) -
                        (half.truth.rounding_arcsec - before.truth.rounding_arcsec) / config.gyro.scale_arcsec;
    ends.next = twin.advance(frame(true, 1));
    return ends;
}

Ends leapt(const TwinConfig& config, const Motion& motion, int first, int n, const LeapWay& way = {}) {
    Twin twin{config, motion};
    advance(twin, frame(true, 1), first);
    const Leap leap = twin.leap(n, way);
    Ends ends{
        .counts = leap.counts, .phase_counts = leap.turned_counts, .dtheta_arcsec = leap.dtheta_arcsec, .next = {}};
    ends.next = twin.advance(frame(true, 1));
    return ends;
}

TwinConfig warming_gyro() {
    TwinConfig config;
    config.drift.random_walk_arcsec_sqrt_s = 0.0;
    config.drift.thermal_time_s = 20.0;
    config.perimeter.expansion_lambda_per_c = 1e-3;
    config.gyro.bias_temperature_coefficient_per_c = 1e-4;
    config.piezo.half_wave_temperature_coefficient_per_c = 1e-4;
    return config;
}

Motion turning() { return Motion::sines(37.3, {{1000.0, 0.7, 20.0}, {300.0, 3.1, 0.0}}); }

// What is left is the bend of the bias's growth, which its pairs of halves do not take off exactly.
TEST(Leap, without_a_walk_ends_where_the_halves_end) {
    for (const bool singly : {false, true}) {
        const TwinConfig config = warming_gyro();
        const Ends a = lived(config, turning(), 100, 4000);
        const Ends b = leapt(config, turning(), 100, 4000, {.singly = singly});
        EXPECT_NEAR(b.dtheta_arcsec, a.dtheta_arcsec, 1e-9);
        EXPECT_NEAR(b.phase_counts, a.phase_counts, 3e-4);
        EXPECT_LE(std::abs(b.counts - a.counts), 1);
        EXPECT_EQ(b.next.sensor.sequence, a.next.sensor.sequence);
        EXPECT_EQ(b.next.sensor.timer_ticks, a.next.sensor.timer_ticks);
        EXPECT_EQ(b.next.sensor.bias_sign, a.next.sensor.bias_sign);
        EXPECT_NEAR(b.next.sensor.temperature_c, a.next.sensor.temperature_c, 1e-12);
        EXPECT_NEAR(b.next.truth.perimeter_v, a.next.truth.perimeter_v, 2e-3);
        EXPECT_EQ(b.next.sensor.light_a[0] > 0.0F, a.next.sensor.light_a[0] > 0.0F);
    }
}

TEST(Leap, of_a_field_that_stays_ends_where_the_halves_end_and_stops_at_its_step) {
    TwinConfig config = warming_gyro();
    config.field.sensitivity_per_c = 0.02;
    config.field.kind = FieldKind::constant;
    EXPECT_NEAR(leapt(config, Motion::rest(), 100, 4000).phase_counts,
                lived(config, Motion::rest(), 100, 4000).phase_counts, 3e-4);
    config.field.kind = FieldKind::steps;
    config.field.course.points = {{0.0, 0.3}, {0.25, -0.6}, {10.0, 0.9}};
    EXPECT_NEAR(leapt(config, Motion::rest(), 100, 3900).phase_counts,
                lived(config, Motion::rest(), 100, 3900).phase_counts, 3e-4);
    Twin twin{config, Motion::rest()};
    EXPECT_EQ(twin.even_halves(), 100);
    advance(twin, frame(true, 1), 100);
    EXPECT_EQ(twin.even_halves(), 3900);
    advance(twin, frame(true, 1), 3900);
    EXPECT_GT(twin.even_halves(), 1'000'000'000);
}

TEST(Leap, tells_the_voltage_that_it_will_end_at) {
    const TwinConfig config = warming_gyro();
    Twin twin{config, Motion::rest()};
    advance(twin, frame(true, 1), 100);
    const double foretold = twin.voltage_after(4000);
    twin.leap(4000);
    EXPECT_NEAR(twin.advance(frame(true, 1)).truth.perimeter_v, foretold, 2e-3);
}

TEST(Leap, tells_what_light_and_bias_have_become) {
    TwinConfig config = warming_gyro();
    config.light.power_decay_per_h = 10.0;
    config.light.gain_drift_per_h = 5.0;
    config.light.gain_b = 1.3;
    config.light.offset_a = 0.01;
    Twin twin{config, Motion::rest()};
    const Leap leap = twin.leap(36'000);  // 90 s
    const double power = std::exp(-10.0 * 90.0 / 3600.0), gain = 1.0 + 5.0 * 90.0 / 3600.0;
    EXPECT_NEAR(leap.light_before[0], 1010.0, 1e-9);
    EXPECT_NEAR(leap.light_before[1], 1300.0, 1e-9);
    EXPECT_NEAR(leap.light_after[0], 1000.0 * power + 10.0, 1e-9);
    EXPECT_NEAR(leap.light_after[1], 1300.0 * power * gain, 1e-9);
    EXPECT_NEAR(leap.bias_ratio, 1.0 + 1e-4 * 20.0 * (1.0 - std::exp(-90.0 / 20.0)), 1e-6);
    EXPECT_NEAR(leap.temperature_c, 20.0 + 20.0 * (1.0 - std::exp(-90.0 / 20.0)), 1e-9);
}

// Of 2000 gyros, four of the standard errors of a variance.
TEST(Leap, walks_as_its_halves_do) {
    constexpr int n_gyros = 2000, n_halves = 400;
    for (const bool singly : {false, true}) {
        double sum_sq = 0.0;
        for (int gyro = 0; gyro < n_gyros; ++gyro) {
            TwinConfig config = quiet_gyro();
            config.seed = static_cast<std::uint64_t>(gyro + 1);
            config.drift.random_walk_arcsec_sqrt_s = 3.263;
            Twin twin{config, Motion::rest()};
            sum_sq += std::pow(twin.leap(n_halves, {.singly = singly}).turned_counts, 2);
        }
        EXPECT_NEAR(sum_sq / n_gyros, 1.0, 4.0 * std::sqrt(2.0 / n_gyros)) << singly;
    }
}

TEST(Leap, noise_of_a_digital_loop_is_that_of_its_halves_summed) {
    constexpr int n_gyros = 2000, n_halves = 600;
    constexpr DetuningNoise noise{.sigma_lambda = 0.05, .kept = 0.6};
    double by_halves = 0.0, by_law = 0.0;
    for (int gyro = 0; gyro < n_gyros; ++gyro) {
        TwinConfig config = quiet_gyro();
        config.seed = static_cast<std::uint64_t>(gyro + 1);
        Twin twin{config, Motion::rest()};
        by_law += std::pow(twin.leap(n_halves, {.noise = noise}).turned_counts, 2) / n_gyros;
        std::vector<double> deviates(n_halves + 1);
        chance::normals({.seed = config.seed, .cause = chance::Cause::test}, deviates);
        double x = noise.sigma_lambda * deviates.back(), sum = 0.0;
        for (int h = 0; h < n_halves; ++h) {
            sum += (h % 2 == 0 ? 1.0 : -1.0) * x * x;
            x = noise.kept * x +
                noise.sigma_lambda * std::sqrt(1.0 - noise.kept * noise.kept) * deviates[static_cast<std::size_t>(h)];
        }
        by_halves += std::pow(sum * 150.0 * config.gyro.bias_chi, 2) / n_gyros;
    }
    EXPECT_NEAR(by_law / by_halves, 1.0, 4.0 * std::sqrt(4.0 / n_gyros));
}

TEST(Leap, singly_tells_every_half) {
    TwinConfig config = quiet_gyro();
    Twin twin{config, turning()};
    advance(twin, frame(true, 1), 10);
    const Leap leap = twin.leap(1000, {.singly = true});
    ASSERT_EQ(leap.half.size(), 1000u);
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < leap.half.size(); ++k) {
        sum += leap.half[k].counts;
        EXPECT_EQ(leap.half[k].bias_sign, k % 2 == 0 ? 1 : -1);
        EXPECT_NEAR(static_cast<double>(leap.half[k].counts), leap.half[k].bias_sign * 150.0, 4.0);
    }
    EXPECT_EQ(sum, leap.counts);
}

TEST(Leap, no_half_of_a_piezo_with_a_memory_or_before_a_fault_is_quiet) {
    TwinConfig config = quiet_gyro();
    EXPECT_GT((Twin{config, Motion::rest()}.quiet_halves()), 1'000'000'000);
    config.faults = {{FaultKind::laser_off, 1.0, 0.5, 0.0}};
    Twin faulty{config, Motion::rest()};
    EXPECT_EQ(faulty.quiet_halves(), 400);
    advance(faulty, frame(true, 1), 450);
    EXPECT_EQ(faulty.quiet_halves(), 0);
    const auto why = [](auto change) {
        TwinConfig changed = quiet_gyro();
        change(changed);
        EXPECT_EQ((Twin{changed, Motion::rest()}.quiet_halves()), 0);
        return why_no_leap(changed);
    };
    EXPECT_EQ(why([](TwinConfig& c) { c.piezo.creep_per_decade = 0.01; }), "piezo.creep_per_decade = 0.01");
    EXPECT_EQ(why([](TwinConfig& c) { c.temperature.sensor_lag_s = 5.0; }), "temperature.sensor_lag_s = 5");
    EXPECT_EQ(why([](TwinConfig& c) { c.temperature.profile.points = {{0.0, 20.0}}; }), "temperature.profile");
    EXPECT_EQ(why([](TwinConfig& c) { c.field.kind = FieldKind::sine; }), "field.kind = \"sine\"");
    EXPECT_EQ(why_no_leap(quiet_gyro()), "");
}

}  // namespace zlg::twin::leap_test
