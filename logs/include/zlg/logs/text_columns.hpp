#pragma once
// Columns of numbers in a plain text file: separated by blanks, or by one of , ; | : / with blanks about it.

#include <cstdint>
#include <string>
#include <vector>

namespace zlg::logs {

struct TextLayout {
    std::vector<std::int64_t> columns;  // first is 1; one or more
    std::string comment = "#";          // lines that begin with it are skipped, as empty ones are
    std::int64_t skip_lines = 0;        // and so many of those that are left
};

// return  one vector per column, as long as each other; NaN where a field is `nan` or empty between separators.
// errors  IoError; FormatError: a line too short, another word than a finite number, no rows.
[[nodiscard]] std::vector<std::vector<double>> read_text_columns(const std::string& path, const TextLayout& layout);

}  // namespace zlg::logs
