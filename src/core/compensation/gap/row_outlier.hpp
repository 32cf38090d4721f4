#pragma once
// The row that leaves the history, held against its neighbours.

#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// Adds to the sigma of the row what it gains by standing apart (tick_outlier.hpp).
//
// to_come  ticks after it in the history.
// cost     most rows leave after a glance at the two beside them.
void hold_apart(const CompensationConstants& gyro, GapBridgeState& state, std::int64_t to_come, AngleRow& row) noexcept;

}  // namespace zlg::core
