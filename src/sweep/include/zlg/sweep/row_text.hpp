#pragma once
// One row as one line of text with a checksum: as it stands in a checkpoint, and as it goes from one process to
// another.

#include <optional>
#include <string>
#include <string_view>

#include <zlg/sweep/gyros.hpp>

namespace zlg::sweep {

// Without the end of the line. row_of(text_of(row), row.metrics.size()) has the same bits, but for those of a NaN.
[[nodiscard]] std::string text_of(const Row& row);

// The same without the checksum at its end.
[[nodiscard]] std::string fields_of(const Row& row);

// Nothing where a bit of it is wrong, or it has another number of metrics.
[[nodiscard]] std::optional<Row> row_of(std::string_view line, std::size_t n_metrics);

// CRC-32C, 8 hexadecimal digits.
[[nodiscard]] std::string text_checksum(std::string_view text);

}  // namespace zlg::sweep
