#pragma once
// The first lines of a file, read in one way.

#include <string>
#include <string_view>
#include <vector>

#include <zlg/logs/text_columns.hpp>

#include "parted_lines.hpp"
#include "text_dialect.hpp"

namespace zlg::logs {

// How far a way of reading comes; the farthest says what is wrong.
enum class Verdict { ragged, wrong_header, broken_field, no_such_column, not_numbers, good };

struct Reading {
    Dialect dialect;
    Verdict verdict = Verdict::good;
    std::string reason;
    bool is_cut = false;  // but for the last line, which has no end
    bool names_hold_commas = false;
};

// The lines with that separator and that mark. It never fails: the verdict says how far it came, the reason what is
// wrong.
[[nodiscard]] Reading read_as(char separator, Mark mark, PartedLines& lines, const std::string& path,
                              const TextLayout& layout);

// Columns of a good reading.
struct AskedFor {
    Verdict verdict = Verdict::good;
    std::string reason;
    std::vector<std::size_t> fields;  // from 0
    std::vector<double> values;       // row by row
};

// Never fails either.
[[nodiscard]] AskedFor ask_for(const std::vector<std::string>& columns, const Reading& reading, PartedLines& lines,
                               const std::string& path, const TextLayout& layout);

// The field of a column that is asked for by number or name.
//
// errors  FormatError: no such column; the nearest name is named.
[[nodiscard]] std::size_t field_of(const std::string& column, const Dialect& dialect, const std::string& path);

// As much of a line as a message holds.
[[nodiscard]] std::string shown(std::string_view line);

}  // namespace zlg::logs
