// A log starts with a closed loop, which may still settle.
#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_start_test {

using namespace gyro_compensation_support;

// Sigma of the first tick of a log at rest, whose halves have these mean squares of the detuning.
double first_sigma(RelockMethod method, double first_sq, double second_sq) {
    GyroCompensationConfig config;
    config.relock.method = method;
    config.gyro.random_walk = ArcsecPerRootSecond{0.0};
    config.bridge.method = BridgeMethod::constant;
    Halves halves = biased_halves(60);
    for (HalfRecord& half : halves) half.detuning_sq_lambda2 = 1.1e-5;
    halves[0].detuning_sq_lambda2 = first_sq;
    halves[1].detuning_sq_lambda2 = second_sq;
    for (HalfRecord& half : halves) half.detuning_lambda = std::sqrt(half.detuning_sq_lambda2);
    return run(config, halves).rows.at(0).sigma_arcsec;
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
