// Text that a configuration can hold, and text that it could not write again.
#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::config::schema_text_test {

TEST(ConfigText, WhatIsNotUtf8IsRefusedByEveryWayIn) {
    for (const char* bad : {"\xff", "a b\xd2\x8b\x87", "\xc0\xaf", "\xed\xa0\x80"}) {
        Config config;
        EXPECT_THROW(apply_set(config, "motion.path=" + std::string{bad}), ConfigError);
        EXPECT_THROW(apply_log(config, {{"motion.path", bad}}, "raw.csv"), ConfigError);
        EXPECT_THROW(apply_toml(config, "motion.path = \"" + std::string{bad} + "\"\n", "lab.toml"), ConfigError);
        EXPECT_EQ(config.motion.path, "");
    }
}

TEST(ConfigText, ABareWordOfTheCommandLineIsReadBackFromItsToml) {
    for (const char* text :
         {"logs/gyro 1.txt", "C:\\data\\\"old\".txt", "\xc3\xa9t\xc3\xa9.txt", "tab\there", "a = b"}) {
        Config config;
        apply_set(config, "motion.path=" + std::string{text});
        EXPECT_EQ(config.motion.path, text);
        Config again;
        apply_toml(again, to_toml(config), "written.toml");
        EXPECT_EQ(again.motion.path, text);
    }
}

}  // namespace zlg::config::schema_text_test
