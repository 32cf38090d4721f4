#include <zlg/logs/time_check.hpp>

#include "test.hpp"

namespace zlg::logs::time_check_test {

TextTable table_of(std::vector<std::string> names, std::int64_t n_columns, std::vector<double> first) {
    TextTable table;
    table.columns.push_back({.number = 1, .name = names.empty() ? "" : names[0], .values = std::move(first)});
    table.names = std::move(names);
    table.n_columns = n_columns;
    return table;
}

std::string mistaken(const TextTable& table, bool column_is_said = false) {
    return mistaken_times(table, "a.csv", {.columns = {"1"}}, column_is_said, "rate");
}

TEST(TimeCheck, a_column_of_times_that_nobody_asked_for_is_named_with_the_others) {
    const std::vector<double> times{0.0, 0.01, 0.02};
    const std::string head = "analysis.column is not set: a.csv, column 1 rises as times do and is no rate; ";
    EXPECT_EQ(mistaken(table_of({}, 1, times)), head + "analysis.column = 1 if it is, for there is no other");
    EXPECT_EQ(mistaken(table_of({}, 2, times)),
              head + "say which analysis.column it is, of column 2, or 1 if it is that one");
    EXPECT_EQ(mistaken(table_of({}, 5, times)),
              head + "say which analysis.column it is, of columns 2..5, or 1 if it is that one");
    zlg::test::expect_contains(mistaken(table_of({"t", "x", "y"}, 3, times)), "of columns 'x', 'y', or 1");
    EXPECT_EQ(mistaken(table_of({"t", "x"}, 2, times), true), "");
    EXPECT_EQ(mistaken(table_of({}, 2, {5.0, 3.0, 4.0})), "");
}

TEST(TimeCheck, a_contradiction_and_a_presumption_name_the_key) {
    TextTable table = table_of({"x", "time"}, 2, {5.0, 3.0, 4.0});
    table.times = TextColumn{.number = 2, .name = "time", .values = {0.0, 10.0, 20.0}};
    const TextLayout layout{.columns = {"1"}};
    EXPECT_EQ(
        check_times(table, "a.csv", layout, 100.0).presumption,
        "a.csv, column 2, 'time' rises by 10 a row, which is 0.1 Hz in seconds, but analysis.rate_hz = 100: read as "
        "milliseconds, which its name does not say");
    EXPECT_EQ(check_times(table, "a.csv", layout, 0.1).presumption, "");
    EXPECT_EQ(check_times(table, "a.csv", layout, 50.0).contradiction,
              "analysis.rate_hz = 50: a.csv, column 2, 'time' rises by 10 a row, which is 0.1 Hz in seconds; "
              "analysis.time_column = 0 leaves it out");
    EXPECT_FALSE(check_times(table_of({}, 1, {5.0, 3.0, 4.0}), "a.csv", layout, 50.0).times);
}

}  // namespace zlg::logs::time_check_test
