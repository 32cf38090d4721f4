// The theory of the designer for a configured gyro.
#include "design_formulas.hpp"

#include <limits>

#include <zlg/config/schema.hpp>
#include <zlg/design/drift_budget.hpp>
#include <zlg/design/error.hpp>
#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>
#include <zlg/study/gyro_drift.hpp>

namespace zlg::lab {
namespace {

template <class Work>
double number(const Work& work) {
    try {
        return work();
    } catch (const design::DesignError&) {
        return std::numeric_limits<double>::quiet_NaN();
    } catch (const config::ConfigError&) {  // a field or a profile, which no closed form knows
        return std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace

double drift_arcsec_s(const config::Config& config, Budget budget, double interval_s, double run_s,
                      double switch_error_arcsec) {
    const design::FirstSegment first = config.switching.first_segment;
    return number([&] {
        const design::DriftCase task{study::gyro_drift(config), switch_error_arcsec, run_s};
        if (budget == Budget::as_printed) return design::terms_as_printed(task, interval_s).total_arcsec_s();
        return budget == Budget::worst_case ? design::worst_case_drift_arcsec_s(task, interval_s, first)
                                            : design::expected_drift_arcsec_s(task, interval_s, first);
    });
}

double interval_s(const config::Config& config, IntervalLaw law, double run_s, double switch_error_arcsec) {
    return number([&] {
        const design::DriftCase task{study::gyro_drift(config), switch_error_arcsec, run_s};
        return law == IntervalLaw::closed_form
                   ? design::closed_form_interval_s(task)
                   : design::expected_optimum(task, config.switching.first_segment).interval_s;
    });
}

}  // namespace zlg::lab
