// Apparent drift over the switching interval.
#include "design_curve.hpp"

#include <zlg/design/drift_budget.hpp>
#include <zlg/study/gyro_drift.hpp>

namespace zlg::lab {

std::vector<double> design_curve(const config::Config& config, double switch_error_arcsec, double run_s) {
    const design::DriftCase task{study::gyro_drift(config), switch_error_arcsec, run_s};
    const bool half = config.switching.first_segment == config::FirstSegment::half;
    const auto first = half ? design::FirstSegment::half : design::FirstSegment::full;
    std::vector<double> rows;
    for (double interval_s = 1.0; interval_s <= run_s; interval_s *= 1.15)
        rows.insert(rows.end(), {interval_s, design::terms_as_printed(task, interval_s).total_arcsec_s(),
                                 design::worst_case_drift_arcsec_s(task, interval_s, first),
                                 design::expected_drift_arcsec_s(task, interval_s, first)});
    return rows;
}

}  // namespace zlg::lab
