#pragma once
// Rows of several sensors by turns.

#include <zlg/logs/imported.hpp>

namespace zlg::logs {

// Notes words by turns that part no values.
//
// errors  MappingError: a column says that the rows are of several sensors.
void refuse_mixed_rows(ForeignLook& look);

// Most rows without a value of any axis hold one in columns that are empty beside the axes and that nobody asked for:
// of a table into which several sensors were merged by their times they are the others' rows.
[[nodiscard]] bool holds_rows_of_others(const ForeignLook& look);

// Takes those rows out, of the first n_axes columns; returns how many.
std::size_t take_out_empty_rows(TextTable& read, std::size_t n_axes);

}  // namespace zlg::logs
