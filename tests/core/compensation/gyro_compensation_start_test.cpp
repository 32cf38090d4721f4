// A log starts with a closed loop, which may still settle.
#include <zlg/core/gyro_compensation.hpp>

#include "support.hpp"

namespace zlg::core::gyro_compensation_start_test {

// Sigma of the first tick of a log at rest, whose halves have these mean squares of the detuning.
double first_sigma(RelockMethod method, double first_sq, double second_sq) {
    GyroCompensationConfig config;
    config.relock.method = method;
    config.gyro.random_walk = ArcsecPerRootSecond{0.0};
    config.bridge.method = BridgeMethod::constant;
    GyroCompensationState state;
    for (int h = 0; h < 60; ++h) {
        HalfRecord half;
        half.half = h;
        half.bias_sign = h % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
        half.mode = 1;
        half.counts = h % 2 == 0 ? 150 : -150;
        half.loop_closed = half.valid = true;
        half.detuning_sq_lambda2 = h == 0 ? first_sq : h == 1 ? second_sq : 1.1e-5;
        half.detuning_lambda = std::sqrt(half.detuning_sq_lambda2);
        const CompensationOutput out = step(config, state, half);
        if (out.has_sample && out.sample.has_final && out.sample.final_row.tick == 0)
            return out.sample.final_row.sigma_arcsec;
    }
    return -1.0;
}

constexpr double of_rounding_arcsec2 = 3.263 * 3.263 / 6.0;

TEST(LogStart, SigmaHoldsWhatTheLoopHasYetToSettle) {
    // chi f0/2 (dl_2^2 - dl_1^2) K T: 4.23 arcsec.
    const double false_arcsec = 0.5 * 3.6 * 60e3 * (2.6e-3 - 2e-4) * 3.263 * 0.005;
    // Noise of the light in it: the mean of n squares of dl + e has the variance (4 dl^2 s^2 + 2 s^4)/n.
    const CompensationConstants gyro;
    const double s2 = gyro.light_noise.value() * gyro.light_noise.value();
    const double noise_lambda2 = (4.0 * (2.8e-3 - 2.0 * s2) * s2 + 4.0 * s2 * s2) / gyro.light_samples;
    const double per_lambda2 = 0.5 * 3.6 * 60e3 * 3.263 * 0.005;
    const double expected =
        of_rounding_arcsec2 + false_arcsec * false_arcsec + per_lambda2 * per_lambda2 * noise_lambda2;
    EXPECT_NEAR(first_sigma(RelockMethod::mean_square, 2.6e-3, 2e-4), std::sqrt(expected), 1e-9);
}

TEST(LogStart, ASettledLoopCostsNothing) {
    EXPECT_NEAR(first_sigma(RelockMethod::mean_square, 1.1e-5, 1.2e-5), std::sqrt(of_rounding_arcsec2), 1e-12);
    EXPECT_NEAR(first_sigma(RelockMethod::none, 2.6e-3, 2e-4), std::sqrt(of_rounding_arcsec2), 1e-12);
}

}  // namespace zlg::core::gyro_compensation_start_test
