#include <zlg/calibration/loss_curve.hpp>

#include <zlg/calibration/bias_loss.hpp>

#include "synthetic_gyro.hpp"

using namespace zlg::calibration;
using namespace synthetic;

namespace {

constexpr double pole_lambda = 0.14;

// A gyro that logs a tan(dl/a), a signal that grows faster than the detuning; F is a atan(x/a).
std::vector<LabLog> expansive(SyntheticGyro gyro, double duration_s) {
    gyro.light_samples = 64;
    gyro.pole_lambda = pole_lambda;
    return one_log(gyro, duration_s);
}

double f(double logged_lambda) { return pole_lambda * std::atan(logged_lambda / pole_lambda); }

LossCurve curve_of(const std::vector<LabLog>& logs) { return find_loss_curve(logs, find_bias_law(logs, 20.0, 0.0)); }

}  // namespace

TEST(LossCurve, gives_the_loss_of_an_expansive_discriminator_within_its_error) {
    for (const double miss : {0.18, -0.16}) {
        const auto logs = expansive({.miss_lambda = miss, .rate_arcsec_s = 37.0}, 900.0);
        const LossCurve found = curve_of(logs);
        ASSERT_TRUE(found.determined) << found.reason;
        EXPECT_NEAR(found.chi2_per_dof, 1.0, 0.3);
        const auto straight = straightened(logs, found);
        const BiasLoss loss = find_bias_loss(straight, find_bias_law(logs, 20.0, 0.0));
        ASSERT_TRUE(loss.chi.determined) << loss.chi.reason;
        for (std::size_t k = 8; k < found.logged_lambda.size(); ++k) {
            const double detuning = found.detuning_lambda[k] * std::sqrt(loss.chi.value / 4.0);
            EXPECT_NEAR(detuning, f(found.logged_lambda[k]), 4.0 * found.sigma_lambda[k] + 2e-4) << k;
            EXPECT_LT(found.sigma_lambda[k], 0.05 * detuning) << k;
        }
        const double first_lambda = pole_lambda * std::tan(std::abs(miss) / pole_lambda);
        EXPECT_LT(found.logged_lambda.back(), first_lambda);
        EXPECT_GT(found.logged_lambda.back(), 0.75 * first_lambda);
    }
}

TEST(LossCurve, reads_means_and_squares_as_the_gyro_was_detuned) {
    const auto logs = expansive({.miss_lambda = 0.16, .rate_arcsec_s = 37.0}, 900.0);
    const LossCurve found = curve_of(logs);
    ASSERT_TRUE(found.determined) << found.reason;
    const auto straight = straightened(logs, found);
    const std::size_t last = straight[0].relocks.size() - 1;
    const auto& logged = logs[0].relocks[last].halves[2];
    const auto& read = straight[0].relocks[last].halves[2];
    EXPECT_NEAR(read.detuning_lambda / f(logged.detuning_lambda), 1.0, 0.05);
    EXPECT_LT(read.detuning_sq_lambda2, logged.detuning_sq_lambda2);
}

TEST(LossCurve, a_straight_discriminator_has_none) {
    for (const double scale : {1.0, 1.25}) {
        const LossCurve found =
            curve_of(one_log({.miss_lambda = 0.18, .detuning_scale = scale, .rate_arcsec_s = 37.0}, 900.0));
        EXPECT_FALSE(found.determined);
        EXPECT_NE(found.reason.find("straight line"), std::string::npos) << found.reason;
    }
}

TEST(LossCurve, refuses_what_the_logs_do_not_show) {
    EXPECT_NE(curve_of(one_log({}, 30.0)).reason.find("20 or more"), std::string::npos);
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<LabLog> blind{log_of(SyntheticGyro{}, 120.0, [nan](HalfRecord& r) { r.detuning_lambda = nan; })};
    EXPECT_NE(curve_of(blind).reason.find("detuning_lambda"), std::string::npos);
    BiasLaw none;
    EXPECT_NE(find_loss_curve(blind, none).reason.find("bias frequency"), std::string::npos);
}
