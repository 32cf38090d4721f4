#pragma once
// The closed analog loop: an integrator behind a limiter drives the high-voltage stage.
//
//   d(command)/dt = -clip(polarity helicity dl, +-limit)/tau        dl = v + drift - centre
//   dv/dt         = clip((command - v)/rc, +-slew)
//
// helicity and dl are those of the mode that lases: with the wrong mode the loop pushes away. Without two-way light the
// integrator holds. With the light of a laser, its own signal takes the place of helicity dl, whatever is lit. Where
// nothing clips or bends, the motion is the exponential of a matrix, over one step or over any number of them;
// elsewhere it is Runge-Kutta.

#include <cmath>
#include <memory>
#include <span>
#include <vector>

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

    // n_steps  that a half is lived through in.
    // signal   of a laser; null: the linear law.
    AnalogLoop(const TwinConfig& config, const HighVoltage& stage, double step_s, int n_steps,
               std::shared_ptr<const ErrorSignal> signal);

    // One step from `state`, in which `mode` lases, while the perimeter's own length moves evenly from drift_start to
    // drift_end.
    [[nodiscard]] State step(State state, const Mode& mode, int polarity, double drift_start_lambda,
                             double drift_end_lambda) const;

    // All steps of a half at once, if the loop is sure to stay linear at the end of each of them; each length is that
    // of its steps to rounding. Steps of more than a tenth of a time constant are taken one by one: between their ends
    // the loop could do more than there.
    //
    // length_lambda  written: the perimeter at the start and after each step, n_steps + 1 numbers.
    // return         whether it was done; if not, neither `state` nor the lengths have changed.
    bool live_through(State& state, const Mode& mode, int polarity, double drift_start_lambda, double drift_end_lambda,
                      std::span<double> length_lambda) const;

    void take_stage(const HighVoltage& stage) { stage_ = stage; }

private:
    // exp(A t) over (command, v), both relative to the steady state.
    struct Propagator {
        double command_by_command = 1.0, command_by_v = 0.0;
        double v_by_command = 0.0, v_by_v = 1.0;
    };

    // The largest sizes that the entries reach within a half; the lag is command - v.
    struct Reach {
        double command_by_command = 0.0, command_by_v = 0.0;
        double v_by_command = 0.0, v_by_v = 0.0;
        double lag_by_command = 0.0, lag_by_v = 0.0;
    };

    [[nodiscard]] Propagator propagator(double time_s) const;
    void tabulate(int n_steps);
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
    Propagator of_step_{};
    Propagator of_half_{};
    std::vector<double> v_by_command_;  // after each step, and before the first
    std::vector<double> v_by_v_;
    Reach reach_{};
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
    const double end_v = rest_v + without_dust(of_step_.v_by_command * x_command + of_step_.v_by_v * x_v);
    const double end_command =
        rest_command + without_dust(of_step_.command_by_command * x_command + of_step_.command_by_v * x_v);
    const double origin = 0.5 * static_cast<double>(mode.centre_half_lambda) + settled_lambda_ - drift_end;
    const State end{origin + end_command, origin + end_v};
    return is_linear(end, end_v) ? end : runge_kutta(state, polarity, drift_start, drift_end);
}

}  // namespace zlg::twin
