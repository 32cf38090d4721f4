#pragma once
// The half-wave voltage U_lambda/2, what moves the perimeter from one mode to its neighbour, as the switches measured
// it: |U- - U+|, each settled. It changes with temperature and with the hysteresis of the piezo.
//
// A scalar Kalman filter for a random walk, for what is reported; the control itself predicts each move
// (core/control/half_wave.hpp):
//
//   p = variance + process_sigma^2,  K = p / (p + measurement_sigma^2)
//   estimate += K (measured - estimate),  variance = (1 - K) p

#include <zlg/config/config.hpp>
#include <zlg/core/control/mode_switch.hpp>

namespace zlg::rig {

struct MeasuredHalfWave {
    double presumed_v;                 // before the first measurement, known to a tenth
    double measurement_sigma_v = 0.3;  // converter, residual detuning, hysteresis
    double process_sigma_v = 0.1;      // true change from one switch to the next
    double gate = 4.0;                 // standard deviations from which on a measurement is an outlier
    double estimate_v = presumed_v;
    double variance_v2 = 0.01 * presumed_v * presumed_v;
    int outlier_side = 0;  // of the last measurement: +1 above the gate, -1 below; 0: inside

    // A switch that has ended. Outliers, what is outside half to twice the presumed voltage (the loop has caught
    // another mode), and what was not measured are rejected; the variance grows all the same, up to that of the
    // presumed value. A second outlier in a row on the same side is accepted, with p = (measured - estimate)^2: the
    // first loops of a piezo with hysteresis differ from its later ones.
    void take(const core::SwitchEvent& event);

    [[nodiscard]] double sigma_v() const;
};

[[nodiscard]] MeasuredHalfWave measured_half_wave(const config::Config& config);

}  // namespace zlg::rig
