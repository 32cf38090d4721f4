#include "perimeter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {
namespace {

bool uses_set_points(const core::ActuatorFrame& frame, Loop loop) {
    return !frame.loop_closed || loop == Loop::digital;
}

void check(const core::ActuatorFrame& frame, Loop loop) {
    if (frame.polarity != 1 && frame.polarity != -1) {
        throw std::invalid_argument(fmt::format("actuator frame: polarity is {}, allowed is 1 or -1", frame.polarity));
    }
    if (!uses_set_points(frame, loop)) return;
    if (frame.n_set_points < 1 || frame.n_set_points > core::max_set_points) {
        throw std::invalid_argument(fmt::format("actuator frame: n_set_points is {}, allowed is 1..{}",
                                                frame.n_set_points, core::max_set_points));
    }
    for (std::size_t k = 0; k < frame.n_set_points; ++k) {
        if (!std::isfinite(frame.set_point_v[k])) {
            throw std::invalid_argument(
                fmt::format("actuator frame: set_point_v[{}] is {}, allowed is finite", k, frame.set_point_v[k]));
        }
    }
}

}  // namespace

Perimeter::Perimeter(const TwinConfig& config, int n_steps, std::shared_ptr<const ErrorSignal> signal)
    : config_{config},
      n_steps_{n_steps},
      step_s_{0.5 * config.gyro.tick_s / n_steps},
      stage_{config, step_s_},
      settled_lambda_{signal ? signal->settled_lambda() : 0.0},
      dac_{config.piezo.range_min_v, config.piezo.range_max_v, config.piezo.dac_bits},
      loop_{config, stage_, step_s_, n_steps, std::move(signal)},
      piezo_{config, step_s_},
      centre_{settled_lambda_} {
    set_points_.reserve(core::max_set_points);
    for (int k = 0; k <= n_steps; ++k) decay_.push_back(core::maths::exp(-k * step_s_ / config.perimeter.tau_s));
}

double Perimeter::voltage_v() const {
    return std::clamp(stage_.volts(v_), config_.piezo.range_min_v, config_.piezo.range_max_v);
}

void Perimeter::begin_half(const core::ActuatorFrame& frame, double drift_start_lambda, double drift_end_lambda,
                           const FaultyHalf* faulty) {
    check(frame, config_.perimeter.loop);
    faulty_ = faulty;
    drift_start_ = drift_start_lambda;
    drift_step_ = (drift_end_lambda - drift_start_lambda) / n_steps_;
    steps_done_ = 0;
    drift_ = drift_at(0);

    const bool closes = frame.loop_closed && !closed_;
    const bool aims = !frame.loop_closed && (closed_ || frame.polarity != polarity_);
    if (aims) leave(frame.polarity);
    closed_ = frame.loop_closed;
    polarity_ = frame.polarity;
    if (closes) close();
    if (uses_set_points(frame, config_.perimeter.loop)) take_set_points(frame);
    if (aims) aim();
    if (config_.perimeter.loop == Loop::exponential && closed_) {
        amplitude_ = miss_at_closing_ *
                     core::maths::exp(-halves_since_closing_ * (0.5 * config_.gyro.tick_s) / config_.perimeter.tau_s);
        halves_since_closing_ += 1.0;
    }
    mode_ = lasing_mode(length_lambda());
}

bool Perimeter::live(std::span<double> length) {
    if (live_linear(length)) return true;
    length.front() = length_lambda();
    for (double& after : length.subspan(1)) {
        step();
        after = length_lambda();
    }
    return false;
}

void Perimeter::step() {
    ++steps_done_;
    const double drift_before = drift_;
    drift_ = drift_at(steps_done_);
    if (!closed_ || config_.perimeter.loop == Loop::digital) {
        follow_set_points();
    } else if (is_dark()) {
        v_ = stage_.followed(v_, command_, step_s_);  // no error signal: the integrator holds
    } else if (config_.perimeter.loop == Loop::analog) {
        // What the piezo adds to the voltage is taken as still for a step of the loop: 1e-4 wavelength in a fast move.
        const AnalogLoop::State end =
            loop_.step({command_, v_}, mode_, polarity_, drift_before + excess_, drift_ + excess_);
        command_ = end.command_lambda;
        v_ = end.v_lambda;
    } else {
        follow_exponential();
    }
    if (!piezo_.is_ideal()) excess_ = piezo_.move(v_) - v_;
    mode_ = lasing_mode(length_lambda());
}

// Between switches, and without a fault, the closed loop of an ideal piezo is a small linear system.
bool Perimeter::live_linear(std::span<double> length) {
    if (!closed_ || config_.perimeter.loop != Loop::analog || faulty_ || !piezo_.is_ideal()) return false;
    AnalogLoop::State state{command_, v_};
    const double drift_end = drift_at(n_steps_);
    if (!loop_.live_through(state, mode_, polarity_, drift_, drift_end, length)) return false;
    command_ = state.command_lambda;
    v_ = state.v_lambda;
    drift_ = drift_end;
    steps_done_ = n_steps_;
    mode_ = lasing_mode(length_lambda());
    return true;
}

