#pragma once
// What the theory of the designer says of a configured gyro, as numbers for charts beside the gyro that runs.

#include <zlg/config/config.hpp>

namespace zlg::lab {

// Apparent drift of a run of run_s that is switched every interval_s, arcsec/s (drift_budget.hpp).
enum class Budget {
    as_printed,  // eq (7)
    worst_case,
    expected,
};

// switch_error_arcsec  that one switch leaves.
// return               NaN where the theory refuses the case: unless 0 < interval_s <= run_s, or where switches cost
// nothing.
[[nodiscard]] double drift_arcsec_s(const config::Config& config, Budget budget, double interval_s, double run_s,
                                    double switch_error_arcsec);

// The best interval between switches, s: the minimum of the expected drift, as `zlg run` takes it for interval_s =
// "optimal", and sqrt(dP t/Om), to which eq (9) comes for a gyro that does not warm up.
enum class IntervalLaw { expected, closed_form };

// return  NaN where the theory refuses the case, infinite where the law has none.
[[nodiscard]] double interval_s(const config::Config& config, IntervalLaw law, double run_s,
                                double switch_error_arcsec);

}  // namespace zlg::lab
