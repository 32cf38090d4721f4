#include <gtest/gtest.h>

#include <zlg/config/log_settings.hpp>

namespace zlg::config {
namespace {

TEST(LogSettings, ALogMayNameItsTickAndScaleWithoutASection) {
    EXPECT_EQ(checked_log_settings({{"tick_s", "0.005"}, {"scale_arcsec", "3"}, {"note", "x"}}, "log"),
              (Settings{{"gyro.tick_s", "0.005"}, {"gyro.scale_arcsec", "3"}, {"note", "x"}}));
}

TEST(LogSettings, OnlyOurKeysAreComparedAndByTheirValues) {
    const auto passes = [](const Settings& settings) {
        try {
            (void)checked_log_settings(settings, "log");
            return true;
        } catch (const ConfigError&) {
            return false;
        }
    };
    EXPECT_TRUE(passes({{"note", "a"}, {"note", "b"}, {"operator.name", "a"}, {"operator.name", "b"}}));
    EXPECT_TRUE(passes({{"tick_s", "0.005"}, {"gyro.tick_s", "0.0050"}, {"gyro.tick_s", "5e-3"}}));
    EXPECT_TRUE(passes({{"motion.frequency_hz", "2"}, {"motion.frequency_hz", "[2.0]"}}));
    EXPECT_FALSE(passes({{"tick_s", "0.005"}, {"gyro.tick_s", "0.00501"}}));
    EXPECT_FALSE(passes({{"motion.kind", "'rest'"}, {"motion.kind", "'sine'"}}));
    EXPECT_FALSE(passes({{"gyr.tick_s", "0.005"}}));
}

}  // namespace
}  // namespace zlg::config
