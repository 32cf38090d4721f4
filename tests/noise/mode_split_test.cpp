#include <zlg/deviations/series.hpp>
#include <zlg/noise/mode_split.hpp>

#include "test.hpp"

namespace zlg::noise::mode_split_test {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// 100 Hz; a switch every 20 s takes 5 samples.
struct Gyro {
    std::vector<double> rates, bridged;
    std::vector<std::int8_t> mode;

    template <class Rate> Gyro(int n_segments, Rate rate) {
        for (int k = 0; k < 2000 * n_segments; ++k) {
            const int segment = k / 2000;
            mode.push_back(segment % 2 == 0 ? 1 : -1);
            const double r = rate((k + 0.5) / 100.0, mode.back());
            const bool gap = segment > 0 && k % 2000 < 5;
            rates.push_back(gap ? missing : r);
            bridged.push_back(r);
        }
    }
    [[nodiscard]] ModeRecord record() const {
        return {.rate_hz = 100.0, .rates_arcsec_s = rates, .bridged_arcsec_s = bridged, .mode = mode};
    }
};

TEST(ModeSplit, constant_parts_are_found_exactly) {
    const Gyro gyro(10, [](double, int mode) { return 3.0 + mode * 0.7; });
    const ModeSplit split = split_modes(gyro.record(), 20);
    ASSERT_EQ(split.segments.size(), 10u);
    EXPECT_NEAR(split.segments[1].known_s, 19.95, 1e-9);
    EXPECT_NEAR(split.segments[1].time_s, 30.025, 1e-9);
    ASSERT_EQ(split.points.size(), 8u);
    for (const ModePoint& p : split.points) {
        EXPECT_NEAR(p.magnetic_arcsec_s, 0.7, 1e-12);
        EXPECT_NEAR(p.nonmagnetic_arcsec_s, 3.0, 1e-12);
    }
    EXPECT_NEAR(split.nonmagnetic_arcsec_s.value, 3.0, 1e-9);
    EXPECT_NEAR(split.magnetic_arcsec_s.value, 0.7, 1e-9);
    EXPECT_EQ(split.statistics.n, 9);
    EXPECT_NEAR(split.statistics.max_arcsec, 0.0, 1e-9);
}

TEST(ModeSplit, steady_growth_of_either_part_stays_with_it) {
    const Gyro gyro(10, [](double t, int mode) { return 0.01 * t + mode * (1.0 + 0.002 * t); });
    for (const ModePoint& p : split_modes(gyro.record(), 20).points) {
        EXPECT_NEAR(p.nonmagnetic_arcsec_s, 0.01 * p.time_s, 2e-3);
        EXPECT_NEAR(p.magnetic_arcsec_s, 1.0 + 0.002 * p.time_s, 2e-3);
    }
}

// Each segment of the one mode is earlier than its neighbour of the other: without the growth both parts would be off.
TEST(ModeSplit, growth_too_straight_for_its_time_is_no_nonmagnetic_part) {
    std::mt19937 engine(5);
    std::normal_distribution<double> noise(0.0, 0.1);
    const Gyro gyro(
        10, [&](double t, int mode) { return 0.05 + mode * (0.7 + 4.0 * -std::expm1(-t / 4000.0)) + noise(engine); });
    const ModeSplit split = split_modes(gyro.record(), 20);
    EXPECT_FALSE(split.thermal_time_s.determined);
    EXPECT_NEAR(split.nonmagnetic_arcsec_s.value, 0.05, 4.0 * split.nonmagnetic_arcsec_s.sigma);
    EXPECT_LT(split.nonmagnetic_arcsec_s.sigma, 0.002);
}

// A growth and its time leave two degrees of freedom of six segments: no finite error.
TEST(ModeSplit, few_segments_have_a_nonmagnetic_part_too) {
    for (unsigned seed = 1; seed < 40; ++seed) {
        std::mt19937 engine(seed);
        std::normal_distribution<double> noise(0.0, 0.1);
        const Gyro gyro(6, [&](double, int mode) { return 0.05 + 0.7 * mode + noise(engine); });
        EXPECT_TRUE(split_modes(gyro.record(), 20).nonmagnetic_arcsec_s.determined);
    }
}

TEST(ModeSplit, warming_is_found_within_its_error) {
    std::mt19937 engine(3);
    std::normal_distribution<double> noise(0.0, 1.4);
    const Gyro gyro(100, [&](double t, int mode) {
        return 0.05 + mode * (0.7 + 0.9 * (1.0 - std::exp(-t / 400.0))) + noise(engine);
    });
    const ModeSplit split = split_modes(gyro.record(), 20);
    const auto expect = [](const numeric::Estimate& e, double truth, double sigma_most) {
        ASSERT_TRUE(e.determined) << e.reason;
        EXPECT_NEAR(e.value, truth, 4.0 * e.sigma);
        EXPECT_LT(e.sigma, sigma_most);
    };
    expect(split.nonmagnetic_arcsec_s, 0.05, 0.01);
    expect(split.magnetic_arcsec_s, 0.7, 0.05);
    expect(split.magnetic_thermal_arcsec_s, 0.9, 0.05);
    expect(split.thermal_time_s, 400.0, 60.0);
    std::vector<double> rates = gyro.rates;
    take_out_magnetic(split, gyro.mode, 100.0, rates);
    const ModeSplit rest =
        split_modes({.rate_hz = 100.0, .rates_arcsec_s = rates, .bridged_arcsec_s = {}, .mode = gyro.mode}, 20);
    EXPECT_NEAR(rest.magnetic_arcsec_s.value, 0.0, 0.01);
}

TEST(ModeSplit, the_angle_of_a_switch_is_what_it_adds) {
    Gyro gyro(8, [](double, int mode) { return 3.0 + mode * 0.7; });
    // 6 arcsec in the settling after the third switch, -2 in the gap of the fifth.
    gyro.rates[3 * 2000 + 7] += 600.0;
    gyro.bridged[3 * 2000 + 7] += 600.0;
    gyro.bridged[5 * 2000 + 2] -= 200.0;
    const ModeSplit split = split_modes(gyro.record(), 20);
    ASSERT_EQ(split.switches.size(), 7u);
    EXPECT_NEAR(split.switches[2].error_arcsec, 6.0, 1e-3);
    EXPECT_NEAR(split.switches[4].error_arcsec, -2.0, 1e-3);
    EXPECT_NEAR(split.switches[2].time_s, 60.0, 1e-9);
    EXPECT_EQ(split.switches[2].mode_after, -1);
    EXPECT_NEAR(split.statistics.mean_arcsec, 4.0 / 7.0, 1e-3);
    EXPECT_NEAR(split.statistics.rms_arcsec, std::sqrt(40.0 / 7.0), 1e-3);
    EXPECT_NEAR(split.statistics.max_arcsec, 6.0, 1e-3);
    EXPECT_NEAR(split.statistics.mean_by_mode_arcsec, (-6.0 + 2.0) / 7.0, 1e-3);
}

TEST(ModeSplit, a_gyro_that_is_never_switched_has_one_segment) {
    const Gyro gyro(1, [](double, int) { return 1.0; });
    const ModeSplit split = split_modes(gyro.record(), 20);
    EXPECT_EQ(split.segments.size(), 1u);
    EXPECT_FALSE(split.magnetic_arcsec_s.determined);
    EXPECT_TRUE(split.switches.empty());
}

TEST(ModeSplit, refuses_records_of_different_length) {
    const std::vector<double> rates(5, 1.0);
    const std::vector<std::int8_t> mode(4, 1);
    EXPECT_THROW((void)split_modes({.rate_hz = 1.0, .rates_arcsec_s = rates, .bridged_arcsec_s = {}, .mode = mode}, 1),
                 deviations::SeriesError);
}

}  // namespace zlg::noise::mode_split_test
