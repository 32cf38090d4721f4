#pragma once
// The false angle that the magnetic drift leaves when the helicity alternates.
//
// The magnetic drift (5) has the sign of the mode, so that segments between switches count +, -, +, -.
// Notation: Om0 magnetic drift at start, A its total thermal change, tau thermal time constant, L interval.
// Angles and rates keep the signs of Om0 and A, both of which may be negative. All formulas are exact.

#include <zlg/config/config.hpp>

namespace zlg::design {

using config::FirstSegment;  // `half`: the first segment lasts L/2, the sequence is A BB AA BB ...

struct GyroDrift {
    double nonmagnetic_arcsec_s = 0.05;
    double magnetic_arcsec_s = 0.7;          // Om0, at start
    double magnetic_thermal_arcsec_s = 0.7;  // A = A_qm A_T: what a full warm-up adds to Om0
    double thermal_time_s = 3000.0;          // tau, > 0
};

// errors  DesignError unless all members are finite and tau > 0. The functions below presume a gyro that passed.
void check(const GyroDrift& gyro);

//   Om(t) = A (1 - exp(-t/tau)) + Om0    eq (5)
//
// at_s  >= 0.
[[nodiscard]] double magnetic_rate_arcsec_s(const GyroDrift& gyro, double at_s);

// Integral of (5) between two instants, arcsec.
[[nodiscard]] double magnetic_integral_arcsec(const GyroDrift& gyro, double from_s, double to_s);

//   K[Om](t), linear in Om, with K[1] = L/2 and K[exp(-t/tau)] = tau tanh(L/2tau) exp(-t/tau)
// The kernel of plain alternation: the angle after n segments is S - (-1)^n K[Om](t), S from the start alone.
//
// interval_s  L > 0, any ratio to tau.
[[nodiscard]] double kernel_arcsec(const GyroDrift& gyro, double interval_s, double at_s);

//   S = K[Om](0)                                                  first segment full
//   S = int_0^{L/2} Om dt - K[Om](L/2) = -A tau tanh(L/2tau) tanh(L/4tau)    first segment half; about -A L^2/(8 tau)
// What the start leaves in the angle for good.
[[nodiscard]] double start_residue_arcsec(const GyroDrift& gyro, double interval_s, FirstSegment first);

}  // namespace zlg::design
