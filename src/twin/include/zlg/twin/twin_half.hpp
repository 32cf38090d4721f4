#pragma once
// What the twin answers with for one half-period, and the truth that no gyro knows.

#include <zlg/core/records.hpp>

namespace zlg::twin {

// What happened in one half-period.
struct TwinTruth {
    double dtheta_arcsec = 0.0;        // rotation of the case
    double false_relock_arcsec = 0.0;  // angle that the detuning's effect on the bias adds to this half's counts
    double detuning_end_lambda = 0.0;  // of the mode that lases, at the end of the half
    double perimeter_v = 0.0;          // true piezo voltage at the end of the half
    double rounding_arcsec = 0.0;      // counter less phase at the end of the half, of `averaged`; 0 of a laser
    double random_walk_arcsec =
        0.0;          // that the half adds to the angle, of `averaged`; 0 of a laser, whose lock-in walks
    bool lit = true;  // light in both directions throughout the half, of one mode
};

struct TwinHalf {
    core::SensorFrame sensor;
    TwinTruth truth;
};

}  // namespace zlg::twin
