#include <zlg/config/analysis.hpp>
#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::config::analysis_test {

TEST(AnalysisConfig, nothing_is_presumed_of_a_text_file) {
    const Config c;
    EXPECT_FALSE(c.analysis.column_holds);
    EXPECT_FALSE(c.analysis.rate_hz);
}

TEST(AnalysisConfig, is_set_by_name) {
    Config c;
    apply_set(c, "analysis.deviations=[\"mdev\", \"tdev\"]");
    apply_set(c, "analysis.column=[1, 3]");
    apply_set(c, "analysis.column_holds=phase");
    apply_set(c, "analysis.unit=rad/s");
    apply_set(c, "analysis.taus_s=[1, 10]");
    apply_set(c, "analysis.table_earth_arcsec_s=-8.5");
    EXPECT_EQ(c.analysis.table_earth_arcsec_s, -8.5);
    EXPECT_EQ(c.analysis.deviations, (std::vector<Deviation>{Deviation::mdev, Deviation::tdev}));
    EXPECT_EQ(c.analysis.column, (std::vector<std::string>{"1", "3"}));
    EXPECT_EQ(c.analysis.column_holds, TextHolds::phase);
    EXPECT_EQ(c.analysis.unit, ShownRate::rad_s);
    EXPECT_NO_THROW(check(c));
}

TEST(AnalysisConfig, columns_have_a_number_or_a_name) {
    Config c;
    EXPECT_THROW(apply_set(c, "analysis.column=1.5"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.column=0"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.column=-3"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.column=1000001"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.column=true"), ConfigError);
    EXPECT_THROW(apply_set(c, "motion.column=0"), ConfigError);
    apply_set(c, "analysis.column=[2.0, \"gyro z\"]");
    EXPECT_EQ(c.analysis.column, (std::vector<std::string>{"2", "gyro z"}));
    apply_set(c, "analysis.time_column=0");
    apply_set(c, "motion.column=gyro_z_dps");
    EXPECT_EQ(c.motion.column, "gyro_z_dps");
    Config again;
    apply_toml(again, to_toml(c), "text");
    EXPECT_EQ(again.analysis.column, c.analysis.column);
    EXPECT_EQ(again.analysis.time_column, "0");
    EXPECT_EQ(again.motion.column, c.motion.column);
}

TEST(AnalysisConfig, other_numbers_have_their_ranges) {
    Config c;
    EXPECT_THROW(apply_set(c, "analysis.confidence=1"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.confidence=0.9999999999999999"), ConfigError);
    EXPECT_NO_THROW(apply_set(c, "analysis.confidence=0.999999"));
    EXPECT_THROW(apply_set(c, "analysis.table_settling_s=-1"), ConfigError);
}

}  // namespace zlg::config::analysis_test
