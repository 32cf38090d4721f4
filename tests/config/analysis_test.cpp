#include <zlg/config/schema.hpp>

#include <fmt/format.h>

#include "test.hpp"

namespace zlg::config::analysis_test {

TEST(AnalysisConfig, is_set_by_name) {
    Config c;
    apply_set(c, "analysis.deviations=[\"mdev\", \"tdev\"]");
    apply_set(c, "analysis.unit=rad/s");
    apply_set(c, "analysis.taus_s=[1, 10]");
    apply_set(c, "analysis.table_earth_arcsec_s=-8.5");
    EXPECT_EQ(c.analysis.table_earth_arcsec_s, -8.5);
    EXPECT_EQ(c.analysis.deviations, (std::vector<Deviation>{Deviation::mdev, Deviation::tdev}));
    EXPECT_EQ(c.analysis.unit, ShownRate::rad_s);
    EXPECT_NO_THROW(check(c));
}

TEST(MotionConfig, a_column_has_a_number_or_a_name) {
    Config c;
    for (const char* wrong : {"1.5", "0", "-3", "1000001", "true"})
        EXPECT_THROW(apply_set(c, std::string{"motion.column="} + wrong), ConfigError) << wrong;
    apply_set(c, "motion.time_column=0");
    apply_set(c, "motion.column=gyro_z_dps");
    EXPECT_EQ(c.motion.column, "gyro_z_dps");
    Config again;
    apply_toml(again, to_toml(c), "text");
    EXPECT_EQ(again.motion.time_column, "0");
    EXPECT_EQ(again.motion.column, c.motion.column);
}

TEST(AnalysisConfig, what_a_file_holds_is_said_by_its_mapping) {
    Config c;
    for (const char* gone : {"column", "column_holds", "scale_arcsec", "rate_hz", "comment", "skip_lines", "separator",
                             "decimal", "time_column", "table_column", "table_scale_arcsec_s"}) {
        const std::string why =
            zlg::test::refusal_by<ConfigError>([&] { apply_set(c, fmt::format("analysis.{}=1", gone)); });
        EXPECT_NE(why.find("--map"), std::string::npos) << why;
    }
}

TEST(AnalysisConfig, other_numbers_have_their_ranges) {
    Config c;
    EXPECT_THROW(apply_set(c, "analysis.confidence=1"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.confidence=0.9999999999999999"), ConfigError);
    EXPECT_NO_THROW(apply_set(c, "analysis.confidence=0.999999"));
    EXPECT_THROW(apply_set(c, "analysis.table_settling_s=-1"), ConfigError);
}

}  // namespace zlg::config::analysis_test
