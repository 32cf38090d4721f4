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
};

// The column that holds the times of the rows, 0: none, or it is open which. By the mapping, by its name, or, without a
// name, as it rises.
[[nodiscard]] std::int64_t time_column(const ForeignTable& table, const Mapping& mapping);

// "time=1|2 or none (columns ...)" where more than one column may hold them, and no name decides; empty else.
[[nodiscard]] std::string open_times(const ForeignTable& table, const Mapping& mapping);

// errors  MappingError: a column is named as times are, is not taken for them, and nothing is said of it.
void refuse_unused_times(const ForeignTable& table, const Mapping& mapping);

// What must be given before the step is known, for the user; empty: nothing.
[[nodiscard]] std::string missing_of_clock(const ForeignTable& table, const Mapping& mapping);

// How many of the column's unit make a second; empty: nobody says it. errors  MappingError: its name has two units.
[[nodiscard]] std::optional<double> known_time_unit(const std::string& path, const std::string& name, bool holds_dates,
                                                    const Mapping& mapping);

// `read` is the whole table; presumed_step_s: what else is known of the step, in place of rate_hz.
//
// errors  MappingError: times that contradict what is said; FormatError: times that go back, repeat, or do not say
// where rows are missing.
[[nodiscard]] RowClock row_clock(const TextTable& read, const std::string& path, const Mapping& mapping,
                                 std::optional<double> presumed_step_s);

}  // namespace zlg::logs
