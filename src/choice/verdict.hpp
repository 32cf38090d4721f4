#pragma once
// What an answer says beside its number: budget, what binds, reasons, and what would have to change.

#include "forecast.hpp"
#include "search.hpp"

namespace zlg::choice {

// Parts, budget, binding and reasons of the choice that the answer holds.
void explain(const Requirement& requirement, Forecast& forecast, const std::vector<std::string>& excluded,
             Answer& answer);

// Each constant alone: by how much it would have to change, by the closed forms, and the share of 24 gyros that then
// meet the requirement.
[[nodiscard]] std::vector<Need> needs(const Task& task, const Candidate& candidate);

}  // namespace zlg::choice
