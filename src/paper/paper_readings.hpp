#pragma once
// The drift budget of the paper under both readings of its thermal drift.

#include <cmath>

#include <zlg/design/switching_interval.hpp>
#include <zlg/study/design_study.hpp>

namespace zlg::paper {

// The listed thermal drift is the whole change by warming in `drift_case`. Here it is meant per degree, so that the
// change is that times the rise of temperature.
[[nodiscard]] inline design::DriftCase drift_case_per_degree(const config::Config& config, double run_s) {
    design::DriftCase task = study::drift_case(config, run_s);
    task.gyro.magnetic_thermal_arcsec_s *= config.gyro.temperature_rise_c;
    return task;
}

// What the minimum of (7) as printed keeps above the non-magnetic drift in a run of many thermal times.
[[nodiscard]] inline double printed_floor_arcsec_s(design::DriftCase task) {
    task.run_s = 100.0 * task.gyro.thermal_time_s;
    return design::optimum(design::IntervalMethod::as_printed, task).drift_arcsec_s -
           std::abs(task.gyro.nonmagnetic_arcsec_s);
}

}  // namespace zlg::paper
