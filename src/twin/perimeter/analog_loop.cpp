#include "analog_loop.hpp"

#include <algorithm>
#include <utility>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {

AnalogLoop::AnalogLoop(const TwinConfig& config, const HighVoltage& stage, double step_s, int n_steps,
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
    tabulate(n_steps);
}

// A = [[0, -1/tau], [1/rc, -1/rc]], by its eigenvalues.
AnalogLoop::Propagator AnalogLoop::propagator(double t_s) const {
    const double rc_s = stage_.rc_s();
    const double mean = -0.5 / rc_s;
    const double determinant = 1.0 / (tau_s_ * rc_s);
    const double spread_sq = mean * mean - determinant;
    double even = 0.0;   // the part that multiplies 1
    double odd_s = 0.0;  // the part that multiplies A - mean
    if (spread_sq > 0.0) {
        // The slow root from the product of both: the difference would cancel where rc is short.
        const double fast = mean - std::sqrt(spread_sq);
        const double slow = determinant / fast;
        even = 0.5 * (core::maths::exp(slow * t_s) + core::maths::exp(fast * t_s));
        odd_s = -core::maths::exp(slow * t_s) * core::maths::expm1((fast - slow) * t_s) / (slow - fast);
    } else {
        const double turn = std::sqrt(-spread_sq) * t_s;
        even = core::maths::exp(mean * t_s) * core::maths::cos(turn);
        odd_s = core::maths::exp(mean * t_s) * t_s * (turn > 0.0 ? core::maths::sin(turn) / turn : 1.0);
    }
    return {without_dust(even - odd_s * mean), without_dust(-odd_s / tau_s_), without_dust(odd_s / rc_s),
            without_dust(even + odd_s * (-1.0 / rc_s - mean))};
}

void AnalogLoop::tabulate(int n_steps) {
    const auto grow = [](double& largest, double entry) { largest = std::max(largest, std::abs(entry)); };
    of_step_ = propagator(step_s_);
    for (int k = 0; k <= n_steps; ++k) {
        of_half_ = propagator(k * step_s_);
        v_by_command_.push_back(of_half_.v_by_command);
        v_by_v_.push_back(of_half_.v_by_v);
        grow(reach_.command_by_command, of_half_.command_by_command);
        grow(reach_.command_by_v, of_half_.command_by_v);
        grow(reach_.v_by_command, of_half_.v_by_command);
        grow(reach_.v_by_v, of_half_.v_by_v);
        grow(reach_.lag_by_command, of_half_.command_by_command - of_half_.v_by_command);
        grow(reach_.lag_by_v, of_half_.command_by_v - of_half_.v_by_v);
    }
}

// As `step`. That every limit is kept at the end of each step is shown by a bound: each entry of the
// propagator at its largest.
bool AnalogLoop::live_through(State& state, const Mode& mode, int polarity, double drift_start, double drift_end,
                              std::span<double> length) const {
    if (mode.helicity() != polarity || step_s_ > 0.1 * tau_s_) return false;
    const auto n_steps = static_cast<double>(length.size() - 1);
    const double drift_lambda_s = (drift_end - drift_start) / n_steps * steps_per_s_;
    const double rest_v = tau_s_ * drift_lambda_s;
    const double rest_lag = -stage_.rc_s() * drift_lambda_s;
    const double rest_command = rest_v + rest_lag;
    const double centre = 0.5 * static_cast<double>(mode.centre_half_lambda) + settled_lambda_;
    const double y_v = mode.detuning_lambda - settled_lambda_ - rest_v;
    const double y_command =
        mode.detuning_lambda - settled_lambda_ + (state.command_lambda - state.v_lambda) - rest_command;
    const double c = std::abs(y_command);
    const double v = std::abs(y_v);
    const double detuning = std::abs(rest_v) + reach_.v_by_command * c + reach_.v_by_v * v;
    const double lag = std::abs(rest_lag) + reach_.lag_by_command * c + reach_.lag_by_v * v;
    const double command = std::abs(rest_command) + reach_.command_by_command * c + reach_.command_by_v * v +
                           std::max(std::abs(centre - drift_start), std::abs(centre - drift_end));
    if (!(detuning <= limit_lambda_ && detuning < straight_lambda_ && stage_.is_linear(command + lag, command)))
        return false;
    const double from = centre + rest_v;
    for (std::size_t k = 0; k < length.size(); ++k)
        length[k] = from + (v_by_command_[k] * y_command + v_by_v_[k] * y_v);
    const double end_v = without_dust(of_half_.v_by_command * y_command + of_half_.v_by_v * y_v);
    const double end_command = without_dust(of_half_.command_by_command * y_command + of_half_.command_by_v * y_v);
    state = {centre - drift_end + (rest_command + end_command), centre - drift_end + (rest_v + end_v)};
    return true;
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
