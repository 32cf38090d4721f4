#pragma once
// Whether the column that is read holds times, and what the times of the rows say of the rows per second. The words are
// for the program's messages; who calls decides what is refused.

#include <optional>
#include <string>

#include <zlg/logs/row_times.hpp>
#include <zlg/logs/text_columns.hpp>

namespace zlg::logs {

// Why the first column is not read: nobody asked for it, and it holds times by its name or by how it rises. Empty: it
// is.
[[nodiscard]] std::string mistaken_times(const TextTable& table, const std::string& path, const TextLayout& layout,
                                         bool column_is_said, const std::string& noun);

struct TimeCheck {
    std::optional<RowTimes> times;
    std::string contradiction;  // empty: none
    std::string presumption;    // of another unit than seconds, which no name says; empty: none
};

// errors  FormatError: as row_times().
[[nodiscard]] TimeCheck check_times(const TextTable& table, const std::string& path, const TextLayout& layout,
                                    std::optional<double> rate_hz);

// "a.csv, column 1, 't': 3 rows are missing in 2 places, the first after row 7".
[[nodiscard]] std::string missing_in_words(const TextTable& table, const std::string& path, const RowTimes& times);

}  // namespace zlg::logs
