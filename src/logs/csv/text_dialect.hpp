#pragma once
// How a text file writes its table: what parts the columns and what the fraction, recognised together from its first lines.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/logs/text_columns.hpp>

#include "text_fields.hpp"

namespace zlg::logs {

struct Line {
    std::int64_t number = 0;
    std::string text;
};

// What stands at the head of a file, comments and lines to skip left out.
struct Sample {
    std::vector<Line> lines;
    std::string comment;        // the last one above the first line, without its mark
    bool is_whole = false;      // the file has no more lines
    bool is_terminated = true;  // its last line has an end
};

struct Dialect {
    char separator = blanks_separator;
    Mark mark = Mark::none;     // none: no line of the sample shows it
    bool mark_is_sure = false;  // said, or shown by a number whose mark can part no thousands
    std::size_t n_fields = 0;
    bool has_header = false;          // the first line of the sample
    std::vector<std::string> names;   // of the columns; empty where they have none
    std::vector<std::size_t> wanted;  // fields that are asked for, from 0
};

// errors  FormatError: no way to read the lines as a table, or more than one; both are named, with the keys that decide.
[[nodiscard]] Dialect recognise_dialect(const Sample& sample, const std::string& path, const TextLayout& layout);

// The field of a column that is asked for by number or name.
//
// errors  FormatError: no such column; the nearest name is named.
[[nodiscard]] std::size_t field_of(const std::string& column, const Dialect& dialect, const std::string& path);

}  // namespace zlg::logs
