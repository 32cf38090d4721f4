#include "analog_loop.hpp"

#include <algorithm>
#include <utility>

namespace zlg::twin {
namespace {

// exp(A t) of A = [[0, -1/tau], [1/rc, -1/rc]], by its eigenvalues.
void exponential(double tau_s, double rc_s, double t_s, double (&result)[2][2]) {
    const double mean = -0.5 / rc_s;
    const double determinant = 1.0 / (tau_s * rc_s);
    const double spread_sq = mean * mean - determinant;
    double even = 0.0;   // the part that multiplies 1
    double odd_s = 0.0;  // the part that multiplies A - mean
    if (spread_sq > 0.0) {
        // The slow root from the product of both: the difference would cancel where rc is short.
        const double fast = mean - std::sqrt(spread_sq);
        const double slow = determinant / fast;
        even = 0.5 * (std::exp(slow * t_s) + std::exp(fast * t_s));
        odd_s = -std::exp(slow * t_s) * std::expm1((fast - slow) * t_s) / (slow - fast);
    } else {
        const double turn = std::sqrt(-spread_sq) * t_s;
        even = std::exp(mean * t_s) * std::cos(turn);
        odd_s = std::exp(mean * t_s) * t_s * (turn > 0.0 ? std::sin(turn) / turn : 1.0);
    }
    result[0][0] = even - odd_s * mean;
    result[0][1] = -odd_s / tau_s;
    result[1][0] = odd_s / rc_s;
    result[1][1] = even + odd_s * (-1.0 / rc_s - mean);
}

}  // namespace

AnalogLoop::AnalogLoop(const TwinConfig& config, const HighVoltage& stage, double step_s,
                       std::shared_ptr<const ErrorSignal> signal)
    : stage_{stage},
      tau_s_{config.perimeter.tau_s},
      limit_lambda_{config.perimeter.limit_lambda},
      step_s_{step_s},
      steps_per_s_{1.0 / step_s},
      n_substeps_{1},
      signal_{std::move(signal)},
      settled_lambda_{signal_ ? signal_->settled_lambda() : 0.0},
      straight_lambda_{signal_ ? signal_->straight_lambda() : two_way_limit_lambda} {
    // A quarter of the fastest time constant leaves the fourth-order rule 1e-6 of error; 10 us does the same where the
    // limiter or the current limit bends the motion.
    const double fastest_s = std::min({tau_s_, stage_.rc_s(), std::sqrt(tau_s_ * stage_.rc_s())});
    n_substeps_ = static_cast<int>(std::ceil(step_s / std::min(10e-6, 0.25 * fastest_s)));
    exponential(tau_s_, stage_.rc_s(), step_s, propagator_);
}

double AnalogLoop::signal_at(double perimeter_lambda) const {
    if (signal_) return signal_->at(perimeter_lambda);
    const Mode mode = lasing_mode(perimeter_lambda);
    return mode.two_way() ? mode.helicity() * mode.detuning_lambda : 0.0;
}

AnalogLoop::State AnalogLoop::rates(State state, int polarity, double drift_lambda) const {
    const double signal = polarity * signal_at(state.v_lambda + drift_lambda);
    return {-std::clamp(signal, -limit_lambda_, limit_lambda_) / tau_s_,
            stage_.rate_lambda_s(state.v_lambda, state.command_lambda)};
}

AnalogLoop::State AnalogLoop::runge_kutta(State state, int polarity, double drift_start, double drift_end) const {
    const double h = step_s_ / n_substeps_;
    const double drift_step = (drift_end - drift_start) / n_substeps_;
    const auto moved = [](State s, State rate, double dt) {
        return State{s.command_lambda + dt * rate.command_lambda, s.v_lambda + dt * rate.v_lambda};
    };
    for (int i = 0; i < n_substeps_; ++i) {
        const double drift = drift_start + i * drift_step;
        const State k1 = rates(state, polarity, drift);
        const State k2 = rates(moved(state, k1, 0.5 * h), polarity, drift + 0.5 * drift_step);
        const State k3 = rates(moved(state, k2, 0.5 * h), polarity, drift + 0.5 * drift_step);
        const State k4 = rates(moved(state, k3, h), polarity, drift + drift_step);
        state = moved(moved(state, k1, h / 6.0), k2, h / 3.0);
        state = moved(moved(state, k3, h / 3.0), k4, h / 6.0);
        // The integrator stops at the ends of the range: what it gathered beyond them would delay its way back.
        state = {stage_.clamped(state.command_lambda), stage_.clamped(state.v_lambda)};
    }
    return state;
}

}  // namespace zlg::twin
