#pragma once
// The page of a sweep: yield, distributions, what the numbers depend on, and the gyros to look at.

#include <zlg/report/page.hpp>
#include <zlg/sweep/results.hpp>

namespace zlg::sweep {

// rows  one at least.
[[nodiscard]] report::Page sweep_page(const Gyros& gyros, const Rows& rows);

}  // namespace zlg::sweep
