#pragma once
// Budgets: the apparent drift of a run in which the modes are switched every L seconds, arcsec/s.
//
//   drift = |nonmagnetic| + (what the magnetic drift leaves)/t + (what the switches leave)/t
//
// A budget is a magnitude: each term enters by its absolute value, whatever the signs of Om0, A and the nonmagnetic
// drift, and one switch is charged to each interval, t/L in all, even where t is no multiple of L. Functions
// `as_printed` compute what the paper prints, mistakes included, to reproduce its figures; do not design with them.
//
// All of them: errors DesignError unless the case passes `check` and 0 < interval_s <= run_s.

#include <zlg/design/magnetic_angle.hpp>

namespace zlg::design {

struct DriftCase {
    GyroDrift gyro;
    double switch_error_arcsec = 10.0;  // dP > 0: angle that one switch leaves; its rms where switches are independent
    double run_s = 3600.0;              // t > 0
};

// errors  DesignError for a gyro that fails its check, and unless dP > 0 and t > 0, both finite.
void check(const DriftCase& task);

struct DriftTerms {
    double nonmagnetic_arcsec_s = 0.0;
    double quasi_nonmagnetic_arcsec_s = 0.0;  // from the change of the magnetic drift between segments
    double sawtooth_arcsec_s = 0.0;           // of the segment that has no opposite yet
    double switch_errors_arcsec_s = 0.0;      // all of one sign

    [[nodiscard]] double total_arcsec_s() const {
        return nonmagnetic_arcsec_s + quasi_nonmagnetic_arcsec_s + sawtooth_arcsec_s + switch_errors_arcsec_s;
    }
};

//   (A tau/t) tanh(L/2tau) (1 - exp(-t/tau))
// Mean over the run of the quasi-non-magnetic drift, exact where t is an even multiple of L; sign of A.
[[nodiscard]] double quasi_nonmagnetic_arcsec_s(const GyroDrift& gyro, double run_s, double interval_s);

//   (A tau/2L) (1 - exp(-L/tau))^2    the result in eq (6)
// The same for the first pair of segments alone; the paper uses it for the whole run.
[[nodiscard]] double quasi_nonmagnetic_as_printed_arcsec_s(const GyroDrift& gyro, double interval_s);

//   |nm| + quasi_nonmagnetic + L |Om0|/t + dP/L    eq (7) corrected, (7c)
// The run mean in place of the first pair's value, and the sawtooth of the cold gyro. For one sign of Om0 and A it is
// the worst case below to first order in L/tau; above L = tau the two part: use the worst case there.
[[nodiscard]] DriftTerms corrected_terms(const DriftCase& task, double interval_s);

//   |nm| + (A tau/2L)(1 - exp(-L/tau))^2 + L |Om0|/t + dP/L    eq (7) as printed
// Wrong for t of tau and above: its minimum at L < tau does not fall to nm but to a floor of about sqrt(2 |A| dP/tau).
[[nodiscard]] DriftTerms terms_as_printed(const DriftCase& task, double interval_s);

// Derivative of (7) as printed with respect to L, arcsec/s^2: eq (8).
[[nodiscard]] double derivative_as_printed_arcsec_s2(const DriftCase& task, double interval_s);

//   |nm| + (|S| + |K[Om](t)|)/t + dP/L
// The largest angle with which a run that ends at a switch can end, exact for every L. Of even and odd numbers of
// segments one gives the sum of the magnitudes, the other their difference. With a full first segment and Om(0), Om(t)
// of one sign the magnetic part is |(A + Om0) L - A tau tanh(L/2tau)(1 + exp(-t/tau))|/t, reached at odd switches. A
// half first segment leaves almost no S: where Om does not change, it halves the magnetic part.
[[nodiscard]] double worst_case_drift_arcsec_s(const DriftCase& task, double interval_s,
                                               FirstSegment first = FirstSegment::full);

//   |nm| + L |Om(t)|/t + n dP/t,   n = t/L    eq (3)
// Bound for switch errors that always have the same sign; the paper's Om is that at the end of the run.
[[nodiscard]] double drift_bound_arcsec_s(const DriftCase& task, double interval_s);

//   s/sqrt(t L)
// Rms drift from switch errors of rms s that are independent with zero mean.
[[nodiscard]] double independent_switch_drift_arcsec_s(const DriftCase& task, double interval_s);

//   |nm| + sqrt(((|S| + |K[Om](t)|)/t)^2 + s^2/(t L))
// Rms budget for such switches: the sawtooth as a certain error, that of the worst end as in worst_case_drift_arcsec_s,
// warming included, the sum of the switches as a random one. For a gyro that does not warm up the first term is L
// Om0/t.
[[nodiscard]] double random_sign_drift_arcsec_s(const DriftCase& task, double interval_s,
                                                FirstSegment first = FirstSegment::full);

//   |nm| + sqrt((S^2 + K[Om](t)^2/3)/t^2 + s^2/(t L))
// The same for a run that ends anywhere in a segment: the magnetic angle is then uniform between S - K and S + K, of
// variance K^2/3. For a gyro that
// does not warm up the first term is L |Om0|/(sqrt(3) t), with a half first segment half of that.
[[nodiscard]] double expected_drift_arcsec_s(const DriftCase& task, double interval_s,
                                             FirstSegment first = FirstSegment::full);

}  // namespace zlg::design
