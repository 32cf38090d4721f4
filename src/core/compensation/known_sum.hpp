#pragma once
// The known sum of a gap: the counted angle of ticks that were not measured one by one, with its variance.

#include <zlg/core/compensation/border.hpp>
#include <zlg/core/compensation/gap_tick.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// The readings at both ends of a tick.
struct Borders {
    Border start{};
    Border end{};
};

// The counted angle of the gap's ticks up to this one, where the counter knows it (counted_stretch.hpp). The false
// drift in it is at most that of the fall of the mean square of the detuning since the last measured tick. Where this
// exceeds the rounding of the counter, as in a re-lock, it is subtracted if the light was read throughout, and in any case the
// sum is rough.
void set_known_sum(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& first,
                   const HalfRecord& second, const Borders& borders, const EdgeShiftState& edges_before,
                   TickInput& tick) noexcept;

}  // namespace zlg::core
