
#include <zlg/trials/noise_campaign.hpp>

#include "test.hpp"

namespace zlg::noise_campaign_test {

// The campaign itself is `zlg_trials noise`; a few short records show that it counts.
TEST(NoiseCampaign, errors_are_as_large_as_claimed) {
    const auto campaign = trials::run_noise_campaign({.n_gyros = 24, .n_samples = 1 << 13, .seed = 3});
    ASSERT_EQ(campaign.terms.size(), 9u);
    const auto& white = campaign.terms[1];
    EXPECT_EQ(white.present, 24);
    EXPECT_GE(white.found, 22);
    // 24 squares of standard normal errors: 1 +- 0.29.
    EXPECT_NEAR(white.mean_square, 1.0, 0.9);
    int absent = 0, falsely = 0, present = 0, found = 0;
    for (std::size_t k = 0; k < 7; ++k) {
        absent += campaign.terms[k].absent;
        falsely += campaign.terms[k].false_found;
        present += campaign.terms[k].present;
        found += campaign.terms[k].found;
    }
    EXPECT_EQ(absent + present, 7 * 24);
    EXPECT_LE(falsely, absent / 10);
    EXPECT_GT(found, present * 7 / 10);
}

// The campaign itself is `zlg_trials noise 400 --filters`.
TEST(NoiseCampaign, angle_random_walk_is_found_behind_low_passes_with_the_bandwidth) {
    const auto campaign = trials::run_noise_campaign({.n_gyros = 30, .seed = 4, .filters = true});
    const auto& white = campaign.terms[1];
    EXPECT_GE(white.found, 29);
    // 30 squares of standard normal errors: 1 +- 0.26.
    EXPECT_NEAR(white.mean_square, 1.0, 0.9);
    EXPECT_GE(campaign.bandwidth.present, 20);
    EXPECT_GE(campaign.bandwidth.found, campaign.bandwidth.present - 3);
    EXPECT_EQ(campaign.bandwidth.false_found, 0);
    EXPECT_GE(campaign.bandwidths_within_10, campaign.bandwidth.found - 2);
}

// Of 150 gyros half have a ramp; beside a random walk or flicker of the rate it was often taken for that noise, 62 of
// 78 were found.
TEST(NoiseCampaign, ramps_are_found_beside_slow_noise) {
    const auto campaign = trials::run_noise_campaign({.n_gyros = 150, .n_samples = 1 << 12, .seed = 5});
    const auto& ramp = campaign.terms[4];
    EXPECT_GE(ramp.found, ramp.present * 86 / 100);
    EXPECT_LE(ramp.false_found, 2);
    // About 70 squares: 1 +- 0.17.
    EXPECT_NEAR(ramp.mean_square, 1.0, 0.5);
}

TEST(NoiseCampaign, is_a_table) {
    const std::string text =
        trials::campaign_text(trials::run_noise_campaign({.n_gyros = 1, .n_samples = 4096, .seed = 1}));
    EXPECT_NE(text.find("| angle random walk | 1 | 1 | 0 | 0 |"), std::string::npos) << text;
}

}  // namespace zlg::noise_campaign_test