void Perimeter::take_half_wave(double half_wave_v) {
    const double growth = stage_.take_half_wave(half_wave_v);
    loop_.take_stage(stage_);
    v_ *= growth;
    command_ *= growth;
    injected_ *= growth;
    if (piezo_.is_ideal()) return;
    piezo_.scale(growth);
    excess_ *= growth;
}

double Perimeter::leap(std::int64_t halves, double drift_lambda, double half_wave_v) {
    const double set_point = set_points_.empty() ? v_ : set_points_.back();
    const double before_v = stage_.volts(set_point);
    const double growth = stage_.take_half_wave(half_wave_v);
    loop_.take_stage(stage_);
    const double passed = drift_lambda - drift_;
    v_ -= passed;
    command_ -= passed;
    // The error of the second input is one of a voltage, which stays.
    const double after = set_point + injected_ - passed - growth * injected_;
    injected_ *= growth;
    drift_ = drift_lambda;
    halves_since_closing_ += static_cast<double>(halves);
    return stage_.volts(after) - before_v;
}

double Perimeter::voltage_after(double drift_lambda, double half_wave_v) const {
    HighVoltage stage = stage_;
    stage.take_half_wave(half_wave_v);
    return stage.volts(v_ - (drift_lambda - drift_));
}

void Perimeter::take_set_points(const core::ActuatorFrame& frame) {
    set_points_.clear();
    for (std::size_t k = 0; k < frame.n_set_points; ++k) {
        set_points_.push_back(stage_.lambda(dac_.quantised_v(frame.set_point_v[k])));
    }
}

// The miss is an error of the step with which a gyro that holds a mode goes to the other helicity. What is not such a
// step has none: the way back to a place that was held, a search, and a second attempt out of the mode from which the
// last one failed.
void Perimeter::leave(int polarity) {
    if (closed_) {
        const bool is_lit = !(faulty_ && faulty_->light.front().is_dark());
        const bool is_held = mode_.helicity() == polarity_ && std::abs(mode_.detuning_lambda) <= held_lambda;
        held_before_ = is_lit && is_held ? polarity_ : 0;
    }
    has_miss_ = config_.perimeter.miss_lambda > 0.0 && held_before_ == -polarity && missed_from_ != held_before_;
}

// Choose the error of the second input so that the move ends short of the centre by the miss that is asked for, and off
// that by what a fault adds.
void Perimeter::aim() {
    switch_error_ = faulty_ ? faulty_->switch_error_lambda : 0.0;
    injected_ = switch_error_;
    direction_ = set_points_.back() >= v_ ? 1.0 : -1.0;
    if (!has_miss_) return;
    const double target = piezo_.length_at(set_points_.back()) + drift_;
    const double short_of = direction_ * config_.perimeter.miss_lambda;
    const double wanted = nearest_centre_lambda(polarity_, target) - short_of;
    injected_ = piezo_.is_ideal() ? wanted - target : piezo_.voltage_for(wanted - drift_) - set_points_.back();
    injected_ += switch_error_;
}

// The voltage for a length of the piezo. Where it lies out of range, the next mode of this helicity takes it:
// validation made sure that the range holds one.
double Perimeter::pinned_at(double piezo_length_lambda) const {
    double v = piezo_.voltage_for(piezo_length_lambda);
    for (int turn = 0; turn < 4 && v != stage_.clamped(v); ++turn) {
        piezo_length_lambda += v > stage_.clamped(v) ? -1.0 : 1.0;
        v = piezo_.voltage_for(piezo_length_lambda);
    }
    return stage_.clamped(v);
}

// At closing the miss is put in place exactly.
void Perimeter::close() {
    if (has_miss_) {
        missed_from_ = held_before_;
        const double short_of = direction_ * config_.perimeter.miss_lambda;
        const double centre = nearest_centre_lambda(polarity_, length_lambda() - switch_error_ + short_of);
        v_ = pinned_at(centre - short_of - drift_ + switch_error_);
        if (!piezo_.is_ideal()) {
            piezo_.jump(v_);
            excess_ = piezo_.length_at(v_) - v_;
        }
        // At the last set-point of the open loop the voltage stays there; what an outer loop adds from now on, acts.
        injected_ = v_ - set_points_.back();
    }
    command_ = v_;
    centre_ = nearest_centre_lambda(polarity_, length_lambda()) + settled_lambda_;
    miss_at_closing_ = length_lambda() - centre_;
    halves_since_closing_ = 0.0;
}

// Set-point k holds over [k, k + 1)/n of the half; a change within a step splits it.
void Perimeter::follow_set_points() {
    const int n = static_cast<int>(set_points_.size());
    int from = (steps_done_ - 1) * n;  // in steps / n, so that all borders are whole
    const int to = steps_done_ * n;
    while (from < to) {
        const int k = from / n_steps_;
        const int until = std::min(to, (k + 1) * n_steps_);
        const double dt_s = until - from == n ? step_s_ : step_s_ * (until - from) / n;
        v_ = stage_.followed(v_, set_points_[static_cast<std::size_t>(k)] + injected_, dt_s);
        from = until;
    }
}

void Perimeter::follow_exponential() {
    v_ = stage_.clamped(centre_ + amplitude_ * decay_[static_cast<std::size_t>(steps_done_)] - drift_);
}

}  // namespace zlg::twin
