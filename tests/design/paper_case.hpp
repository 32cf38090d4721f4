#pragma once
// The paper's gyro, warming, in a run.

#include <zlg/design/drift_budget.hpp>

namespace zlg::design {

inline DriftCase paper(double thermal_arcsec_s, double run_s) {
    return {.gyro = {.nonmagnetic_arcsec_s = 0.05,
                     .magnetic_arcsec_s = 0.7,
                     .magnetic_thermal_arcsec_s = thermal_arcsec_s,
                     .thermal_time_s = 3000.0},
            .switch_error_arcsec = 10.0,
            .run_s = run_s};
}

}  // namespace zlg::design
