#pragma once
// Commas and blanks that part columns, or fractions and thousands as well.

#include <cstddef>
#include <optional>

#include "parted_lines.hpp"

namespace zlg::logs {

// The first column, from 0, that may be the fraction of the number before it in every row, where nothing in the sample
// shows the opposite: neither a header that names it, nor numbers with points beside them.
[[nodiscard]] std::optional<std::size_t> likely_fraction(PartedLines& lines, const Dialect& dialect);

// The first column, from 0, that may be the thousands of the number behind it in every row.
[[nodiscard]] std::optional<std::size_t> likely_thousands(PartedLines& lines, const Dialect& dialect);

// The header is a line of its own in which each column but the first has a name that is more than a unit: `rate, deg/h`
// may be a name and its unit as well as two names, and a comment may be prose.
[[nodiscard]] bool header_counts_columns(PartedLines& lines, const Dialect& dialect);

}  // namespace zlg::logs
