#pragma once
// An interval that grows with the time since start, for a gyro that does not know how long its run will be.
//
//   L(t) = g sqrt(dP t/|Om(t)|)
//
// A fixed interval is best for one length of run only. Here every switch is followed by the interval that belongs to
// its instant. The intervals begin near 0, so no first segment stays in the angle: at switches it is -+ L |Om|/2. For
// Om constant the excess of drift over nm is (g/2 + 2/g) sqrt(dP |Om|/t). That of the best fixed interval of the same
// run, full first segment, is 2 sqrt(dP |Om|/t), so g = 2 loses nothing at any t and g = sqrt 2 loses 6 %; with a half
// first segment it is sqrt 2 lower.
//
// In all functions the run_s of the case is the instant t, and Om a magnitude.
//
// errors  DesignError unless the case passes its check and g > 0, finite.

#include <zlg/design/drift_budget.hpp>

namespace zlg::design {

// Minimum of g/2 + 2/g.
inline constexpr double growth_best = 2.0;

// The interval after a switch at t, s. Infinite where Om(t) = 0; longer than t itself where |Om| t < g^2 dP.
[[nodiscard]] double growing_interval_s(const DriftCase& task, double growth);

//   n(t) = int_0^t dt'/L(t')
// Switches so far, as a real number; for A = 0 it is (2/g) sqrt(|Om| t/dP).
[[nodiscard]] double growing_switches(const DriftCase& task, double growth);

//   |nm| + (L(t) |Om(t)|/2 + n(t) dP)/t
// Budget at t. It presumes intervals that vary smoothly, n >> 1 and L << tau.
[[nodiscard]] double growing_drift_arcsec_s(const DriftCase& task, double growth);

}  // namespace zlg::design
