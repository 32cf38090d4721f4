#include <zlg/logs/error.hpp>
#include <zlg/logs/row_times.hpp>

#include "test.hpp"
#include "text_table/time_names.hpp"

namespace zlg::logs::row_times_test {

std::vector<double> stamps(std::size_t n, double step) {
    std::vector<double> values;
    for (std::size_t k = 0; k < n; ++k) values.push_back(100.0 + step * static_cast<double>(k));
    return values;
}

TextColumn named(const char* name, std::vector<double> values) {
    return {.number = 1, .name = name, .values = std::move(values)};
}

TEST(RowTimes, names_of_times_are_known) {
    for (const char* name : {"time", "Time (s)", "t", "t_s", "time[ms]", "Zeit", "TimeStamp", "TOW"})
        EXPECT_TRUE(names_time(name)) << name;
    for (const char* name : {"", "temp", "rate", "theta", "tick", "T", "T_c", "t [C]", "gyro_t", "timer"})
        EXPECT_FALSE(names_time(name)) << name;
}

TEST(RowTimes, what_rises_evenly_or_always_rises_as_times_do) {
    EXPECT_TRUE(rises_as_time(stamps(5, 0.01)));
    EXPECT_TRUE(rises_as_time(stamps(5, 1.0)));
    std::vector<double> jittering = stamps(40, 1.0);
    for (std::size_t k = 0; k < 40; ++k) jittering[k] += 0.4 * std::sin(7.0 * static_cast<double>(k));
    EXPECT_TRUE(rises_as_time(jittering));
    std::vector<double> wrapped = stamps(40, 1.0);
    for (std::size_t k = 25; k < 40; ++k) wrapped[k] -= 125.0;
    EXPECT_TRUE(rises_as_time(wrapped));
    EXPECT_FALSE(rises_as_time(std::vector<double>(20, 5.0)));
    EXPECT_FALSE(rises_as_time(std::vector<double>{1.0, 2.0, 4.0}));
    EXPECT_FALSE(rises_as_time(std::vector<double>{1.0, 2.0}));
    EXPECT_FALSE(rises_as_time(std::vector<double>{3.0, 2.0, 1.0}));
    EXPECT_FALSE(rises_as_time(std::vector<double>{1.0, std::numeric_limits<double>::quiet_NaN(), 3.0}));
}

TEST(RowTimes, rows_that_are_missing_are_found_and_filled) {
    std::vector<double> values = stamps(30, 0.01);
    for (std::size_t k = 10; k < 30; ++k) values[k] += 0.05;
    for (std::size_t k = 20; k < 30; ++k) values[k] += 0.01;
    const auto times = row_times(named("time", values), "a.csv", false);
    ASSERT_TRUE(times);
    EXPECT_NEAR(times->step, 0.01, 1e-12);
    ASSERT_EQ(times->holes.size(), 2u);
    EXPECT_EQ(times->holes[0].row, 9u);
    EXPECT_EQ(times->n_missing, 6);
    LongColumn rates = std::vector<double>(30, 1.0);
    fill_holes(rates, *times);
    ASSERT_EQ(rates.size(), 36u);
    for (std::size_t k = 10; k < 15; ++k) EXPECT_TRUE(std::isnan(rates[k]));
    EXPECT_TRUE(std::isnan(rates[25]));
    EXPECT_EQ(rates[24], 1.0);
}

TEST(RowTimes, a_late_stamp_and_coarse_stamps_are_no_holes) {
    std::vector<double> late = stamps(30, 1.0);
    late[12] += 0.7;
    EXPECT_EQ(row_times(named("t", late), "a.csv", false)->n_missing, 0);
    std::vector<double> coarse;
    for (int k = 0; k < 300; ++k) coarse.push_back(std::floor(k / 3.0 + 1e-9) * 0.001);
    const TextColumn column = named("t_s", coarse);
    const auto times = row_times(column, "a.csv", false);
    EXPECT_EQ(times->n_missing, 0);
    EXPECT_EQ(contradiction(column, *times, 3000.0), "");
    EXPECT_NE(contradiction(column, *times, 1000.0), "");
}

TEST(RowTimes, a_rate_that_they_contradict_is_named_with_both) {
    const auto said = [](const char* name, double step, double rate_hz) {
        const TextColumn column = named(name, stamps(50, step));
        return contradiction(column, *row_times(column, "a.csv", false), rate_hz);
    };
    EXPECT_EQ(said("time", 0.01, 100.0), "");
    EXPECT_EQ(said("time", 10.0, 100.0), "") << "milliseconds";
    EXPECT_EQ(said("time_ms", 10.0, 100.0), "");
    EXPECT_EQ(said("time", 1.0, 100.0), "") << "rows that are numbered";
    EXPECT_EQ(said("time", 0.01, 200.0), "column 1, 'time' rises by 0.01 a row, which is 100 Hz in seconds");
    EXPECT_EQ(said("time_s", 1.0, 100.0), "column 1, 'time_s' rises by 1 a row, which is 1 Hz");
    EXPECT_NE(said("time_s", 10.0, 100.0), "");
    EXPECT_NE(said("", 0.01, 101.0), "");
}

TEST(RowTimes, a_unit_that_no_name_says_is_named_unless_it_is_seconds) {
    const auto presumed = [](const char* name, double step, double rate_hz) {
        const TextColumn column = named(name, stamps(50, step));
        return presumed_unit(column, *row_times(column, "a.csv", false), rate_hz);
    };
    EXPECT_EQ(presumed("time", 0.01, 100.0), "");
    EXPECT_EQ(presumed("time", 10.0, 100.0), "milliseconds");
    EXPECT_EQ(presumed("", 0.01, 1e5), "milliseconds") << "or seconds, and a rate wrong by 1000";
    EXPECT_EQ(presumed("time", 1e4, 100.0), "microseconds");
    EXPECT_EQ(presumed("time", 1e7, 100.0), "nanoseconds");
    EXPECT_EQ(presumed("time_ms", 10.0, 100.0), "");
    EXPECT_EQ(presumed("time", 1.0, 1000.0), "") << "rows that are numbered";
}

TEST(RowTimes, what_does_not_rise_is_no_column_of_times_unless_it_is_asked_for_as_one) {
    EXPECT_FALSE(row_times(named("", {3.0, 1.0, 2.0, 5.0}), "a.csv", false));
    EXPECT_FALSE(row_times(named("rate", {1.0, 2.0, 5.0, 6.0}), "a.csv", false));
    for (const char* name : {"time", "t_min", "time_bias"})
        EXPECT_FALSE(row_times(named(name, {3.0, 1.0, 2.0}), "a.csv", false)) << name;
    EXPECT_THROW((void)row_times(named("time", {3.0, 1.0, 2.0}), "a.csv", true), FormatError);
    EXPECT_THROW((void)row_times(named("", {3.0, 1.0, 2.0}), "a.csv", true), FormatError);
}

}  // namespace zlg::logs::row_times_test
