#pragma once
// Many errors and the sigmas that were claimed for them, in a few figures.

#include <vector>

#include <zlg/study/accuracy.hpp>

#include "accuracy_trial.hpp"

namespace zlg::study {

[[nodiscard]] ErrorFigures figures_of(const std::vector<SwitchError>& errors);

// The same of the false angle alone.
[[nodiscard]] ErrorFigures relock_figures_of(const std::vector<SwitchError>& errors);

}  // namespace zlg::study
