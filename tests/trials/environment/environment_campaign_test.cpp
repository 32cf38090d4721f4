#include <zlg/trials/environment_campaign.hpp>

#include <set>

#include <zlg/config/schema.hpp>
#include <zlg/trials/gyro_campaign.hpp>

#include "test.hpp"

namespace zlg::environment_campaign_test {

using namespace trials;

TEST(EnvironmentCampaign, draws_every_profile_and_every_field_and_what_is_allowed) {
    std::set<std::string> profiles, fields;
    for (std::uint64_t number = 0; number < 60; ++number) {
        const EnvironmentGyro gyro = environment_gyro({}, number);
        EXPECT_NO_THROW(config::check(gyro.config)) << gyro.family;
        profiles.insert(gyro.family.substr(0, gyro.family.find(',')));
        fields.insert(gyro.family.substr(gyro.family.find(',')));
    }
    EXPECT_EQ(profiles.size(), 5u);
    EXPECT_EQ(fields.size(), 4u);
}

TEST(EnvironmentCampaign, holds_gyros_that_are_well) {
    const auto outcomes = run({.gyros = 2, .threads = 2, .run_s = 100.0});
    for (const EnvironmentOutcome& o : outcomes) {
        EXPECT_EQ(o.crash, "") << o.family;
        EXPECT_FALSE(o.lost) << o.family;
        EXPECT_GE(o.switches, 1) << o.family;
    }
    EXPECT_NE(markdown(outcomes).find("| ~ all | 2 | 0 |"), std::string::npos);
}

// Its analog loop slews at first, which `frequency` does not presume, and the phase shows it.
TEST(EnvironmentCampaign, holds_a_loop_that_is_not_exponential) {
    const EnvironmentGyro gyro = environment_gyro({.run_s = 300.0}, 7);
    ASSERT_EQ(gyro.config.compensation.relock, core::RelockMethod::frequency);
    const GyroOutcome outcome = run(GyroTrial{.config = gyro.config});
    EXPECT_GE(outcome.judged, 4);
    EXPECT_LT(outcome.mean_sq_ratio, 3.0);
}

TEST(EnvironmentCampaign, names_what_breaks_a_limit) {
    EnvironmentOutcome good{
        .family = "soak, sine", .switches = 10, .sum_sq_ratio = 10.0, .none_arcsec = 1.0, .estimate_arcsec = 1.09};
    EXPECT_TRUE(complaints({good}).empty());
    EnvironmentOutcome worse = good;
    worse.estimate_arcsec = 1.11;
    EXPECT_EQ(complaints({worse}).size(), 1u);
    EnvironmentOutcome lost = good;
    lost.lost = true;
    EXPECT_EQ(complaints({lost}).size(), 1u);
    EnvironmentOutcome doubtful = good;
    doubtful.sum_sq_ratio = 16.0;
    EXPECT_EQ(complaints({doubtful}).size(), 1u);
}

}  // namespace zlg::environment_campaign_test
