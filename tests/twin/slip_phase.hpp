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

#include <algorithm>
#include <cmath>
#include <numbers>

#include <zlg/core/common/maths.hpp>
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

namespace slip_formula {

inline constexpr double free_ratio = 8.0;  // |f|/f_L from which the ripple is small and regular
inline constexpr double max_turns = 1e17;  // the exact stepper refuses what is beyond

// psi - smooth [turns], to first order.
inline double ripple(const Turns& phase, double drive_hz, Coupling c) {
    if (!(std::abs(drive_hz) > free_ratio * std::sqrt(std::norm(c)))) return 0.0;
    const double angle = phase.part_rad();
    return (c.real() * core::maths::cos(angle) - c.imag() * core::maths::sin(angle)) /
           (2.0 * std::numbers::pi * drive_hz);
}

// The slip that the endless ramp would have beyond its end [rad], expanded to second order in 1/(f t_e):
// K sin(psi + phi) - Q cos(psi + phi), K = omega_L w'/w^3, Q = 3 omega_L w'^2/w^5.
inline double missing(const Turns& phase, double drive_hz, double slope_hz_s, Coupling c) {
    const double k = slope_hz_s / (2.0 * std::numbers::pi * drive_hz * drive_hz * drive_hz);
    const double q = 3.0 * k * slope_hz_s / (2.0 * std::numbers::pi * drive_hz * drive_hz);
    const double cosine = core::maths::cos(phase.part_rad());
    const double sine = core::maths::sin(phase.part_rad());
    const double re = c.real() * cosine - c.imag() * sine;
    const double im = c.real() * sine + c.imag() * cosine;
    return k * im - q * re;
}

}  // namespace slip_formula

// Both ends of the ramp beat freely, and it turns by enough between them for the slip to be over.
inline bool slip_formula_holds(double start_hz, double end_hz, double lock_hz, double duration_s) {
    const double smaller = std::min(std::abs(start_hz), std::abs(end_hz));
    const double slope = std::abs(end_hz - start_hz) / duration_s;
    return start_hz * end_hz < 0.0 && smaller > slip_formula::free_ratio * lock_hz && smaller * smaller > 0.5 * slope &&
           slope * duration_s * duration_s < slip_formula::max_turns;
}

inline void SlipPhase::plateau(double drive_hz, Coupling coupling, double duration_s) {
    const double lock_hz = std::sqrt(std::norm(coupling));
    if (std::abs(drive_hz) > slip_formula::free_ratio * lock_hz &&
        std::abs(drive_hz * duration_s) < slip_formula::max_turns) {
        const double beat_hz = std::sqrt((drive_hz - lock_hz) * (drive_hz + lock_hz));
        smooth_.add(std::copysign(beat_hz, drive_hz) * duration_s);
        return;
    }
    BeatPhase exact{smooth_};
    exact.plateau(drive_hz, coupling, duration_s);
    smooth_ = exact.value();
}

inline Turns SlipPhase::reversal(double start_hz, double end_hz, Coupling coupling, double duration_s) {
    const double lock_hz = std::sqrt(std::norm(coupling));
    if (!slip_formula_holds(start_hz, end_hz, lock_hz, duration_s)) {
        Turns psi = smooth_;
        psi.add(slip_formula::ripple(smooth_, start_hz, coupling));
        BeatPhase exact{psi};
        exact.ramp(start_hz, 0.5 * (start_hz + end_hz), coupling, 0.5 * duration_s);
        const Turns middle = exact.value();
        exact.ramp(0.5 * (start_hz + end_hz), end_hz, coupling, 0.5 * duration_s);
        smooth_ = exact.value();
        smooth_.add(-slip_formula::ripple(smooth_, end_hz, coupling));
        return middle;
    }
    const double slope = (end_hz - start_hz) / duration_s;
    Turns at_zero = smooth_;
    at_zero.add(-0.5 * start_hz * start_hz / slope);
    const double depth = 2.0 * std::numbers::pi * lock_hz / std::sqrt(std::abs(slope));
    const double b = std::sqrt(-core::maths::expm1(-0.25 * depth * depth));
    const double q = at_zero.part_rad() + core::maths::atan2(coupling.imag(), coupling.real()) +
                     std::copysign(0.25 * std::numbers::pi, slope);
    const double slip =
        -2.0 * core::maths::atan2(b * core::maths::sin(q), 1.0 + b * core::maths::cos(q)) / (2.0 * std::numbers::pi);

    Turns middle = smooth_;
    middle.add(0.125 * (3.0 * start_hz + end_hz) * duration_s + 0.5 * slip);
    Turns after = smooth_;
    after.add(0.5 * (start_hz + end_hz) * duration_s + slip);
    // Between unequal ends the mean pull -f_L^2/(2 f) of the beat does not cancel.
    const double pulled = -0.5 * lock_hz * lock_hz / slope * core::maths::log(std::abs(end_hz / start_hz));
    const double ends = slip_formula::missing(after, end_hz, slope, coupling) -
                        slip_formula::missing(smooth_, start_hz, slope, coupling);
    after.add(pulled + ends / (2.0 * std::numbers::pi));
    smooth_ = after;
    return middle;
}

}  // namespace zlg::twin
