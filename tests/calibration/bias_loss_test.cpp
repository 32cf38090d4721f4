#include <zlg/calibration/bias_loss.hpp>

#include "synthetic_gyro.hpp"

using namespace zlg::calibration;
using namespace synthetic;

namespace {

BiasLoss loss_of(const std::vector<LabLog>& logs) { return find_bias_loss(logs, find_bias_law(logs, 20.0, 0.0)); }

}  // namespace

TEST(BiasLoss, finds_chi_for_either_first_half_and_any_sign_of_the_miss) {
    for (const int first_sign : {1, -1}) {
        for (const double miss : {0.2, -0.15}) {
            const auto logs = one_log({.miss_lambda = miss, .first_sign = first_sign}, 120.0);
            const BiasLoss loss = loss_of(logs);
            ASSERT_TRUE(loss.chi.determined) << loss.chi.reason;
            EXPECT_LT(std::abs(errors_off(loss.chi, 4.0)), 4.0);
            EXPECT_LT(loss.chi.sigma, 0.08);
            EXPECT_EQ(loss.n_relocks, 59);
            EXPECT_NEAR(loss.chi2_per_dof, 1.0, 0.6);
        }
    }
}

TEST(BiasLoss, is_in_units_of_the_logged_detuning) {
    const auto logs = one_log({.detuning_scale = 1.25}, 120.0);
    EXPECT_LT(std::abs(errors_off(loss_of(logs).chi, 4.0 / (1.25 * 1.25))), 4.0);
}

TEST(BiasLoss, does_not_depend_on_the_course_of_the_transient) {
    for (const double tau_s : {0.005, 0.02}) {
        const auto logs = one_log({.tau_s = tau_s}, 120.0);
        EXPECT_LT(std::abs(errors_off(loss_of(logs).chi, 4.0)), 4.0) << tau_s;
    }
    // Midpoint samples of the light see such steps less exactly than the counter does: 4 % of one half.
    const BiasLoss stepped = loss_of(one_log({.stepped = true, .light_samples = 64}, 120.0));
    EXPECT_NEAR(stepped.chi.value, 4.0, 4.0 * stepped.chi.sigma + 0.02);
}

// Neither of them is the default's business: what was found is used.
TEST(BiasLoss, none_and_one_that_grows_are_results) {
    for (const double chi : {0.3, 0.0, -0.4, -4.0}) {
        for (const double miss : {0.05, 0.2}) {
            const BiasLoss loss = loss_of(one_log({.chi = chi, .miss_lambda = miss}, 300.0));
            ASSERT_TRUE(loss.chi.determined) << loss.chi.reason;
            EXPECT_LT(std::abs(errors_off(loss.chi, chi)), 4.0) << loss.chi.value << " +- " << loss.chi.sigma;
            EXPECT_TRUE(loss.higher.empty()) << chi << ' ' << miss;
        }
    }
}

// Relative losses of 7e-4, 2e-4, -9.2e-3 and -1.2e-2 at 0.05, 0.1, 0.15 and 0.2 wavelength: of a saturated gas.
TEST(BiasLoss, a_loss_that_changes_its_sign_takes_more_powers) {
    const SyntheticGyro gyro{.chi = 0.33057,
                             .chi_higher = {-21.0, -1386.67, 38095.2},
                             .miss_lambda = 0.2,
                             .light_samples = 64,
                             .light_noise_lambda = 0.001,
                             .with_phase = true};
    const BiasLoss loss = loss_of(one_log(gyro, 600.0));
    ASSERT_TRUE(loss.chi.determined) << loss.chi.reason;
    for (const double dl : {0.05, 0.1, 0.15, 0.19}) {
        const auto at = [dl](double chi, const std::vector<double>& higher) {
            double sum = chi * dl * dl;
            for (std::size_t k = 0; k < higher.size(); ++k) sum += higher[k] * std::pow(dl, 2 * k + 4);
            return sum;
        };
        EXPECT_NEAR(at(loss.chi.value, loss.higher), at(gyro.chi, gyro.chi_higher), 3e-4) << dl;
    }
}

