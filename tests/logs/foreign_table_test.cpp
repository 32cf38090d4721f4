#include <zlg/logs/foreign_table.hpp>

#include "foreign/units.hpp"
#include "temporary_folder.hpp"
#include "text_table/dates.hpp"

namespace zlg::logs::foreign_table_test {

ForeignTable table_of(const std::string& text) {
    static const test::TemporaryFolder folder;  // the table reads the file again
    const std::string path = folder.write("foreign.csv", text);
    return foreign_table(path, {});
}

TEST(ForeignTable, finds_names_and_units_below_other_lines) {
    const ForeignTable table = table_of("Report of 3 May\nt;w;T\ns;deg/h;C\n0,1;2,5;20\n0,2;2,75;20\n0,3;2,25;21\n");
    ASSERT_EQ(table.columns.size(), 3u);
    EXPECT_EQ(table.columns[0].name, "t [s]");
    EXPECT_EQ(table.columns[1].name, "w [deg/h]");
    EXPECT_EQ(table.read({2}, 1).columns[0].values, (std::vector<double>{2.5, 2.75, 2.25}));
    EXPECT_EQ(column_named(table, "W").number, 2);
    EXPECT_EQ(column_named(table, "w [deg/h]").number, 2);
    EXPECT_THROW((void)column_named(table, "x"), MappingError);
    EXPECT_THROW((void)column_named(table, "4"), MappingError);
}

TEST(ForeignTable, dates_are_seconds_from_the_first) {
    const ForeignTable table =
        table_of("when,w\n2024-02-28 23:59:59.75,1.5\n2024-02-29 00:00:00.00,2.5\n2024-02-29 00:00:00.25,3.5\n");
    ASSERT_TRUE(table.columns[0].holds_dates);
    const std::vector<double> times = table.read({2}, 1).times->values;
    ASSERT_EQ(times.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(times[k], 0.25 * static_cast<double>(k), 1e-15);
}

TEST(Dates, count_seconds_since_1970) {
    EXPECT_EQ(date_time("1970-01-01T00:00:00Z")->seconds, 0);
    EXPECT_EQ(date_time("2000-03-01 00:00:00")->seconds, 951868800);
    EXPECT_EQ(date_time("2026-11-24T00:31:15+01:00")->seconds, 1795476675);
    EXPECT_EQ(date_time("24.11.2026 00:31:15")->seconds, 1795480275);
    EXPECT_DOUBLE_EQ(date_time("12:00:00,125")->fraction, 0.125);
    for (const char* none : {"2026-02-29 00:00:00", "2026-13-01 00:00:00", "11/12/2026 00:00:00", "2026-11-24",
                             "24:00:00", "08:30", "08:30+01:00", "1.5", "", "0.5:3"})
        EXPECT_FALSE(date_time(none)) << none;
}

TEST(Units, are_known_by_many_spellings) {
    for (const char* word : {"deg/h", "\xC2\xB0/h", "DEG/HR", "dph", "deg_h", "deg/hour"})
        EXPECT_EQ(unit_named(word)->arcsec, 1.0) << word;
    EXPECT_NEAR(unit_named("rad/s")->arcsec, 206264.80624709636, 1e-9);
    EXPECT_EQ(unit_in_name("gyro_z_dps")->arcsec, 3600.0);
    EXPECT_EQ(unit_in_name("rate_deg_s")->arcsec, 3600.0);
    EXPECT_EQ(unit_in_name("w (arcsec/s)")->name, "arcsec/s");
    for (const char* none : {"w", "omega", "w [V]", "deg", "temperature_c", "a [m/s]"})
        EXPECT_FALSE(unit_in_name(none)) << none;
}

}  // namespace zlg::logs::foreign_table_test
