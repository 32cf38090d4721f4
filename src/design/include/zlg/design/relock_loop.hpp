#pragma once
// The perimeter loop from its closing to the centre of the mode, by simulation, and the false angle it makes meanwhile.
//
//   d(cmd)/dt = clip(dl, +-limit)/tau     d(hv)/dt = clip((cmd - hv)/RC, +-slew)     dl = miss - hv
//
// The limiter is electronics behind the tap of the light samples, which are never limited. Time runs from the closing;
// a tick is two halves of T/2 with the bias of opposite signs.

#include <limits>
#include <vector>

namespace zlg::design {

struct RelockLoop {
    static constexpr double none = std::numeric_limits<double>::infinity();

    double tick_s = 0.005;        // T > 0
    double tau_s = 0.0065;        // > 0
    double limit_lambda = 0.09;   // > 0; none: no limiter
    double rc_s = 0.001;          // >= 0; 0: the stage follows at once
    double slew_lambda_s = 50.0;  // > 0; none: no limit
};

// How the detuning becomes false rotation: f = f0 (1 - chi dl^2), one count of scale.
struct BiasLaw {
    double scale_arcsec = 3.263;
    double bias_hz = 60e3;
    double chi = 3.6;
};

struct HalfDetuning {
    double mean_lambda = 0.0;
    double mean_square_lambda2 = 0.0;
};

struct RelockTrace {
    double step_s = 0.0;
    std::vector<double> detuning_lambda;  // every step, from the closing on
    std::vector<HalfDetuning> half;       // exact integrals of the simulation, two to a tick
};

// n_ticks from the closing. |miss_lambda| <= 0.5, 1..10000 ticks.
//
// accuracy  1e-9 of the miss for a smooth loop; 1e-7 wavelength where limiter or slew put corners inside steps, 2e-6
// from
//           4000 ticks on.
// errors    DesignError for a number out of range.
[[nodiscard]] RelockTrace simulate_relock(const RelockLoop& loop, double miss_lambda, int n_ticks);

// When |dl| falls to tolerance_lambda for good, within n_ticks; infinity if it does not.
[[nodiscard]] double relock_time_s(const RelockLoop& loop, double miss_lambda, double tolerance_lambda, int n_ticks);
[[nodiscard]] double relock_time_s(const RelockTrace& trace, double tolerance_lambda);  // of a simulation that was made

// Steps of such a simulation: some 1e7 a second, and 8 bytes of the trace each.
[[nodiscard]] double relock_steps(const RelockLoop& loop, int n_ticks);

// G(0+) = scale f0 chi dl0^2, deficit of the bias at the closing [arcsec/s].
[[nodiscard]] double bias_deficit_arcsec_s(const BiasLaw& law, double detuning_lambda);

// dOm_i = scale (chi f0/2) (<dl^2>_second - <dl^2>_first) * sign, sign of bias_sign*mode in the first half [arcsec/s].
[[nodiscard]] std::vector<double> false_drift_arcsec_s(const BiasLaw& law, const RelockTrace& trace, int first_sign);

// Total false angle of a re-lock, magnitude, by the loop-independent law: (T/4) G(0+), leading order in T over the time
// of the re-lock. For dl0 e^(-t/tau) the angle is G(0+) (tau/2) tanh(T/2tau), below the law by (T/2tau)^2/3.
[[nodiscard]] double false_angle_law_arcsec(double deficit_arcsec_s, double tick_s);

}  // namespace zlg::design
