#include "high_voltage.hpp"

#include <utility>

#include <zlg/core/common/maths.hpp>

#include "laser/laser.hpp"

namespace zlg::twin {

HighVoltage::HighVoltage(const TwinConfig& config, double usual_step_s)
    : middle_v_{0.5 * config.piezo.range_min_v + 0.5 * config.piezo.range_max_v},
      half_range_v_{0.5 * (config.piezo.range_max_v - config.piezo.range_min_v)},
      rc_s_{config.piezo.rc_s},
      slew_v_s_{config.piezo.slew_v_s},
      usual_step_s_{usual_step_s},
      usual_decay_{core::maths::exp(-usual_step_s / rc_s_)} {
    take_half_wave(config.piezo.half_wave_v);
}

double HighVoltage::take_half_wave(double half_wave_v) {
    const double before = std::exchange(lambda_per_v_, 0.5 / half_wave_v);
    half_range_lambda_ = lambda_per_v_ * half_range_v_;
    slew_lambda_s_ = lambda_per_v_ * slew_v_s_;
    slew_error_lambda_ = slew_lambda_s_ * rc_s_;
    return before > 0.0 ? lambda_per_v_ / before : 1.0;
}

double HighVoltage::followed(double v_lambda, double command_lambda, double dt_s) const {
    double error = command_lambda - v_lambda;
    if (std::abs(error) < negligible_lambda) return clamped(command_lambda);
    const double excess = std::abs(error) - slew_error_lambda_;
    if (excess > slew_lambda_s_ * dt_s) return clamped(v_lambda + std::copysign(slew_lambda_s_ * dt_s, error));
    double exponential_s = dt_s;
    if (excess > 0.0) {
        exponential_s -= excess / slew_lambda_s_;
        error = std::copysign(slew_error_lambda_, error);
    }
    const double decay = exponential_s == usual_step_s_ ? usual_decay_ : core::maths::exp(-exponential_s / rc_s_);
    return clamped(command_lambda - error * decay);
}

double HighVoltage::volts(double v_lambda) const { return middle_v_ + v_lambda / lambda_per_v_; }

double HighVoltage::lambda(double volts) const { return (volts - middle_v_) * lambda_per_v_; }

}  // namespace zlg::twin
