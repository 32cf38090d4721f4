#include <zlg/trials/event_campaign.hpp>

#include "test.hpp"

namespace zlg::trials::event_campaign_test {

// Five gyros, a switch each 2 to 90 s, within chance; the whole is `zlg_trials events`.
TEST(EventCampaign, GyrosFromEventToEventFollowTheLawOfThoseThatLive) {
    const auto figures = run({.gyros = 5, .runs = 8, .switches = 4.0, .longest_s = 60.0});
    ASSERT_EQ(figures.size(), 5u);
    EXPECT_EQ(complaint(figures), "");
    EXPECT_NE(markdown(figures).find("mean z^2"), std::string::npos);
}

TEST(EventCampaign, AnotherLawIsSeen) {
    EventFigures wrong{.gyro = "one"};
    wrong.z.fill(3.0);
    EXPECT_NE(complaint({wrong, wrong, wrong}).find("one"), std::string::npos);
}

TEST(EventCampaign, GyrosAreAllDifferentAndEachMeetsEach) {
    std::set<std::string> seen;
    for (std::int64_t k = 0; k < 60; ++k) {
        std::string settings;
        (void)event_gyro(k, &settings);
        EXPECT_TRUE(seen.insert(settings).second) << settings;
    }
}

}  // namespace zlg::trials::event_campaign_test
