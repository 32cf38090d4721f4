#pragma once
// The table of switches as CSV.

#include <string>
#include <vector>

#include <zlg/study/switch_table.hpp>

namespace zlg::cli {

// What is not known is an empty field; what has no bound is `inf`.
//
// has_truth  with the column of the true errors.
[[nodiscard]] std::string switch_csv(const std::vector<study::SwitchLine>& switches, bool has_truth);

}  // namespace zlg::cli
