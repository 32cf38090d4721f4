#pragma once
// The loop of twin and control, one half-period at a time.

#include <cstdint>
#include <span>

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/core/records.hpp>
#include <zlg/twin/twin.hpp>

namespace zlg::rig {

struct LoopHalf {
    core::HalfRecord record{};          // what the raw log holds
    core::GyroControlOutput control{};  // health and switch events beside it
    twin::TwinTruth truth{};            // what no gyro knows
    double half_wave_v = 0.0;           // present estimate of U_lambda/2, and its standard deviation
    double half_wave_sigma_v = 0.0;
};

class ClosedLoop {
public:
    // errors  config::ConfigError where the configuration does not make a gyro, or the motion file cannot be read.
    ClosedLoop(const config::Config& config, twin::Motion motion);

    LoopHalf advance();

    // The light samples of beam A in the half before, until the next `advance`.
    [[nodiscard]] std::span<const float> light() const;

private:
    twin::Twin twin_;
    core::GyroControlConfig control_config_;
    core::GyroControlState control_state_;
    core::ActuatorFrame actuator_;
    core::SensorFrame sensor_{};
};

}  // namespace zlg::rig
