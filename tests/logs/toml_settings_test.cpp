#include "toml_settings.hpp"

#include <zlg/logs/error.hpp>

#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;

TEST(TomlSettings, values_stand_as_they_were_written) {
    EXPECT_EQ(settings_to_toml(
                  {{"gyro.bias_hz", "60e3"}, {"motion.kind", "\"rest\""}, {"design.run_lengths_s", "[1, 2.50]"}}),
              "gyro.bias_hz = 60e3\nmotion.kind = \"rest\"\ndesign.run_lengths_s = [1, 2.50]\n");
}

TEST(TomlSettings, a_bare_text_becomes_a_string_and_comes_back_bare) {
    const Settings settings{{"compensation.relock", "mean_square"}, {"motion.path", "C:\\a b.txt"}, {"a.b", ""}};
    const std::string text = settings_to_toml(settings);
    EXPECT_EQ(text, "compensation.relock = 'mean_square'\nmotion.path = 'C:\\a b.txt'\na.b = ''\n");
    EXPECT_EQ(settings_from_toml(text, ""), settings);
}

TEST(TomlSettings, what_toml_cannot_hold_stays_a_comment) {
    const Settings settings{{"note", "3"}, {"gyro.tick_s", "1"},   {"gyro.tick_s", "2"},
                            {"gyro", "1"}, {"gyro.tick_s.x", "1"}, {"a.b", "it's"},
                            {"a..c", "1"}, {"a.d", "1 # one"},     {"a.e", "{x = 1}"}};
    const std::string text = settings_to_toml(settings);
    EXPECT_EQ(text,
              "# note = 3\ngyro.tick_s = 1\n# gyro.tick_s = 2\n# gyro = 1\n# gyro.tick_s.x = 1\n# a.b = it's\n"
              "# a..c = 1\n# a.d = 1 # one\n# a.e = {x = 1}\n");
    EXPECT_EQ(settings_from_toml(text, ""), settings);
}

TEST(TomlSettings, sections_become_dotted_keys_in_the_order_of_their_lines) {
    const Settings settings = settings_from_toml(
        "top = 1\n[z]\nb = 2 # two\r\na = 0x1F\n# remark\n# old = 5\n[a.c]\n\"µ\" = \"° # no\" # yes\nd = {e = -0.0, f "
        "= [true]}\n",
        "");
    EXPECT_EQ(settings, (Settings{{"top", "1"},
                                  {"z.b", "2"},
                                  {"z.a", "0x1F"},
                                  {"old", "5"},
                                  {"a.c.µ", "\"° # no\""},
                                  {"a.c.d.e", "-0.0"},
                                  {"a.c.d.f", "[true]"}}));
}

TEST(TomlSettings, values_of_several_lines_are_spelled_on_one) {
    const Settings settings = settings_from_toml(
        "a.b = \"\"\"one\n# two = 2\n\"three\" \\\\\"\"\"\na.c = [\n  inf, # = x\n  {k = 0.1, l = 2}, 1979-05-27, nan, "
        "3.0\n]\n",
        "");
    ASSERT_EQ(settings.size(), 2u);
    EXPECT_EQ(settings[0].second, "\"one\\u000A# two = 2\\u000A\\\"three\\\" \\\\\"");
    EXPECT_EQ(settings[1].second, "[inf, {\"k\" = 0.1, \"l\" = 2}, 1979-05-27, nan, 3.0]");
}

TEST(TomlSettings, complains_of_what_is_no_toml_with_its_place) {
    expect_contains(
        message_of<FormatError>([] { static_cast<void>(settings_from_toml("a = 1\na = 2\n", "x.h5, /config")); }),
        "x.h5, /config:2:");
    expect_contains(message_of<FormatError>([] {
                        static_cast<void>(settings_to_toml({{"a.b", "1\n"}}));
                    }),
                    "line break");
    expect_contains(message_of<FormatError>([] { static_cast<void>(settings_to_toml({{"a.b", "\xFF"}})); }), "UTF-8");
}
