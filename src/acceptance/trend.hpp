#pragma once
// Earlier tests of the same type as a trend.

#include <string>
#include <vector>

#include <zlg/acceptance/accept.hpp>
#include <zlg/report/page.hpp>

namespace zlg::acceptance {

// own, earlier  records as JSON; those of another type of unit are left out of the earlier ones, and each test counts
// once.
[[nodiscard]] report::Section trend_section(const Acceptance& test, const std::string& own,
                                            const std::vector<std::string>& earlier);

}  // namespace zlg::acceptance
