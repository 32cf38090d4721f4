#pragma once
// The high-voltage stage: an RC lag whose current is limited.
//
//   dv/dt = clip((command - v)/rc, +-slew),  v within [-half_range, half_range]
//
// Voltages are expressed as the change of perimeter that they cause, in wavelengths, counted from the middle of the
// range.

#include <algorithm>
#include <cmath>

#include <zlg/twin/twin_config.hpp>

namespace zlg::twin {

class HighVoltage {
public:
    // usual_step_s  the step for which the decay is computed once.
    HighVoltage(const TwinConfig& config, double usual_step_s);

    // Exact response to a command that holds over dt_s.
    [[nodiscard]] double followed(double v_lambda, double command_lambda, double dt_s) const;

    [[nodiscard]] double rate_lambda_s(double v_lambda, double command_lambda) const {
        return std::clamp((command_lambda - v_lambda) / rc_s_, -slew_lambda_s_, slew_lambda_s_);
    }
    [[nodiscard]] double clamped(double v_lambda) const {
        return std::clamp(v_lambda, -half_range_lambda_, half_range_lambda_);
    }
    // True where neither the current limit nor the range is felt.
    [[nodiscard]] bool is_linear(double v_lambda, double command_lambda) const {
        return std::abs(command_lambda - v_lambda) <= slew_error_lambda_ &&
               std::abs(command_lambda) <= half_range_lambda_;
    }

    // Let the half-wave voltage change. A voltage that stays has from now on `return` times its length in wavelengths.
    double take_half_wave(double half_wave_v);

    [[nodiscard]] double volts(double v_lambda) const;
    [[nodiscard]] double lambda(double volts) const;
    [[nodiscard]] double rc_s() const { return rc_s_; }

private:
    double middle_v_;
    double half_range_v_;
    double rc_s_;
    double slew_v_s_;
    double lambda_per_v_ = 0.0;
    double half_range_lambda_ = 0.0;
    double slew_lambda_s_ = 0.0;
    double slew_error_lambda_ = 0.0;  // lag at which the current limit begins
    double usual_step_s_;
    double usual_decay_;
};

}  // namespace zlg::twin
