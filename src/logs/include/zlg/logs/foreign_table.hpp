#pragma once
// A file of another program as a table of columns: text, HDF5, MATLAB, NumPy, doubles without a header,
// an IMU of a bag.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <zlg/logs/mapping.hpp>
#include <zlg/logs/text_columns.hpp>

namespace zlg::logs {

// Of a column of words so many different ones are kept.
inline constexpr std::size_t most_words = 17;

struct ForeignColumn {
    std::int64_t number = 0;   // first is 1
    std::string name;          // with the unit behind it in brackets, where the file says one; empty: it has none
    bool is_number = true;     // or dates, or empty fields; else words
    bool is_part = false;      // of a time whose seconds and nanoseconds stand in two columns
    bool holds_dates = false;  // or times of the day: the values are seconds from the first one on
    std::string first;         // value, as it stands in the file
    std::vector<std::string> words{};   // of a column of words the first different ones
    std::vector<std::int64_t> kinds{};  // of the first rows which of these
    std::string word;  // where the first one stands among more numbers: "v.csv:51, column 2: 'OVF'"; empty: none does
    std::vector<double> values;  // of the first rows; NaN where one is missing
};

struct ForeignTable {
    std::string path;
    std::string nature;  // what the file is and how it was read
    std::vector<ForeignColumn> columns;
    std::vector<std::string> notes;      // of what was left out
    std::vector<std::string> head{};     // lines of text above the names of the columns
    std::optional<std::int64_t> n_rows;  // text: not known before it is read
    // Whole columns, and the times of the rows where a column is said to hold them.
    std::function<TextTable(const std::vector<std::int64_t>& wanted, std::int64_t times)> read;
};

// errors  IoError; FormatError: the file cannot be read as a table; MappingError: more than one table, or more than one
// way to read it; the line names the key that decides.
[[nodiscard]] ForeignTable foreign_table(const std::string& path, const Mapping& mapping);

// By number or by name, in any case of its letters, with or without its unit.
//
// errors  MappingError: there is none, or more than one.
[[nodiscard]] const ForeignColumn& column_named(const ForeignTable& table, const std::string& name);

// errors  FormatError: a word stands among its numbers.
void refuse_words(const ForeignColumn& column);

// "column 2, 'rate [deg/s]'".
[[nodiscard]] std::string described(const ForeignColumn& column);

}  // namespace zlg::logs
