#pragma once
// One tick of the optical phase, by fixed-step RK4, by Boost.odeint and, to be held against, by eighth order.
//
//   psi' = 2 pi [rate + bias(B(t)) - f_L (I1 + I2)/(2 sqrt(I1 I2)) sin psi]
//
// B reverses linearly in 50 us and rests in between; bias and intensities are the laser's. They are read on the edges
// only, where the field moves.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <zlg/twin/four_wave.hpp>

namespace zlg::bench {

constexpr double tau = 2.0 * std::numbers::pi;
constexpr double tick_s = 0.005;
constexpr double half_edge_s = 25e-6;
constexpr double plateau_s = 0.5 * tick_s - 2.0 * half_edge_s;
constexpr double field_g = 15.0;
constexpr double lock_hz = 150.0;
constexpr double rate_hz = 12345.0;

// Fields at both ends of a part of a half, and its length.
struct Part {
    double from_g;
    double to_g;
    double duration_s;

    [[nodiscard]] bool is_edge() const { return from_g != to_g; }
};

constexpr std::array<Part, 6> tick_parts{{{0.0, field_g, half_edge_s},
                                          {field_g, field_g, plateau_s},
                                          {field_g, 0.0, half_edge_s},
                                          {0.0, -field_g, half_edge_s},
                                          {-field_g, -field_g, plateau_s},
                                          {-field_g, 0.0, half_edge_s}}};

// Laser  a table, or the equations themselves.
template <class Laser>
class Equation {
public:
    Equation(const Laser& laser, const Part& part) : laser_{laser}, part_{part} { see(part.from_g); }

    double operator()(double psi, double t) {
        if (part_.is_edge()) see(part_.from_g + (part_.to_g - part_.from_g) * t / part_.duration_s);
        return tau * (drive_hz_ - lock_hz_ * std::sin(psi));
    }

private:
    void see(double at_g) {
        const twin::WavePair pair = laser_.at(0.0, at_g).left;
        drive_hz_ = rate_hz + pair.bias_hz;
        lock_hz_ = 0.5 * lock_hz * (pair.cw + pair.ccw) / std::sqrt(pair.cw * pair.ccw);
    }

    const Laser& laser_;
    Part part_;
    double drive_hz_ = 0.0;
    double lock_hz_ = 0.0;
};

template <class Laser>
double rk4(const Laser& laser, const Part& part, double psi, double step_s) {
    Equation rhs{laser, part};
    const int n = static_cast<int>(std::ceil(part.duration_s / step_s));
    const double h = part.duration_s / n;
    for (int i = 0; i < n; ++i) {
        const double t = i * h;
        const double a = rhs(psi, t);
        const double b = rhs(psi + 0.5 * h * a, t + 0.5 * h);
        const double c = rhs(psi + 0.5 * h * b, t + 0.5 * h);
        const double d = rhs(psi + h * c, t + h);
        psi += h / 6.0 * (a + 2.0 * (b + c) + d);
    }
    return psi;
}

using State = std::array<double, 1>;

template <class Laser>
double dopri5(const Laser& laser, const Part& part, double psi, double tolerance_rad) {
    namespace odeint = boost::numeric::odeint;
    Equation rhs{laser, part};
    State state{psi};
    const auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(tolerance_rad, 0.0);
    const auto system = [&](const State& x, State& dx, double t) { dx[0] = rhs(x[0], t); };
    odeint::integrate_adaptive(stepper, system, state, 0.0, part.duration_s, 1e-7);
    return state[0];
}

// In steps of an eighth of a microsecond.
inline double exact(const twin::FourWave& laser, const Part& part, double psi) {
    Equation rhs{laser, part};
    const auto system = [&](const State& x, State& dx, double t) { dx[0] = rhs(x[0], t); };
    boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
    const int n = static_cast<int>(std::ceil(part.duration_s / 0.125e-6));
    State state{psi};
    for (int i = 0; i < n; ++i) stepper.do_step(system, state, i * part.duration_s / n, part.duration_s / n);
    return state[0];
}

// Phase before the first part of a tick, and after each.
using TickPhases = std::array<double, tick_parts.size() + 1>;

inline TickPhases exact_tick(const twin::FourWave& laser, double psi) {
    TickPhases phases{psi};
    for (std::size_t i = 0; i < tick_parts.size(); ++i) phases[i + 1] = exact(laser, tick_parts[i], phases[i]);
    return phases;
}

// Largest, of a whole tick and of one edge by itself.
struct Error {
    double tick_rad = 0.0;
    double edge_rad = 0.0;

    [[nodiscard]] bool is_within(const Error& allowed) const {
        return tick_rad <= allowed.tick_rad && edge_rad <= allowed.edge_rad;
    }
};

// step(part, psi)  the phase after a part.
template <class Step>
Error error_of(const std::vector<TickPhases>& ticks, const Step& step) {
    Error worst;
    for (const TickPhases& truth : ticks) {
        double psi = truth.front();
        for (std::size_t i = 0; i < tick_parts.size(); ++i) {
            const Part& part = tick_parts[i];
            psi = step(part, psi);
            if (!part.is_edge()) continue;
            worst.edge_rad = std::max(worst.edge_rad, std::abs(step(part, truth[i]) - truth[i + 1]));
        }
        worst.tick_rad = std::max(worst.tick_rad, std::abs(psi - truth.back()));
    }
    return worst;
}

}  // namespace zlg::bench
