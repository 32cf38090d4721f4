#pragma once
// Faults of the ring's length and of what moves it.

#include <span>

#include <zlg/twin/faults.hpp>

namespace zlg::twin {

// What one of these adds to the length; outside its time what it leaves.
[[nodiscard]] double length_lambda(const Fault& fault, double time_s, double vibration_hz);
// The longest piece of time in which a parabola follows it; infinite where none is too long.
[[nodiscard]] double longest_piece_s(const Fault& fault, double vibration_hz);
[[nodiscard]] double length_lambda(std::span<const Fault> active, double time_s, double vibration_hz);

// By how much a loop that opens now is sent off its target.
[[nodiscard]] double switch_error_lambda(std::span<const Fault> active, double time_s);

// Half-wave voltage over its own.
[[nodiscard]] double half_wave_ratio(std::span<const Fault> active, double time_s);

// Warming beyond that of the operation, without what has settled.
[[nodiscard]] double warming_c(std::span<const Fault> active, double time_s);

}  // namespace zlg::twin
