#pragma once
// The scripts under which the core's instructions are counted: the usual operation of a gyro, and the worst cases.

#include <vector>

#include "scripted_gyro.hpp"

namespace zlg::bench {

// First the usual ones, then the worst with the methods of the paper, then those with the optimal bridge and the joint re-lock, whose
// halves cost more.
[[nodiscard]] std::vector<Script> scripts();

}  // namespace zlg::bench
