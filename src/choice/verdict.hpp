#pragma once
// What an answer says beside its number: budget, what binds, reasons, and what would have to change.

#include <zlg/design/drift_budget.hpp>

#include "forecast.hpp"
#include "search.hpp"

namespace zlg::choice {

using Budget = std::vector<std::pair<std::string, double>>;

// Terms of (3) to (7), by name with unit.
[[nodiscard]] Budget budget_7(const design::DriftCase& task, double interval_s, const design::DriftTerms& terms);

// Of all parts but the last, their sum.
[[nodiscard]] std::string largest(const std::vector<Part>& parts);

// Parts, budget, binding and reasons of the choice that the answer holds.
void explain(const Requirement& requirement, Forecast& forecast, const std::vector<std::string>& excluded,
             Answer& answer);

// Each constant alone: by how much it would have to change, by the closed forms, and the share of 24 gyros that then
// meet the requirement.
[[nodiscard]] std::vector<Need> needs(const Task& task, const Candidate& candidate);

}  // namespace zlg::choice
