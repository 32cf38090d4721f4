#pragma once
// A column of times: how many rows a second it says there are, and where rows are missing.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/logs/text_columns.hpp>

namespace zlg::logs {

// The values rise by the same from row to row, or without exception over many rows: as times do, and rates do not.
[[nodiscard]] bool rises_as_time(const LongColumn& values);

struct Hole {
    std::size_t row = 0;  // the last one before it, from 0
    std::int64_t n_missing = 0;
};

struct RowTimes {
    double step = 0.0;       // between neighbours, holes left out, in the column's unit
    double tolerance = 0.0;  // relative, of the step
    std::vector<Hole> holes;
    std::int64_t n_missing = 0;  // in all of them
};

// Empty where the column, recognised by its place or its name, does not rise as times do.
//
// errors  FormatError: a time that is missing or earlier than the one before, in a column that is said to be one; the
// line
//         names the setting that says there is none.
[[nodiscard]] std::optional<RowTimes> row_times(const TextColumn& column, const std::string& path, bool is_said,
                                                const std::string& none = "time_column = 0");

// Whole numbers that rise by 1, or are named as a counter, without a unit in the name: they may merely number the rows.
[[nodiscard]] bool numbers_rows(const TextColumn& column, const RowTimes& times);

// Why these times are not those of so many rows a second; empty where they may be: in the unit that the column's name
// has, or else in seconds or in thousandths, millionths or milliardths of one. Rows that are merely numbered say
// nothing.
[[nodiscard]] std::string contradiction(const TextColumn& column, const RowTimes& times, double rate_hz);

// The unit in which they are, where neither is it in the column's name nor are they seconds; empty else.
[[nodiscard]] std::string presumed_unit(const TextColumn& column, const RowTimes& times, double rate_hz);

// "column 1, 'time', rises by 0.01 a row, which is 100 Hz in seconds".
[[nodiscard]] std::string rate_in_words(const TextColumn& column, const RowTimes& times);

// More rows are missing than may be filled in (budget.hpp): `column` for messages, `values` of it, `if_none` what to
// say if none are missing. errors  FormatError: names the largest jump.
void refuse_many_missing(const std::string& path, const std::string& column, const LongColumn& values,
                         const RowTimes& times, const std::string& if_none);

// Puts NaN where rows are missing.
void fill_holes(LongColumn& values, const RowTimes& times);

}  // namespace zlg::logs
