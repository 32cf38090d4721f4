#pragma once
// From row to row of a column.

#include <span>

namespace zlg::logs {

[[nodiscard]] inline double as_it_is(double step) { return step; }

// Of these steps the one below which lies that share of them; those that are no number do not count, and NaN: there is
// none. Of very many a part is looked at, taken all over the column, so that no copy of it is needed.
//
// of  of each step what is looked at, such as its size.
[[nodiscard]] double usual_step(std::span<const double> values, double share = 0.5, double (*of)(double) = as_it_is);

}  // namespace zlg::logs
