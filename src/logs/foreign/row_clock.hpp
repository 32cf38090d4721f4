#pragma once
// How far the rows of a foreign file are apart, and where some are missing.

#include <optional>
#include <string>
#include <vector>

#include <zlg/logs/foreign_table.hpp>
#include <zlg/logs/row_times.hpp>

namespace zlg::logs {

struct RowClock {
    double step_s = 0.0;            // of a row
    std::optional<RowTimes> times;  // with the holes, where a column says where they are
    std::vector<std::string> notes;
    std::vector<std::string> warnings;  // of the times, a line each
};

// The range after which whole numbers or times begin anew, and else rise; 0: they do not. `origin` was taken off them.
[[nodiscard]] double begin_of_range(const LongColumn& values, double origin = 0.0);

// Such values as if their range had no end; returns the range. 0: they have none, and are left.
double go_on(LongColumn& values, double origin = 0.0);

// Makes times that begin anew go on; returns notes.
[[nodiscard]] std::vector<std::string> settle_times(TextTable& read);

// Hours, minutes and seconds in one number: each hole is from a 59th second to a full minute.
//
// errors  FormatError: they are.
void refuse_clock_digits(const TextColumn& times, const RowTimes& found, const std::string& path);

// Of all columns and the times these rows, from 0 and in rising order.
void leave_out(TextTable& read, const std::vector<std::size_t>& rows);

// Leaves out rows that repeat the row before and come far too soon after it; returns what was left out, a line.
//
// errors  FormatError: such rows have other values than the row before.
[[nodiscard]] std::vector<std::string> take_once(TextTable& read, const std::string& path);

// The column that holds the times of the rows, 0: none, or it is open which. By the mapping, by its name, or, without a
// name, as it rises.
[[nodiscard]] std::int64_t time_column(const ForeignTable& table, const Mapping& mapping);

// It is said to hold something else than times.
[[nodiscard]] bool is_said(const ForeignColumn& column, const ForeignTable& table, const Mapping& mapping);

// "time=1|2 or none (columns ...)" where more than one column may hold them, and no name decides; empty else.
[[nodiscard]] std::string open_times(const ForeignTable& table, const Mapping& mapping);

// Of columns that rise, or are named as times or counters, and of which nothing is made, where no other says how far
// the rows are apart: a note each, as they may show rows that are missing.
//
// errors  MappingError: a column is named as times are, does not rise, and nothing is said of it.
[[nodiscard]] std::vector<std::string> unused_times(const ForeignTable& table, const Mapping& mapping);

// What must be given before the step is known, for the user; empty: nothing.
[[nodiscard]] std::string missing_of_clock(const ForeignTable& table, const Mapping& mapping);

// How many of the column's unit make a second; empty: nobody says it. errors  MappingError: its name has two units.
[[nodiscard]] std::optional<double> known_time_unit(const std::string& path, const std::string& name, bool holds_dates,
                                                    const Mapping& mapping);

// "column 1, 't': 3 rows are missing in 2 places, the first after row 7".
[[nodiscard]] std::string missing_in_words(const TextColumn& times, const RowTimes& found);

// `read` is the whole table; presumed_step_s: what else is known of the step, in place of rate_hz.
//
// errors  MappingError: times that contradict what is said; FormatError: times that go back, repeat, or do not say
// where rows are missing.
[[nodiscard]] RowClock row_clock(const TextTable& read, const std::string& path, const Mapping& mapping,
                                 std::optional<double> presumed_step_s);

}  // namespace zlg::logs
