#include <zlg/rig/refusal.hpp>

#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::refusal_test {

config::Config warm() {
    config::Config config;
    config.gyro.temperature_rise_c = 5;
    return config;
}

std::string message_of(auto&& refused) {
    return test::refusal_by<config::ConfigError>([&] { refused(); });
}

TEST(Refusal, a_message_that_names_a_key_which_was_set_stays) {
    EXPECT_EQ(rig::named(warm(), "gyro.temperature_rise_c is too much"), "gyro.temperature_rise_c is too much");
    EXPECT_EQ(rig::named({}, "too much"), "too much");
}

TEST(Refusal, to_any_other_message_the_keys_that_were_set_are_added) {
    EXPECT_EQ(rig::named(warm(), "too much"), "too much; set: gyro.temperature_rise_c = 5");
    EXPECT_EQ(rig::named(warm(), "gyro.temperature_rise_c2"),
              "gyro.temperature_rise_c2; set: gyro.temperature_rise_c = 5");
}

TEST(Refusal, keys_stand_with_their_values_before_what_is_allowed) {
    EXPECT_EQ(message_of([] { rig::refuse(warm(), {"gyro.temperature_rise_c"}, "less"); }),
              "gyro.temperature_rise_c = 5: allowed is less");
}

TEST(Refusal, a_rate_that_cannot_be_counted_names_what_makes_the_gyro) {
    EXPECT_EQ(message_of([] { rig::refuse_rate(warm(), "it overflows"); }),
              "gyro.temperature_rise_c = 5, a rate beyond any counter: it overflows");
}

}  // namespace zlg::refusal_test
