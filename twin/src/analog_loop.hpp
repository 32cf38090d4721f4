#pragma once
// The closed analog loop: an integrator behind a limiter drives the high-voltage stage.
//
//   d(command)/dt = -clip(polarity helicity dl, +-limit)/tau        dl = v + drift - centre
//   dv/dt         = clip((command - v)/rc, +-slew)
//
// helicity and dl are those of the mode that lases: with the wrong mode the loop pushes away. Without two-way light the
// integrator holds. Where nothing clips, one step is a matrix; elsewhere it is Runge-Kutta.

#include <zlg/twin/twin.hpp>

#include "high_voltage.hpp"
#include "laser.hpp"

namespace zlg::twin {

class AnalogLoop {
public:
    struct State {
        double command_lambda;
        double v_lambda;
    };

    AnalogLoop(const TwinConfig& config, const HighVoltage& stage, double step_s);

    // One step from `state`, in which `mode` lases, while the perimeter's own length moves evenly from drift_start to
    // drift_end.
    [[nodiscard]] State step(State state, const Mode& mode, int polarity, double drift_start_lambda,
                             double drift_end_lambda) const;

private:
    [[nodiscard]] bool is_linear(State state, double detuning_lambda) const;
    [[nodiscard]] State rates(State state, int polarity, double drift_lambda) const;
    [[nodiscard]] State runge_kutta(State state, int polarity, double drift_start, double drift_end) const;

    HighVoltage stage_;
    double tau_s_;
    double limit_lambda_;
    double step_s_;
    double steps_per_s_;
    int n_substeps_;
    double propagator_[2][2];  // over (command, v), both relative to the steady state
};

}  // namespace zlg::twin
