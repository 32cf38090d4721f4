#pragma once
// Many errors and the sigmas that were claimed for them, in a few figures.

#include <vector>

#include <zlg/trials/accuracy.hpp>

#include "trial.hpp"

namespace zlg::trials {

[[nodiscard]] ErrorFigures figures_of(const std::vector<SwitchError>& errors);

// The same of the false angle alone.
[[nodiscard]] ErrorFigures relock_figures_of(std::vector<SwitchError> errors);

}  // namespace zlg::trials
