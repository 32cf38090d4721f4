#pragma once
// The numbers by which the averaged twin describes the laser, derived from the four-wave equations.

#include <zlg/twin/four_wave.hpp>

namespace zlg::twin {

// All at the plateau of one bias field, for the left mode; the right one has the same with the field reversed.
struct AveragedLaser {
    double bias_hz = 0.0;                   // at zero detuning, of the plateau
    double bias_chi = 0.0;                  // of bias (1 - chi dl^2), least squares within the fitted detunings
    double bias_residual_ratio = 0.0;       // largest departure from that law there, in parts of bias_hz
    double discriminator_per_lambda = 0.0;  // slope of (cw - ccw)/(cw + ccw) where the perimeter loop settles
    double settled_lambda = 0.0;            // detuning of equal beams there; 0 for isotopes of equal share
    double scale_pull = 0.0;                // part of the beat of a rotation that the gas pulls away, undetuned
};

// field_g           plateau of the bias, > 0.
// fit_range_lambda  chi is fitted over +- this, 0.001..0.25.
// errors            std::invalid_argument for an argument out of range; std::runtime_error where the mode at zero
//                   detuning is not lit both ways, or its beams are nowhere equal.
// cost              about 20 ms.
[[nodiscard]] AveragedLaser averaged_laser(const FourWave& laser, double field_g, double fit_range_lambda = 0.1);

}  // namespace zlg::twin
