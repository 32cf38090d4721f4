// Layers of a configuration: texts, files and logs, one over the other.
#include "schema_support.hpp"

#include <unistd.h>

namespace zlg::config::schema_layers_test {

using core::BridgeMethod;

TEST(Schema, ALayerChangesOnlyTheKeysItNames) {
    Config c = from_toml("[gyro]\ntick_s = 0.01\nbias_chi = 2\n");
    apply_toml(c, "[gyro]\ntick_s = 0.02\n", "second.toml");
    EXPECT_EQ(c.gyro.tick_s, 0.02);
    EXPECT_EQ(c.gyro.bias_chi, 2.0);
    EXPECT_EQ(c.gyro.scale_arcsec, Config{}.gyro.scale_arcsec);
}

TEST(Schema, ALayerWithAnErrorChangesNothing) {
    Config c;
    EXPECT_THROW(apply_toml(c, "[gyro]\nbias_chi = 2\ntick_s = -1\n", "lab.toml"), ConfigError);
    EXPECT_EQ(to_settings(c), to_settings(Config{}));
}

TEST(Schema, ALogGivesTheSettingsOfOurSectionsOnly) {
    Config c;
    apply_log(
        c,
        {{"gyro.tick_s", "0.01"}, {"flags", "switching:1"}, {"lab.operator", "Ann"}, {"compensation.bridge", "linear"}},
        "raw.csv");
    EXPECT_EQ(c.gyro.tick_s, 0.01);
    EXPECT_EQ(c.compensation.bridge, BridgeMethod::linear);
    EXPECT_EQ(complaint([&] {
                  apply_log(c, {{"gyro.tik_s", "1"}}, "raw.csv");
              }),
              "raw.csv: unknown key [gyro] tik_s; did you mean tick_s?");
}

TEST(Schema, OnlyTickAndScaleConflictWithALog) {
    const Settings log{{"gyro.tick_s", "0.01"}, {"gyro.scale_arcsec", "2"}, {"gyro.bias_hz", "5e4"}};
    Config c;
    apply_log(c, log, "raw.csv");
    EXPECT_NO_THROW(check_against_log(c, log, "raw.csv"));
    apply_set(c, "gyro.bias_hz=7e4");
    apply_set(c, "gyro.tick_s=1e-2");
    EXPECT_NO_THROW(check_against_log(c, log, "raw.csv"));
    Config other_tick = c;
    apply_set(other_tick, "gyro.tick_s=0.005");
    expect_contains(complaint([&] { check_against_log(other_tick, log, "raw.csv"); }),
                    "gyro.tick_s = 0.005: raw.csv was recorded with 0.01");
    Config other_scale = c;
    apply_set(other_scale, "gyro.scale_arcsec=3");
    expect_contains(complaint([&] { check_against_log(other_scale, log, "raw.csv"); }), "gyro.scale_arcsec = 3");
    EXPECT_NO_THROW(check_against_log(other_scale, {}, "raw.csv")) << "a log without settings conflicts with nothing";
}

TEST(Schema, AFileIsReadOrItsFailureTold) {
    const auto path =
        std::filesystem::temp_directory_path() / ("zlg-schema-test-" + std::to_string(::getpid()) + ".toml");
    std::ofstream{path} << "[gyro]\ntick_s = 0.01\n";
    Config c;
    apply_file(c, path);
    EXPECT_EQ(c.gyro.tick_s, 0.01);
    std::ofstream{path} << "[gyro]\ntick_s = -1\n";
    expect_contains(complaint([&] { apply_file(c, path); }), path.string() + ":2: gyro.tick_s = -1");
    std::ofstream{path} << "";
    EXPECT_NO_THROW(apply_file(c, path));
    std::filesystem::remove(path);
    expect_contains(complaint([&] { apply_file(c, path); }), "No such file");
    expect_contains(complaint([&] { apply_file(c, path.parent_path()); }), "it is a folder");
}

}  // namespace zlg::config::schema_layers_test
