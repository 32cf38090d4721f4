#include <zlg/rig/measured_half_wave.hpp>

#include "test.hpp"

namespace zlg::measured_half_wave_test {

core::SwitchEvent measured(double half_wave_v) { return {.has_half_wave = true, .half_wave_v = half_wave_v}; }
const core::SwitchEvent nothing{};

rig::MeasuredHalfWave after(int n, double half_wave_v) {
    rig::MeasuredHalfWave f{.presumed_v = 40.0};
    for (int k = 0; k < n; ++k) f.take(measured(half_wave_v));
    return f;
}

TEST(MeasuredHalfWave, one_measurement_is_the_weighted_mean_of_presumed_and_measured) {
    const rig::MeasuredHalfWave f = after(1, 42.0);
    // Inverse variances: presumed 1/(16) (its ceiling: process noise adds nothing), measured 1/(0.09).
    const double weight_presumed = 1.0 / 16.0;
    const double weight_measured = 1.0 / 0.09;
    const double sum = weight_presumed + weight_measured;
    EXPECT_NEAR(f.estimate_v, (40.0 * weight_presumed + 42.0 * weight_measured) / sum, 1e-12);
    EXPECT_NEAR(f.sigma_v(), std::sqrt(1.0 / sum), 1e-12);
}

// P^2 + q P - q r = 0 for the posterior variance P.
TEST(MeasuredHalfWave, the_steady_sigma_solves_the_riccati_equation) {
    const double q = 0.01;
    const double r = 0.09;
    EXPECT_NEAR(after(300, 40.0).variance_v2, 0.5 * (-q + std::sqrt(q * q + 4.0 * q * r)), 1e-12);
}

TEST(MeasuredHalfWave, outliers_and_other_modes_are_rejected) {
    rig::MeasuredHalfWave f = after(20, 40.0);
    const double held_v = f.estimate_v;
    constexpr double endless = std::numeric_limits<double>::infinity();
    for (const double wrong_v : {std::nan(""), endless, -endless, 1e300, 0.0, -40.0, 42.0, 19.0, 81.0}) {
        const double before_v2 = f.variance_v2;
        f.take(measured(wrong_v));
        EXPECT_EQ(f.estimate_v, held_v) << wrong_v;
        EXPECT_GT(f.variance_v2, before_v2);
    }
}

TEST(MeasuredHalfWave, a_second_outlier_on_the_same_side_is_believed) {
    rig::MeasuredHalfWave f = after(20, 34.0);
    // The other side begins anew, and another mode is no second one.
    for (const double wrong_v : {38.0, 30.0, 38.0, 100.0}) f.take(measured(wrong_v));
    f.take(measured(38.5));
    // p = 4.5^2 against 0.3^2.
    EXPECT_NEAR(f.estimate_v, 34.0 + 4.5 * 20.25 / 20.34, 1e-6);
    EXPECT_NEAR(f.sigma_v(), std::sqrt(0.09 * 20.25 / 20.34), 1e-7);
}

TEST(MeasuredHalfWave, without_measurements_the_sigma_grows_to_that_of_the_presumed_value) {
    rig::MeasuredHalfWave f = after(1, 40.0);
    for (int k = 0; k < 10000; ++k) f.take(nothing);
    EXPECT_DOUBLE_EQ(f.sigma_v(), 4.0);
    const rig::MeasuredHalfWave before = f;
    f.take({.outcome = core::SwitchOutcome::returned, .has_half_wave = true, .half_wave_v = 41.0});
    EXPECT_EQ(f.estimate_v, before.estimate_v);
}

}  // namespace zlg::measured_half_wave_test
