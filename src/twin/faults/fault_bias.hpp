#pragma once
// Faults of what moves the fringes: the coil, the field around it, the case.

#include <span>

#include <zlg/twin/faults.hpp>

namespace zlg::twin {

// Mean of the coil's current from start_s to end_s over that without fault, in a half of this bias sign.
[[nodiscard]] double bias_ratio(std::span<const Fault> active, int bias_sign, double start_s, double end_s);

// Mean fringe rate that a constant field adds in the left mode and takes in the right one.
[[nodiscard]] double field_hz(std::span<const Fault> active, double start_s, double end_s);

// Rotation beyond the motion.
[[nodiscard]] double turned_arcsec(std::span<const Fault> active, double start_s, double end_s);

}  // namespace zlg::twin
