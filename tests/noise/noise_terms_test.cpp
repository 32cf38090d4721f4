#include <zlg/noise/noise_terms.hpp>

#include "test.hpp"

namespace zlg::noise::noise_terms_test {

using std::numbers::pi;

// Integral over all frequencies of the spectrum through the filter that differences of order n at tau are.
double through_filter(const NoiseTerms& terms, double tau_s, int order) {
    const double scale = order == 2 ? 2.0 : 6.0;
    double sum = 0.0;
    const double low = 1e-7 / tau_s, high = 3e4 / tau_s;
    const int n = 2'000'000;
    const double step = std::log(high / low) / n;
    for (int k = 0; k < n; ++k) {
        const double f = low * std::exp((k + 0.5) * step);
        const double w = 2.0 * pi * f, s = 2.0 * std::sin(pi * f * tau_s);
        sum += f * step * rate_spectrum(terms, f, 1e12) * std::pow(s * s, order) / (w * w);
    }
    return 2.0 * sum / (scale * tau_s * tau_s);
}

TEST(NoiseTerms, allan_variances_are_those_of_the_standard) {
    const double tau = 7.0;
    EXPECT_DOUBLE_EQ(allan_variance({.quantisation_arcsec = 2.0}, tau), 3.0 * 4.0 / 49.0);
    EXPECT_DOUBLE_EQ(allan_variance({.angle_random_walk_arcsec_sqrt_s = 3.0}, tau), 9.0 / 7.0);
    EXPECT_NEAR(allan_variance({.bias_instability_arcsec_s = 5.0}, tau), 25.0 * 2.0 * std::numbers::ln2 / pi, 1e-12);
    EXPECT_NEAR(allan_variance({.rate_random_walk_arcsec_s_sqrt_s = 0.5}, tau), 0.25 * 7.0 / 3.0, 1e-12);
    EXPECT_DOUBLE_EQ(allan_variance({.ramp_arcsec_s2 = 0.1}, tau), 0.01 * 49.0 / 2.0);
    const double x = tau / 3.0;
    EXPECT_NEAR(allan_variance({.markov = {{.deviation_arcsec_s = 2.0, .time_s = 3.0}}}, tau),
                4.0 / (x * x) * (2.0 * x - 3.0 + 4.0 * std::exp(-x) - std::exp(-2.0 * x)), 1e-12);
    EXPECT_NEAR(allan_variance({.sines = {{.amplitude_arcsec_s = 2.0, .frequency_hz = 0.05}}}, tau),
                4.0 * std::pow(std::sin(0.35 * pi), 4) / std::pow(0.35 * pi, 2), 1e-12);
}

TEST(NoiseTerms, hadamard_variance_of_white_noise_is_its_allan_variance_and_a_ramp_has_none) {
    EXPECT_NEAR(hadamard_variance({.angle_random_walk_arcsec_sqrt_s = 3.0}, 7.0), 9.0 / 7.0, 1e-12);
    EXPECT_EQ(hadamard_variance({.ramp_arcsec_s2 = 1.0}, 7.0), 0.0);
    EXPECT_NEAR(hadamard_variance({.quantisation_arcsec = 2.0}, 7.0), 20.0 / 6.0 * 4.0 / 49.0, 1e-12);
}

TEST(NoiseTerms, variances_are_the_spectrum_through_their_filters) {
    const NoiseTerms terms{.angle_random_walk_arcsec_sqrt_s = 1.0,
                           .bias_instability_arcsec_s = 0.7,
                           .rate_random_walk_arcsec_s_sqrt_s = 0.2,
                           .markov = {{.deviation_arcsec_s = 0.5, .time_s = 4.0}}};
    for (const double tau : {0.5, 8.0}) {
        const double allan = allan_variance(terms, tau), hadamard = hadamard_variance(terms, tau);
        EXPECT_NEAR(through_filter(terms, tau, 2), allan, 2e-4 * allan) << tau;
        EXPECT_NEAR(through_filter(terms, tau, 3), hadamard, 2e-4 * hadamard) << tau;
    }
}

TEST(NoiseTerms, a_long_correlation_is_a_random_walk_and_a_short_one_white_noise) {
    const NoiseTerms slow{.markov = {{.deviation_arcsec_s = 100.0, .time_s = 1e6}}};
    // q_c = s sqrt(2/T)
    const NoiseTerms walk{.rate_random_walk_arcsec_s_sqrt_s = 100.0 * std::sqrt(2e-6)};
    EXPECT_NEAR(allan_variance(slow, 10.0) / allan_variance(walk, 10.0), 1.0, 1e-4);
    const NoiseTerms quick{.markov = {{.deviation_arcsec_s = 2.0, .time_s = 1e-4}}};
    const NoiseTerms white{.angle_random_walk_arcsec_sqrt_s = 2.0 * std::sqrt(2e-4)};
    EXPECT_NEAR(allan_variance(quick, 10.0) / allan_variance(white, 10.0), 1.0, 1e-4);
}

TEST(NoiseTerms, quantised_angles_have_the_spectrum_of_their_differences) {
    // Differences of white angles at 10 Hz: variance 2 Q^2 rate^2 over all frequencies.
    double sum = 0.0;
    const NoiseTerms terms{.quantisation_arcsec = 3.0};
    for (int k = 0; k < 5000; ++k) sum += 2.0 * 1e-3 * rate_spectrum(terms, (k + 0.5) * 1e-3, 10.0);
    EXPECT_NEAR(sum, 2.0 * 9.0 * 100.0, 1e-6 * sum);
}

TEST(NoiseTerms, white_noise_behind_a_low_pass_of_first_order_is_a_markov_term) {
    const NoiseTerms filtered{.angle_random_walk_arcsec_sqrt_s = 0.3, .filter_time_s = 0.02};
    const NoiseTerms markov{.markov = {{.deviation_arcsec_s = 0.3 / std::sqrt(0.04), .time_s = 0.02}}};
    for (const double tau_s : {1e-3, 0.02, 1.0, 100.0}) {
        EXPECT_NEAR(allan_variance(filtered, tau_s) / allan_variance(markov, tau_s), 1.0, 1e-12);
        EXPECT_NEAR(rate_spectrum(filtered, 0.4 / tau_s, 1000.0) / rate_spectrum(markov, 0.4 / tau_s, 1000.0), 1.0,
                    1e-12);
    }
    EXPECT_NEAR(allan_variance(filtered, 100.0), 0.09 / 100.0, 1e-6);
}

}  // namespace zlg::noise::noise_terms_test
