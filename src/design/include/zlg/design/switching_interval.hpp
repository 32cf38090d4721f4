#pragma once
// The interval between switches of modes that makes a drift budget least.
//
// Long intervals let the magnetic drift pile up before it is reversed, short ones pay for many switches. Each method is
// a budget with its own account of both; `optimum` is the global minimum of that budget over all 0 < L <= t: its slope
// is known in closed form, is scanned on a logarithmic grid for changes of sign, and each zero is refined by the
// bracketing method TOMS 748 (Alefeld, Potra and Shi, ACM Trans. Math. Softw. 21, 1995).

#include <array>
#include <string_view>

#include <zlg/design/drift_budget.hpp>

namespace zlg::design {

enum class IntervalMethod {
    corrected,    // (7c)
    worst_case,   // exact at the worst switch, first segment full
    as_printed,   // (7) as printed
    closed_form,  // |nm| + L |Om0|/t + dP/L, whose minimum is the paper's sqrt(dP t/Om0)
};

inline constexpr std::array interval_methods{IntervalMethod::corrected, IntervalMethod::worst_case,
                                             IntervalMethod::as_printed, IntervalMethod::closed_form};

// As the enumerator is spelt.
[[nodiscard]] std::string_view name(IntervalMethod method);

// The budget of a method at a given interval, arcsec/s.
//
// errors  DesignError unless the case passes its check and 0 < interval_s <= run_s.
[[nodiscard]] double drift_arcsec_s(IntervalMethod method, const DriftCase& task, double interval_s);

enum class OptimumStatus {
    inside,             // a minimum within the run
    whole_run,          // the least value is at L = t: no switch pays
    no_magnetic_drift,  // the budget holds none, so L = t, whatever the switches cost
};

// One sentence for a reader.
[[nodiscard]] std::string_view sentence(OptimumStatus status);

struct Optimum {
    OptimumStatus status = OptimumStatus::inside;
    double interval_s = 0.0;      // the run, unless `inside`
    double drift_arcsec_s = 0.0;  // the method's own budget there
};

// The least value of the method's budget, and where.
//
// A budget can have two minima: (7) as printed falls again for L above tau, and for runs beyond about
// (|A| tau + 2 dP) |Om0| tau/(|A| dP) that second minimum, which no gyro has, is the lower. With Om0 and A of opposite
// sign the worst case may have a kink where the two cancel. All are compared; of equal ones the shortest interval wins.
//
// accuracy  the interval 1e-8 of itself; the drift 1e-14.
// errors    DesignError unless the case passes its check, and where numbers overflow.
[[nodiscard]] Optimum optimum(IntervalMethod method, const DriftCase& task);

// The same for the worst case, when the first segment is full or half.
[[nodiscard]] Optimum worst_case_optimum(const DriftCase& task, FirstSegment first);
// The least value of expected_drift_arcsec_s: for a run that ends anywhere in a segment.
[[nodiscard]] Optimum expected_optimum(const DriftCase& task, FirstSegment first);

}  // namespace zlg::design
