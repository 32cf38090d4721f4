#pragma once
// The closed analog loop: an integrator behind a limiter drives the high-voltage stage.
//
//   d(command)/dt = -clip(polarity helicity dl, +-limit)/tau        dl = v + drift - centre
//   dv/dt         = clip((command - v)/rc, +-slew)
//
// helicity and dl are those of the mode that lases: with the wrong mode the loop pushes away. Without two-way light the
// integrator holds. With the light of a laser, its own signal takes the place of helicity dl, whatever is lit. Where
// nothing clips or bends, one step is a matrix; elsewhere it is Runge-Kutta.

#include <cmath>
#include <memory>

#include <zlg/twin/twin_config.hpp>

#include "high_voltage.hpp"
#include "laser/error_signal.hpp"
#include "laser/laser.hpp"

namespace zlg::twin {

inline double without_dust(double lambda) { return std::abs(lambda) < negligible_lambda ? 0.0 : lambda; }

class AnalogLoop {
public:
    struct State {
        double command_lambda;
        double v_lambda;
    };

    // signal  of a laser; null: the linear law.
    AnalogLoop(const TwinConfig& config, const HighVoltage& stage, double step_s,
               std::shared_ptr<const ErrorSignal> signal);

    // One step from `state`, in which `mode` lases, while the perimeter's own length moves evenly from drift_start to
    // drift_end.
    [[nodiscard]] State step(State state, const Mode& mode, int polarity, double drift_start_lambda,
                             double drift_end_lambda) const;

    void take_stage(const HighVoltage& stage) { stage_ = stage; }

private:
    [[nodiscard]] bool is_linear(State state, double detuning_lambda) const;
    [[nodiscard]] double signal_at(double perimeter_lambda) const;
    [[nodiscard]] State rates(State state, int polarity, double drift_lambda) const;
    [[nodiscard]] State runge_kutta(State state, int polarity, double drift_start, double drift_end) const;

    HighVoltage stage_;
    double tau_s_;
    double limit_lambda_;
    double step_s_;
    double steps_per_s_;
    int n_substeps_;
    double propagator_[2][2];  // over (command, v), both relative to the steady state
    std::shared_ptr<const ErrorSignal> signal_;
    double settled_lambda_;   // detuning at which the signal is zero
    double straight_lambda_;  // and how far from there it is straight
};

// detuning_lambda  from where the loop settles.
inline bool AnalogLoop::is_linear(State state, double detuning_lambda) const {
    return std::abs(detuning_lambda) <= limit_lambda_ && std::abs(detuning_lambda) < straight_lambda_ &&
           stage_.is_linear(state.v_lambda, state.command_lambda);
}

// In x = (command + drift - centre, v + drift - centre) a drift that grows evenly is a constant push (r, r), which
// shifts the state of rest to (tau - rc, tau) r.
inline AnalogLoop::State AnalogLoop::step(State state, const Mode& mode, int polarity, double drift_start,
                                          double drift_end) const {
    const double detuning = mode.detuning_lambda - settled_lambda_;
    if (mode.helicity() != polarity || !is_linear(state, detuning)) {
        return runge_kutta(state, polarity, drift_start, drift_end);
    }
    const double drift_lambda_s = (drift_end - drift_start) * steps_per_s_;
    const double rest_v = tau_s_ * drift_lambda_s;
    const double rest_command = rest_v - stage_.rc_s() * drift_lambda_s;
    const double x_v = detuning - rest_v;
    const double x_command = detuning + (state.command_lambda - state.v_lambda) - rest_command;
    const double end_v = rest_v + without_dust(propagator_[1][0] * x_command + propagator_[1][1] * x_v);
    const double end_command = rest_command + without_dust(propagator_[0][0] * x_command + propagator_[0][1] * x_v);
    const double origin = 0.5 * static_cast<double>(mode.centre_half_lambda) + settled_lambda_ - drift_end;
    const State end{origin + end_command, origin + end_v};
    return is_linear(end, end_v) ? end : runge_kutta(state, polarity, drift_start, drift_end);
}

}  // namespace zlg::twin
