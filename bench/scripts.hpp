#pragma once
// The scripts under which the core's instructions are counted: the usual life of a gyro, and the worst there is.

#include <vector>

#include "scripted_gyro.hpp"

namespace zlg::bench {

[[nodiscard]] std::vector<Script> usual_scripts();
[[nodiscard]] std::vector<Script> worst_scripts();

// With the optimal bridge and the joint re-lock, whose halves are dearer.
[[nodiscard]] std::vector<Script> estimating_scripts();

}  // namespace zlg::bench
