#pragma once
// What the paper's rules alone choose: its interval, and figure 5.

#include <zlg/choice/choose.hpp>
#include <zlg/report/page.hpp>

namespace zlg::choice {

// The interval with the least (7) as printed, with corrections by mean square, a quadratic bridge and one count a
// fringe; met where that budget, of one sign and without chance, keeps what is required. The probability is 1 or 0.
//
// errors  design::DesignError for a gyro without a budget.
[[nodiscard]] Answer by_paper_rules(const Requirement& requirement);

[[nodiscard]] report::Page paper_rules_page(const Requirement& requirement, const Answer& answer);

}  // namespace zlg::choice
