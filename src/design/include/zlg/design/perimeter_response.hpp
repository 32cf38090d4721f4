#pragma once
// The linear perimeter loop: open-loop response, margins, and the stability of its sampled form.
//
//   L(i w) = 1/(i w tau) * e^(-i w D) * 1/(1 + i w RC) * w_m^2/(w_m^2 - w^2 + 2 i zeta w_m w)
//
// integrator of time constant tau (detector, integrator and piezo gain together), delay D of the detector that averages
// over the bias period T (between T/2 and T), high-voltage stage, piezo mirror. The limiter behind the detector and the
// slew of the high voltage are not linear: see the re-lock loop.

#include <limits>

namespace zlg::design {

struct PerimeterLoop {
    double tau_s = 0.0065;          // > 0
    double delay_s = 0.75 * 0.005;  // >= 0
    double rc_s = 0.001;            // >= 0; 0: a stage that follows at once
    double mirror_hz = 5000.0;      // > 0; infinite: a rigid mirror
    double mirror_zeta = 0.05;      // > 0
};

// Because the phase falls throughout, L crosses the negative real axis in one direction only: the closed loop is stable
// exactly when |L| < 1 at every such crossing.
struct Margins {
    bool stable = false;
    double gain_margin = std::numeric_limits<double>::infinity();  // factor of gain that reaches the limit
    double limit_rad_s = std::numeric_limits<double>::infinity();  // where it then oscillates
    double crossover_rad_s = 0.0;                                  // the first w with |L| = 1
    double phase_margin_deg = 0.0;  // stable: the nearest approach to -180 (mod 360) where |L| = 1; unstable: below 0
};

// accuracy  1e-10 relative, by bisection of the phase and of |L| between the extrema of its resonance.
// errors    DesignError for a member out of its range.
[[nodiscard]] Margins margins(const PerimeterLoop& loop);

// The integrator on samples: dl[k+1] = dl[k] - g dl[k - d], g = T/tau, d whole samples of delay; z^(d+1) - z^d + g.
//
// stability limit    g < 2 sin( pi / (2 (2d + 1)) ):    2 without delay, 1 with one sample
//
// delay_samples  0..1000.
// errors         DesignError for a delay outside.
[[nodiscard]] double sampled_stability_limit(int delay_samples);
}  // namespace zlg::design
