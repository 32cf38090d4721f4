#include <zlg/config/log_settings.hpp>

#include "test.hpp"

namespace zlg::config::log_settings_test {

TEST(LogSettings, ALogMayNameItsTickAndScaleWithoutASection) {
    EXPECT_EQ(checked_log_settings({{"tick_s", "0.005"}, {"scale_arcsec", "3"}, {"note", "x"}}, "log"),
              (Settings{{"gyro.tick_s", "0.005"}, {"gyro.scale_arcsec", "3"}, {"note", "x"}}));
}

TEST(LogSettings, OnlyOurKeysAreComparedAndByTheirValues) {
    const auto passes = [](const Settings& settings) {
        return test::refusal_by<ConfigError>([&] { (void)checked_log_settings(settings, "log"); }).empty();
    };
    EXPECT_TRUE(passes({{"note", "a"}, {"note", "b"}, {"operator.name", "a"}, {"operator.name", "b"}}));
    EXPECT_TRUE(passes({{"tick_s", "0.005"}, {"gyro.tick_s", "0.0050"}, {"gyro.tick_s", "5e-3"}}));
    EXPECT_TRUE(passes({{"motion.frequency_hz", "2"}, {"motion.frequency_hz", "[2.0]"}}));
    EXPECT_FALSE(passes({{"tick_s", "0.005"}, {"gyro.tick_s", "0.00501"}}));
    EXPECT_FALSE(passes({{"motion.kind", "'rest'"}, {"motion.kind", "'sine'"}}));
    EXPECT_FALSE(passes({{"gyr.tick_s", "0.005"}}));
}

// Keys, and values of keys, of a former version: what a log of it may hold.
struct Former {
    const char* key;
    const char* value;
    const char* shown;
    const char* in_its_place;
};

class FormerKeys : public testing::TestWithParam<Former> {};

INSTANTIATE_TEST_SUITE_P(
    All, FormerKeys,
    testing::Values(
        Former{"gyro.coil_current", "\"record\"", "gyro.coil_current", "leave it out"},
        Former{"switching.after_step", "switch", "switching.after_step", "leave it out"},
        Former{"switching.schedule", "\"growing\"", "switching.schedule = \"growing\"", "schedule = \"measured\""},
        Former{"switching.schedule", " growing ", "switching.schedule = \"growing\"", "schedule = \"measured\""},
        Former{"compensation.bridge", "'optimal'", "compensation.bridge = \"optimal\"", "bridge = \"auto\""},
        Former{"compensation.prior", "\"flat\"", "compensation.prior", "leave it out"},
        Former{"compensation.prior_band_hz", "24", "compensation.prior_band_hz", "leave it out"},
        Former{"compensation.prior_rate_arcsec_s", "-1", "compensation.prior_rate_arcsec_s", "leave it out"},
        Former{"compensation.prior_line_hz", "[20, 30]", "compensation.prior_line_hz", "leave it out"},
        Former{"compensation.prior_line_arcsec_s", "12000", "compensation.prior_line_arcsec_s", "leave it out"},
        Former{"analysis.taus", "\"log\"", "analysis.taus = \"log\"", "analysis.taus_s"},
        Former{"piezo.dac_bits", "12", "piezo.dac_bits", "leave it out"},
        Former{"switching.last_segment", "\"half\"", "switching.last_segment", "leave it out"}));

TEST_P(FormerKeys, AreSteppedOverInALogAndNamed) {
    const Settings settings{{"gyro.tick_s", "0.01"}, {GetParam().key, GetParam().value}, {"run.seed", "7"}};
    Config made;
    apply_log(made, checked_log_settings(settings, "raw.csv"), "raw.csv");
    Config without;
    apply_log(without, {settings.front(), settings.back()}, "raw.csv");
    EXPECT_EQ(to_settings(made), to_settings(without));
    EXPECT_EQ(made.given, without.given);
    EXPECT_EQ(former_keys_note(settings, "raw.csv"),
              std::string{"raw.csv: settings of a former version are stepped over: "} + GetParam().shown);
}

TEST_P(FormerKeys, AreRefusedElsewhereWithWhatIsInTheirPlace) {
    const std::string key = GetParam().key;
    const auto complaint = [](auto apply) {
        Config config;
        return test::refusal_by<ConfigError>([&] { apply(config); });
    };
    const std::string by_set = complaint([&](Config& c) { apply_set(c, key + "=" + GetParam().value); });
    EXPECT_EQ(by_set.find(std::string{"--set: "} + GetParam().shown + " is gone since format_version 3 of logs; "), 0u)
        << by_set;
    test::expect_contains(by_set, GetParam().in_its_place);
    const auto dot = key.find('.');
    const std::string by_file = complaint([&](Config& c) {
        apply_toml(c, "[" + key.substr(0, dot) + "]\n" + key.substr(dot + 1) + " = \"" + "growing" + "\"\n", "a.toml");
    });
    if (GetParam().shown == key) EXPECT_EQ(by_file, "a.toml:2" + by_set.substr(std::string{"--set"}.size()));
}

TEST(FormerKeysNote, OneLineNamesThemAllAndNoneWhereThereAreNone) {
    EXPECT_EQ(former_keys_note({{"switching.schedule", "\"fixed\""}, {"compensation.bridge", "auto"}, {"note", "x"}},
                               "raw.csv"),
              std::nullopt);
    EXPECT_EQ(former_keys_note({{"gyro.coil_current", "1"}, {"note", "x"}, {"switching.after_step", "2"}}, "raw.csv"),
              "raw.csv: settings of a former version are stepped over: gyro.coil_current, switching.after_step");
    EXPECT_EQ(former_keys_note({{"after_step", "2"}, {"", ""}, {".", "x"}}, "raw.csv"), std::nullopt);
}

// What no version knew is still a mistake.
TEST(FormerKeysNote, AnUnknownValueIsRefusedInALogToo) {
    Config c;
    EXPECT_THROW(apply_log(c, {{"switching.schedule", "\"shrinking\""}}, "raw.csv"), ConfigError);
    EXPECT_THROW(apply_log(c, {{"switching.after_steps", "\"wait\""}}, "raw.csv"), ConfigError);
}

}  // namespace zlg::config::log_settings_test
