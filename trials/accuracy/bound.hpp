#pragma once
// The least error that any linear estimate of a switch can have, from the covariance of everything that can be
// observed.
//
// Model: x, zero mean and covariance C, holds the rotation of each half-period, the roundings of the counter at the
// edges of the halves, and the errors of the false angles. Observed is z = H x, the halves or the ticks `bound_ticks`
// before and after the gap, and the lit halves at its end; estimated is the target t = c'x, what makes the angle right
// for ever after: the rotation in the dark part of the gap, less the roundings at its two edges, less the error of the
// false angle. The linear minimum mean-square-error estimate (Kay, Fundamentals of Statistical Signal Processing:
// Estimation Theory, 1993, ch. 12) has the error variance
//
//   c'C c - (H C c)' (H C H')^-1 (H C c)
//
// C is block-diagonal: the autocovariance of the motion's law, with a variance of the constant rate so large that it
// counts as unknown; K^2/12 for each rounding, uniform and independent, which neighbouring halves share with opposite
// signs; and, of the false angles, the Cramer-Rao bound of the light samples (ibid., ch. 3) for a detuning that is a
// cubic spline with knots half a tick apart up to six ticks; in lit halves it is the miss. A bound of ticks uses no lit
// halves. So the light and the counts are weighed together.

#include <zlg/trials/accuracy.hpp>

#include "synthetic/laws.hpp"

namespace zlg::trials {

inline constexpr int bound_ticks = 8;

// The motion is stationary; its constant rate and the spread of it count as unknown. The counter's roundings are taken
// as independent from edge to edge, which is not so at rest and where motion repeats with the ticks.
[[nodiscard]] SwitchBound bound_of(const GyroLaw& gyro, const MotionLaw& motion);

}  // namespace zlg::trials
