#pragma once
// What parts the columns of a text file and what the fraction, recognised together from its first lines.

#include <string>

#include <zlg/logs/text_columns.hpp>

#include "text_dialect.hpp"

namespace zlg::logs {

// What stands at the head of a file, below comments and lines to skip.
//
// errors  IoError, FormatError.
[[nodiscard]] FirstLines first_lines_of(const std::string& path, const TextLayout& layout);

// errors  FormatError: no way to read the lines as a table, or more than one; both are named, with the keys that decide.
[[nodiscard]] Dialect recognise_dialect(const FirstLines& sample, const std::string& path, const TextLayout& layout);

}  // namespace zlg::logs