// The counter's rounding, 1/12 count^2, goes where the places within the count are known.
TEST(BiasLoss, by_phase_it_is_known_tenfold) {
    const BiasLoss loss = loss_of(one_log({.light_noise_lambda = 0.0003, .with_phase = true}, 120.0));
    EXPECT_LT(std::abs(errors_off(loss.chi, 4.0)), 4.0);
    EXPECT_LT(loss.chi.sigma, 0.005);
    EXPECT_TRUE(loss.higher.empty());
}

// Plain least squares would lose a quarter of chi here.
TEST(BiasLoss, light_noise_does_not_pull_it_down) {
    const auto logs =
        one_log({.miss_lambda = 0.15, .light_samples = 4, .light_noise_lambda = 0.02, .segment_ticks = 120}, 400.0);
    const BiasLoss loss = loss_of(logs);
    ASSERT_TRUE(loss.chi.determined) << loss.chi.reason;
    EXPECT_LT(loss.chi.sigma, 0.08);
    EXPECT_LT(std::abs(errors_off(loss.chi, 4.0)), 4.0);
    EXPECT_NEAR(loss.chi2_per_dof, 1.0, 0.3);
}

TEST(BiasLoss, states_its_error) {
    double sum = 0.0;
    double sum_sq = 0.0;
    constexpr int trials = 60;
    for (int trial = 0; trial < trials; ++trial) {
        const auto logs = one_log({.bias_hz = 60e3 + 11.0 * trial,
                                   .miss_lambda = 0.12,
                                   .segment_ticks = 150,
                                   .seed = 10 + static_cast<std::uint64_t>(trial)},
                                  25.0);
        const double off = errors_off(loss_of(logs).chi, 4.0);
        sum += off;
        sum_sq += off * off;
    }
    EXPECT_NEAR(sum / trials, 0.0, 3.0 / std::sqrt(trials));
    EXPECT_NEAR(sum_sq / trials, 1.0, 0.6);
}

TEST(BiasLoss, refuses_what_the_logs_do_not_show) {
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<LabLog> blind{
        log_of(SyntheticGyro{}, 60.0, [nan](HalfRecord& r) { r.detuning_sq_lambda2 = nan; })};
    EXPECT_NE(loss_of(blind).chi.reason.find("detuning_sq_lambda2"), std::string::npos);
    const auto unswitched = one_log({.segment_ticks = 100'000}, 60.0);
    EXPECT_NE(loss_of(unswitched).chi.reason.find("no gap"), std::string::npos);
    const BiasLoss small = loss_of(one_log({.miss_lambda = 0.005}, 60.0));
    EXPECT_FALSE(small.chi.determined);
    EXPECT_NE(small.chi.reason.find("larger miss"), std::string::npos);
}

TEST(BiasLoss, a_column_that_tells_nothing_is_named) {
    for (const double square : {0.0, 1e-5, 1e200}) {
        const std::vector<LabLog> logs{
            log_of(SyntheticGyro{}, 60.0, [square](HalfRecord& r) { r.detuning_sq_lambda2 = square; })};
        const BiasLoss loss = loss_of(logs);
        EXPECT_FALSE(loss.chi.determined);
        EXPECT_NE(loss.chi.reason.find("detuning_sq_lambda2"), std::string::npos) << loss.chi.reason;
        EXPECT_TRUE(std::isfinite(loss.chi2_per_dof));
    }
}

TEST(BiasLoss, a_counter_that_stands_states_its_error) {
    for (const double chi : {0.0, -4.0}) {
        const BiasLoss loss = loss_of(one_log({.chi = chi, .rate_arcsec_s = 0.0}, 60.0));
        EXPECT_TRUE(loss.higher.empty());
        if (loss.chi.determined) EXPECT_LT(std::abs(errors_off(loss.chi, chi)), 4.0);
    }
}
