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
    const auto is_good = [](int passed, int known, double mean_square) {
        return trials::VerdictScore{.beyond = 100, .passed = passed, .known = known, .squares = known * mean_square}
            .is_good(0.05);
    };
    EXPECT_FALSE(is_good(15, 100, 1.0));
    EXPECT_TRUE(is_good(9, 100, 1.0));
    EXPECT_FALSE(is_good(9, 100, 1.5));
    EXPECT_FALSE(is_good(9, 100, 0.5));
    EXPECT_FALSE(is_good(9, 0, 1.0));
    // chi-square of 4 degrees: 18.5 at 0.999, and 0.0908 at 0.001.
    EXPECT_FALSE(is_good(9, 4, 18.8 / 4.0));
    EXPECT_TRUE(is_good(9, 4, 18.0 / 4.0));
    EXPECT_FALSE(is_good(9, 4, 0.03 / 4.0));
}

TEST(AcceptCampaign, hours_that_are_wrong_by_half_are_found) {
    // Of 100 with an even chance 66 or more, or 34 or fewer, are decided once in a thousand.
    const auto is_good = [](int early, int late) {
        return trials::VerdictScore{.predicted = 100, .decided = {early, 50, late}, .known = 100, .squares = 100.0}
            .is_good(0.05);
    };
    EXPECT_TRUE(is_good(35, 60));
    EXPECT_FALSE(is_good(67, 80));
    EXPECT_FALSE(is_good(20, 33));
}

// Ten foreseen: by 1.5 and chance 27 at the most.
TEST(AcceptCampaign, verdicts_that_stay_open_without_reason_are_found) {
    const auto is_good = [](int undecided, double foreseen) {
        return trials::VerdictScore{.undecided = undecided, .foreseen = foreseen, .known = 100, .squares = 100.0}
            .is_good(0.05);
    };
    EXPECT_TRUE(is_good(10, 10.0));
    EXPECT_FALSE(is_good(28, 10.0));
    EXPECT_TRUE(is_good(50, 60.0));
    EXPECT_FALSE(is_good(15, 60.0));
}

}  // namespace zlg::accept_campaign_test
