#pragma once
// Formulas for the best interval between switches of modes, and the cubics of the paper.
//
// Each is an approximation with a stated range; `switching_interval.hpp` has the exact minima. Om0 and A enter by their
// absolute values. All: errors DesignError unless the case passes its check. Results are not limited to the run.

#include <zlg/design/drift_budget.hpp>

namespace zlg::design {

//   L = sqrt(dP t/|Om0|)    the A = 0 limit of eq (9)
// Minimum of |nm| + L |Om0|/t + dP/L: a gyro that does not warm up, at an odd switch. Infinite for Om0 = 0.
[[nodiscard]] double closed_form_interval_s(const DriftCase& task);

//   L = (s^2 t/(2 Om^2))^(1/3),   Om = (|Om(0)| + |Om(t)|)/2    first segment full
//                                 Om = |Om(t)|/2                first segment half
// Minimum of random_sign_drift_arcsec_s to first order in L/tau: switch errors that are independent with rms s.
// Infinite for Om = 0.
[[nodiscard]] double random_sign_interval_s(const DriftCase& task, FirstSegment first = FirstSegment::full);

enum class RootStatus {
    found,
    none,        // the cubic has no positive root
    beyond_run,  // it has, but no interval can be longer than the run
};

// The positive roots. Only the smaller is near a minimum of the drift; the larger is a maximum.
struct Roots {
    RootStatus status = RootStatus::none;
    double smaller_s = 0.0;  // NaN for `none`
    double larger_s = 0.0;   // NaN for `none`, infinite where A = 0 leaves a quadratic
};

//   (2 tau^2 |Om0| + |A| tau t) L^2 - 2 |A| t L^3 = 2 tau^2 t dP    eq (9) corrected, (9c)
// Approximates the minimum of (7) as printed for L well below tau, so it shares its mistake at t of tau and above. For
// a long run it has roots only where |A| tau >= 54 dP.
//
// accuracy  1e-14 of the root; 1e-8 where the two coincide.
[[nodiscard]] Roots corrected_roots(const DriftCase& task);

//   2 tau^2 |Om0| L^2 - |A| t L^3 = 2 tau^2 t dP    eq (9) as printed, with the missing t on the right
// It has the sign of the thermal term reversed: a warm-up makes its interval longer.
[[nodiscard]] Roots roots_as_printed(const DriftCase& task);

//   t = (16 tau^4 |Om0|^3/(27 A^2 dP))^(1/3)
// Longest run for which (9) as printed has a positive root. Infinite for A = 0.
[[nodiscard]] double longest_run_as_printed_s(const GyroDrift& gyro, double switch_error_arcsec);

}  // namespace zlg::design
