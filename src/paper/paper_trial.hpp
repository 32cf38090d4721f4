#pragma once
// What the paper gives of its trial with oscillation, section on the substitution of the gap; and its drift budget
// under the second reading of its thermal drift.

#include <cmath>

#include <zlg/design/substitution.hpp>
#include <zlg/design/switching_interval.hpp>
#include <zlg/study/design_study.hpp>

namespace zlg::paper {

inline constexpr double paper_amplitude_arcsec_s = 12000.0;
inline constexpr design::Tone paper_oscillation{paper_amplitude_arcsec_s, 20.0};
inline constexpr double paper_noise_arcsec = 1.6;  // of a tick of 5 ms; read as 3 sigma
inline constexpr double paper_switch_error_arcsec = 10.0;
inline constexpr int paper_gap_ticks = 3;

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
