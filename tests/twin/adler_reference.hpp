#pragma once
// Adler's equation by a general integrator of eighth order, which knows nothing of Moebius maps.

#include <boost/numeric/odeint/stepper/runge_kutta4_classic.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <zlg/twin/beat_phase.hpp>

#include "test.hpp"

namespace zlg::twin {

struct AdlerRamp {
    double start_hz = 0.0;
    double end_hz = 0.0;
    Coupling coupling{};
    double duration_s = 0.0;
};

template <class Stepper> double adler_steps(const AdlerRamp& r, double start_turns, int n) {
    using State = std::array<double, 1>;
    constexpr double tau = 2.0 * std::numbers::pi;
    const double lock = tau * std::abs(r.coupling);
    const double phi = std::arg(r.coupling);
    const double slope = tau * (r.end_hz - r.start_hz) / r.duration_s;
    const auto rhs = [&](const State& psi, State& dpsi, double t) {
        dpsi[0] = tau * r.start_hz + slope * t - lock * std::sin(psi[0] + phi);
    };
    Stepper stepper;
    State psi{tau * start_turns};
    const double h = r.duration_s / n;
    for (int i = 0; i < n; ++i) stepper.do_step(rhs, psi, i * h, h);
    return psi[0] / tau;
}

// Turns after the ramp, to 1e-11 of a turn where that is not the rounding of the turns themselves.
inline double adler_reference(const AdlerRamp& r, double start_turns) {
    const double fastest = std::max({std::abs(r.start_hz), std::abs(r.end_hz), std::abs(r.coupling)});
    const int n = 40 + static_cast<int>(2.0 * std::numbers::pi * fastest * r.duration_s / 0.15);
    return adler_steps<boost::numeric::odeint::runge_kutta_fehlberg78<std::array<double, 1>>>(r, start_turns, n);
}

}  // namespace zlg::twin
