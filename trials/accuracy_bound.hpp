#pragma once
// The least error that any linear estimate of a switch can have, from the covariance of everything it could see.
//
// Seen are the ticks, or the halves, `bound_ticks` before and after the gap. Their covariance is that of the known motion,
// of independent roundings at the edges of the halves, which neighbours share with opposite signs, and of what the light
// leaves unknown of the false angle: the Cramer-Rao bound of a cubic spline with knots half a tick apart up to six ticks.
// Estimated is what makes the angle right for ever after: rotation in the gap, less the false angle's error, less the
// roundings at the two edges of the gap. The light and the counts are weighed together.

#include "accuracy_law.hpp"

namespace zlg::trials {

inline constexpr int bound_ticks = 8;

struct SwitchBound {
    double ticks_arcsec = 0.0;       // constant rate unknown
    double halves_arcsec = 0.0;      // the same from half-periods
    double known_rate_arcsec = 0.0;  // from half-periods, the constant rate known too
    double relock_arcsec = 0.0;      // false angle by the light alone
};

// The motion is stationary; its constant rate and the spread of it count as unknown. The counter's roundings are taken as
// independent from edge to edge, which is not so at rest and where motion repeats with the ticks.
[[nodiscard]] SwitchBound bound_of(const GyroLaw& gyro, const MotionLaw& motion);

}  // namespace zlg::trials
