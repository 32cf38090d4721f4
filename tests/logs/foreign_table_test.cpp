#include <zlg/logs/foreign_table.hpp>

#include <cmath>

#include "foreign/row_clock.hpp"
#include "foreign/units.hpp"
#include "temporary_folder.hpp"
#include "text_table/dates.hpp"
#include "text_table/time_names.hpp"

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
    EXPECT_EQ(table.read({2}, 1).columns[0].values.vector(), (std::vector<double>{2.5, 2.75, 2.25}));
    EXPECT_EQ(column_named(table, "W").number, 2);
    EXPECT_EQ(column_named(table, "w [deg/h]").number, 2);
    EXPECT_THROW((void)column_named(table, "x"), MappingError);
    EXPECT_THROW((void)column_named(table, "4"), MappingError);
}

TEST(ForeignTable, dates_are_seconds_from_the_first) {
    const ForeignTable table =
        table_of("when,w\n2024-02-28 23:59:59.75,1.5\n2024-02-29 00:00:00.00,2.5\n2024-02-29 00:00:00.25,3.5\n");
    ASSERT_TRUE(table.columns[0].holds_dates);
    const std::vector<double> times = table.read({2}, 1).times->values.vector();
    ASSERT_EQ(times.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(times[k], 0.25 * static_cast<double>(k), 1e-15);
}

TEST(Dates, count_seconds_since_1970) {
    EXPECT_EQ(date_time("1970-01-01T00:00:00Z")->seconds, 0);
    EXPECT_EQ(date_time("2000-03-01 00:00:00")->seconds, 951868800);
    EXPECT_EQ(date_time("2026-11-24T00:31:15+01:00")->seconds, 1795476675);
    EXPECT_EQ(date_time("24.11.2026 00:31:15")->seconds, 1795480275);
    EXPECT_DOUBLE_EQ(date_time("12:00:00,125")->fraction, 0.125);
    EXPECT_EQ(date_time("24/11/2026 00:31:15")->seconds, 1795480275);
    EXPECT_EQ(date_time("11/24/2026 12:31:15 AM")->seconds, 1795480275);
    EXPECT_EQ(date_time("11/24/2026 0:31:15")->seconds, 1795480275);
    EXPECT_EQ(date_time("2:41:45.5 PM")->seconds, 14 * 3600 + 41 * 60 + 45);
    EXPECT_EQ(date_time("29:45.6")->seconds, 29 * 60 + 45);
    for (const char* none :
         {"13:00:00 PM", "0:30:00 AM", "31/02/2026 00:00:00", "13/13/2026 00:00:00", "2026-02-29 00:00:00",
          "2026-13-01 00:00:00", "2026-11-24", "24:00:00", "08:30", "08:30+01:00", "1.5", "", "0.5:3"})
        EXPECT_FALSE(date_time(none)) << none;
}

// 1 March to 2 March in either order, and a month's first day in neither.
TEST(Dates, day_and_month_follow_from_the_rows_that_follow) {
    for (const bool month_first : {false, true}) {
        Dates dates;
        std::vector<double> seconds;
        for (const char* time : {"23:59:59", "00:00:00", "00:00:01"}) {
            const char* const day = seconds.empty() ? "01" : "02";
            const std::string date = month_first ? std::string{"03/"} + day : day + std::string{"/03"};
            seconds.push_back(dates.since_first(date_time(date + "/2026 " + time).value()));
        }
        EXPECT_EQ(seconds, (std::vector<double>{0.0, 1.0, 2.0})) << month_first;
    }
}

TEST(Counters, go_on_where_they_begin_anew) {
    for (const double range : {128.0, 256.0, 65536.0, 1e4, 360.0, 604800.0, 4294967296.0}) {
        std::vector<double> counter, line;
        for (int k = 0; k < 400; ++k) {
            if (k == 200) continue;  // a row that is missing
            line.push_back(range - 100.0 + k);
            counter.push_back(std::fmod(line.back(), range));
        }
        EXPECT_EQ(begin_of_range(counter), range);
        LongColumn gone_on = counter;
        EXPECT_EQ(go_on(gone_on), range);
        EXPECT_EQ(gone_on.vector(), line);
    }
    // A record that was begun anew, noise, and what swings.
    EXPECT_EQ(begin_of_range(std::vector<double>{5, 6, 7, 8, 9, 0, 1, 2, 3, 4}), 0.0);
    EXPECT_EQ(begin_of_range(std::vector<double>{1, 3, 2, 4, 3, 5, 1, 2, 0, 4}), 0.0);
    EXPECT_EQ(begin_of_range(std::vector<double>{0, 1, 2, 3, 2, 1, 0, 1, 2, 3}), 0.0);
}

TEST(Names, of_times_and_counters) {
    for (const char* name : {"t", "data.t", "meas/t", "DAQ/time_ns", "header.stamp", "Zeit [s]", "MJD", "millis",
                             "\u0412\u0440\u0435\u043c\u044f, \u0441", "TimeStamp"})
        EXPECT_TRUE(names_time(name)) << name;
    for (const char* name : {"T", "t [C]", "rate", "angular_velocity.z", "gyro.x"})
        EXPECT_FALSE(names_time(name)) << name;
    for (const char* name : {"SampleTimeFine", "GPS TOW", "Shimmer_Timestamp_Unix_CAL", "seconds_elapsed"})
        EXPECT_TRUE(mentions_time(name)) << name;
    for (const char* name : {"PacketCounter", "field.header.seq", "loopIteration", "n"})
        EXPECT_TRUE(names_counter(name)) << name;
    EXPECT_EQ(unit_of("DAQ/time_ns"), 1e9);
    EXPECT_EQ(unit_of("\u0412\u0440\u0435\u043c\u044f, \u0441"), 1.0);
    EXPECT_EQ(unit_of("MJD"), 1.0 / 86400.0);
    EXPECT_EQ(unit_of("SampleTimeFine"), std::nullopt);
}

TEST(Units, are_known_by_many_spellings) {
    const std::vector<std::pair<const char*, const char*>> spellings{{"rad s^-1", "rad/s"},
                                                                     {"deg.s-1", "deg/s"},
                                                                     {"degrees per second", "deg/s"},
                                                                     {"\xC2\xBA/s", "deg/s"},
                                                                     {"\"/s", "arcsec/s"},
                                                                     {"nrad/s", "nrad/s"},
                                                                     {"Hz", "Hz"},
                                                                     {"Grad/s", "deg/s"},
                                                                     {"\u0433\u0440\u0430\u0434/\u0447", "deg/h"},
                                                                     {"\u0440\u0430\u0434/\u0441", "rad/s"},
                                                                     {"\u0443\u0433\u043b.\u0441/\u0441", "arcsec/s"},
                                                                     {"\xC2\xB0/\u0447", "deg/h"}};
    for (const auto& [word, name] : spellings) {
        ASSERT_TRUE(unit_named(word)) << word;
        EXPECT_EQ(unit_named(word)->name, name) << word;
    }
    EXPECT_EQ(unit_in_name("f [Hz]"), std::nullopt);  // of whatever
    EXPECT_EQ(unit_in_name("w_z [rad s^-1]")->name, "rad/s");
    for (const char* word : {"deg/h", "\xC2\xB0/h", "DEG/HR", "dph", "deg_h", "deg/hour"})
        EXPECT_EQ(unit_named(word)->arcsec, 1.0) << word;
    EXPECT_NEAR(unit_named("rad/s")->arcsec, 206264.80624709636, 1e-9);
    EXPECT_EQ(unit_in_name("gyro_z_dps")->arcsec, 3600.0);
    EXPECT_EQ(unit_in_name("rate_deg_s")->arcsec, 3600.0);
    EXPECT_EQ(unit_in_name("w (arcsec/s)")->name, "arcsec/s");
    for (const char* none : {"w", "omega", "w [V]", "deg", "temperature_c", "a [m/s]", "wz\xC2\xB2 [deg/s]"})
        EXPECT_FALSE(unit_in_name(none)) << none;
}

}  // namespace zlg::logs::foreign_table_test
