#include <gtest/gtest.h>

#include <zlg/config/analysis.hpp>
#include <zlg/config/schema.hpp>

namespace {

using namespace zlg::config;

TEST(AnalysisConfig, nothing_is_presumed_of_a_text_file) {
    const Config c;
    EXPECT_FALSE(c.analysis.column_holds);
    EXPECT_FALSE(c.analysis.rate_hz);
    EXPECT_FALSE(c.analysis.latitude_deg);
}

TEST(AnalysisConfig, is_set_by_name) {
    Config c;
    apply_set(c, "analysis.deviations=[\"mdev\", \"tdev\"]");
    apply_set(c, "analysis.column=[1, 3]");
    apply_set(c, "analysis.column_holds=phase");
    apply_set(c, "analysis.unit=rad/s");
    apply_set(c, "analysis.taus_s=[1, 10]");
    apply_set(c, "analysis.table_same_rate_ratio=0.01");
    apply_set(c, "analysis.table_earth_arcsec_s=-8.5");
    EXPECT_EQ(c.analysis.table_same_rate_ratio, 0.01);
    EXPECT_EQ(c.analysis.table_earth_arcsec_s, -8.5);
    EXPECT_EQ(c.analysis.deviations, (std::vector<Deviation>{Deviation::mdev, Deviation::tdev}));
    EXPECT_EQ(c.analysis.column, (std::vector<double>{1.0, 3.0}));
    EXPECT_EQ(c.analysis.column_holds, TextHolds::phase);
    EXPECT_EQ(c.analysis.unit, ShownRate::rad_s);
    EXPECT_NO_THROW(check(c));
}

TEST(AnalysisConfig, columns_are_whole_numbers) {
    Config c;
    apply_set(c, "analysis.column=1.5");
    EXPECT_THROW(check(c), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.column=0"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.confidence=1"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.confidence=0.9999999999999999"), ConfigError);
    EXPECT_NO_THROW(apply_set(c, "analysis.confidence=0.999999"));
    EXPECT_THROW(apply_set(c, "analysis.table_same_rate_ratio=-1"), ConfigError);
    EXPECT_THROW(apply_set(c, "analysis.latitude_deg=91"), ConfigError);
}

}  // namespace
