#pragma once
// What the page says of a figure beside its drawing: its axes for the script, and the values that are drawn.

#include <string>

#include <zlg/report/figure.hpp>

namespace zlg::report {

// JSON: limits of both axes in axis units, whether they are logarithmic, their labels; the series with their names and
// whether a mark of them is drawn.
[[nodiscard]] std::string axes_json(const Figure& figure);

// The values of the series as a table that is folded away; a long series is thinned as for drawing. Empty where nothing
// is drawn.
[[nodiscard]] std::string values_table(const Figure& figure);

}  // namespace zlg::report
