#include <zlg/deviations/series.hpp>
#include <zlg/noise/noise_units.hpp>

#include "test.hpp"

namespace zlg::noise::noise_units_test {

constexpr double rad_per_deg = std::numbers::pi / 180.0;

TEST(NoiseUnits, a_data_sheet_and_back) {
    // 0.002 deg/sqrt(h) = 7.2 arcsec in 60 sqrt(s); 1 deg/h = 1 arcsec/s.
    const NoiseTerms terms = terms_of(DataSheet{.quantisation_arcsec = 0.1,
                                                .angle_random_walk_deg_sqrt_h = 0.002,
                                                .bias_instability_deg_h = 0.003,
                                                .rate_random_walk_deg_h_sqrt_h = 0.006,
                                                .ramp_deg_h_h = 0.36});
    EXPECT_DOUBLE_EQ(terms.angle_random_walk_arcsec_sqrt_s, 7.2 / 60.0);
    EXPECT_DOUBLE_EQ(terms.bias_instability_arcsec_s, 0.003);
    EXPECT_DOUBLE_EQ(terms.rate_random_walk_arcsec_s_sqrt_s, 1e-4);
    EXPECT_DOUBLE_EQ(terms.ramp_arcsec_s2, 1e-4);
    const DataSheet sheet = data_sheet(terms);
    EXPECT_DOUBLE_EQ(sheet.quantisation_arcsec, 0.1);
    EXPECT_DOUBLE_EQ(sheet.angle_random_walk_deg_sqrt_h, 0.002);
    EXPECT_DOUBLE_EQ(sheet.rate_random_walk_deg_h_sqrt_h, 0.006);
    EXPECT_DOUBLE_EQ(sheet.ramp_deg_h_h, 0.36);
}

TEST(NoiseUnits, discrete_forms_add_up_to_the_continuous_ones) {
    const NoiseTerms terms{.angle_random_walk_arcsec_sqrt_s = 0.12,
                           .rate_random_walk_arcsec_s_sqrt_s = 1e-3,
                           .markov = {{.deviation_arcsec_s = 0.5, .time_s = 20.0}}};
    const DiscreteNoise d = discrete_noise(terms, 200.0);
    // 200 increments of a second scatter by N together, 200 steps by K.
    EXPECT_NEAR(d.white_increment_arcsec * std::sqrt(200.0), 0.12, 1e-15);
    EXPECT_NEAR(d.white_rate_arcsec_s / 200.0, d.white_increment_arcsec, 1e-15);
    EXPECT_NEAR(d.walk_step_arcsec_s * std::sqrt(200.0), 1e-3, 1e-15);
    EXPECT_NEAR(std::pow(d.markov_factor[0], 4000.0), std::exp(-1.0), 1e-9);
    // Stationary: s^2 = factor^2 s^2 + step^2.
    EXPECT_NEAR(std::hypot(d.markov_factor[0] * 0.5, d.markov_step_arcsec_s[0]), 0.5, 1e-12);
    EXPECT_THROW((void)discrete_noise(terms, 0.0), deviations::SeriesError);
}

TEST(NoiseUnits, kalibr_counts_in_radians) {
    const NoiseTerms terms{.angle_random_walk_arcsec_sqrt_s = 3600.0, .rate_random_walk_arcsec_s_sqrt_s = 7200.0};
    const KalibrGyro gyro = kalibr_gyro(terms, 100.0);
    EXPECT_NEAR(gyro.noise_density_rad_s_sqrt_hz, rad_per_deg, 1e-15);
    EXPECT_NEAR(gyro.random_walk_rad_s2_sqrt_hz, 2.0 * rad_per_deg, 1e-15);
    EXPECT_EQ(gyro.update_rate_hz, 100.0);
}

}  // namespace zlg::noise::noise_units_test
