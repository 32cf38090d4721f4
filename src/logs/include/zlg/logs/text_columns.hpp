#pragma once
// Columns of numbers in a plain text file.
//
// Columns are parted by blanks, tabs, semicolons, commas or bars; the decimal mark is a point or a comma. Both are
// recognised together from the first lines, and a file that can be read in two ways is refused. Thousands are not
// parted.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/logs/long_column.hpp>

namespace zlg::logs {

enum class TextSeparator { automatic, blanks, tab, semicolon, comma, bar };
enum class TextMark { automatic, point, comma };

struct TextLayout {
    std::vector<std::int64_t> columns;  // by number from 1; one or more
    std::string comment = "#";          // lines that begin with it are skipped, as empty ones are
    std::int64_t skip_lines = 0;        // and so many of those that are left
    TextSeparator separator = TextSeparator::automatic;
    TextMark mark = TextMark::automatic;
    std::int64_t time_column = 0;      // the number of the one of the times of the rows; 0: there is none
    std::string section = "analysis";  // whose keys `separator`, `decimal`, `skip_lines` messages name
    std::string only_with;             // rows without this word are skipped; empty: none are
    bool is_windows_1251 = false;      // its letters; else UTF-8, or Latin-1 where a line is none
    std::size_t max_rows = 0;          // 0: any number
    std::int64_t max_bytes = 0;        // comments and empty lines with them; 0: any number
};

struct TextColumn {
    std::int64_t number = 0;    // first is 1
    std::string name;           // empty: it has none
    LongColumn values;          // NaN where a field is empty, `nan`, `NA`, `null` or `-1.#IND`
    bool holds_dates = false;   // of times: dates, or times of the day; the values are seconds from the first one on
    bool is_local = false;      // dates of no said time zone
    double other_origin = 0.0;  // with the month before the day, where it may stand there
    double origin = 0.0;        // what was taken off the values, in their unit: of dates the first one, since 1970
};

struct TextTable {
    std::vector<TextColumn> columns;  // those asked for, in that order
    std::optional<TextColumn> times;  // the column of the times of the rows, where one is asked for
};

// A line of words above the numbers is their header; the last comment above them is, where it has as many words.
//
// errors  IoError; FormatError: what the file is, where it is no text; lines that can be read in no way or in two; a
// line
//         with more or fewer fields than the first; no such column; another word than a finite number; no rows.
[[nodiscard]] TextTable read_text_table(const std::string& path, const TextLayout& layout);

// The numbers of the columns asked for alone.
[[nodiscard]] std::vector<std::vector<double>> read_text_columns(const std::string& path, const TextLayout& layout);

// The last byte ends a line, or the file is none that can be looked at twice. A file that was cut off in its last
// number does not end so, and nothing else shows that the number is too short.
[[nodiscard]] bool ends_with_a_line(const std::string& path);

// `column`, by the words for messages: "column 2" or "column 2, 'rate'".
[[nodiscard]] std::string described(const TextColumn& column);

}  // namespace zlg::logs
