#pragma once
// Rows of several sensors by turns.

#include <optional>
#include <string>
#include <utility>
#include <zlg/logs/imported.hpp>

namespace zlg::logs {

// Of rows of several sensors, as a column says, the word of the first (none: it holds numbers) and the question whose
// are meant. Notes words by turns that part no values.
[[nodiscard]] std::optional<std::pair<std::string, std::string>> mixed_rows(ForeignLook& look);

// Most rows without a value of any axis hold one in columns that are empty beside the axes and that nobody asked for:
// of a table into which several sensors were merged by their times they are the others' rows.
[[nodiscard]] bool holds_rows_of_others(const ForeignLook& look);

// Takes those rows out, of the first n_axes columns; returns how many.
std::size_t take_out_empty_rows(TextTable& read, std::size_t n_axes);

}  // namespace zlg::logs
