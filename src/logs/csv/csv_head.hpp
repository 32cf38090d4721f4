#pragma once
// What stands above the rows of a CSV log: lines `# key = value`, then one line of column names.

#include <string>
#include <vector>

#include <zlg/logs/settings.hpp>

#include "line_reader.hpp"

namespace zlg::logs {

struct CsvHead {
    Settings settings;               // in their order; other lines that begin with # are ignored
    std::vector<std::string> names;  // of the columns, without surrounding blanks and quotes
    char separator = ',';            // that parts them: , ; | tab, or ' ' for any run of blanks
};

// errors  FormatError: the file is empty, no line of names, numbers in its place, a nameless column.
[[nodiscard]] CsvHead read_head(LineReader& lines);

}  // namespace zlg::logs
