#pragma once
// The page of a sweep: yield, distributions, what the numbers depend on, and the gyros to look at.

#include <zlg/report/page.hpp>
#include <zlg/sweep/results.hpp>

namespace zlg::sweep {

// rows  one at least. The summary is without figures: what a text shows of the page.
[[nodiscard]] report::Page sweep_summary(const Gyros& gyros, const Rows& rows);
[[nodiscard]] report::Page sweep_page(const Gyros& gyros, const Rows& rows);

}  // namespace zlg::sweep
