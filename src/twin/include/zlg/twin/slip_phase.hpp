#pragma once
// The beat phase by the slip formula: what lock-in does to it happens at the reversals of the bias.
//
// On a plateau the phase, smoothed over a turn, runs at sqrt(f^2 - f_L^2). On a ramp f = f' t through zero it slips by
// the scattering of an endless ramp, less what the ramp does not have beyond its ends:
//
//   slip = -2 atan2(b sin q, 1 + b cos q),  q = psi_0 + phi +- pi/4,  b^2 = 1 - exp(-d^2/4),  d = 2 pi f_L/sqrt|f'|
//
// To first order it is -d sin q with d = omega_L sqrt(t_e/(2 f0)), psi_0 the phase at the zero of the drive. Where the
// formula does not hold (a ramp that misses zero, a drive near lock-in) the exact stepper takes over.

#include <zlg/twin/beat_phase.hpp>

namespace zlg::twin {

class SlipPhase {
public:
    explicit SlipPhase(const Turns& start = {}) : smooth_{start} {}

    // The phase without the ripple f_L/f cos(psi + phi) that it has on a plateau.
    [[nodiscard]] const Turns& value() const { return smooth_; }

    // Constant drive.
    // errors  as `BeatPhase::plateau`, and `ramp` below.
    // cost    about 10 ns.
    void plateau(double drive_hz, Coupling coupling, double duration_s);

    // Linear drive from plateau to plateau.
    //
    // return    the phase at the middle of the ramp, where a counter is latched; it may err by half of the slip where
    //           the drive is not zero there, which no later reading inherits.
    // accuracy  1.5e-4 rad for +-60 kHz in 50 us and lock-in at 300 Hz; in proportion to f_L, and to 1/(f t_e)^3.
    // cost      about 0.1 us.
    Turns reversal(double start_hz, double end_hz, Coupling coupling, double duration_s);

private:
    Turns smooth_;
};

// Both ends of the ramp beat freely, and it turns by enough between them for the slip to be over.
[[nodiscard]] bool slip_formula_holds(double start_hz, double end_hz, double lock_hz, double duration_s);

}  // namespace zlg::twin
