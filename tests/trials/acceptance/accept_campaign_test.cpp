#include <zlg/trials/accept_campaign.hpp>

#include "test.hpp"

namespace zlg::accept_campaign_test {

TEST(AcceptCampaign, verdicts_keep_their_risk_and_stop_at_what_is_no_measurement) {
    const std::string folder = testing::TempDir() + "accept_campaign_test";
    std::filesystem::create_directories(folder);
    const trials::AcceptCampaign campaign = trials::run_accept_campaign({.n_units = 30, .seed = 3, .folder = folder});
    std::filesystem::remove_all(folder);
    EXPECT_TRUE(campaign.is_good()) << campaign_text(campaign);
    EXPECT_EQ(campaign.faulty, 3);
    EXPECT_GT(campaign.quantities.at("bias.deg_h").beyond, 0);
}

TEST(AcceptCampaign, a_risk_that_is_not_kept_is_found) {
    // Of 100 with a chance of 0.05 each 15 or more are wrong once in ten thousand.
    EXPECT_FALSE((trials::VerdictScore{.beyond = 100, .passed = 15}.is_good(0.05)));
    EXPECT_TRUE((trials::VerdictScore{.beyond = 100, .passed = 9}.is_good(0.05)));
    EXPECT_FALSE((trials::VerdictScore{.known = 100, .squares = 150.0}.is_good(0.05)));
}

}  // namespace zlg::accept_campaign_test
