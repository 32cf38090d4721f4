#pragma once
// What a tick may hold that no correction subtracts: its variance allows for it.

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/gap_tick.hpp>
#include <zlg/core/compensation/relock_drift.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// Before the first gap of a log, and later than `relock_ticks` after one, no false angle is subtracted. Where the light shows
// one beyond its noise, because the loop still settled or the perimeter was pushed, the variance contains its square and
// the noise of the light. It is found by a trial step from the state just after a gap.
void allow_for_push(const CompensationConstants& gyro, const RelockDriftConfig& config, const RelockDriftState& relock,
                    const RelockTick& read, TickInput& tick) noexcept;

// What the half before or behind those that a monitor refused may hold of their fault.
[[nodiscard]] double unseen_arcsec2(const CompensationConstants& gyro) noexcept;

}  // namespace zlg::core
