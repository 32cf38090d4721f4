#pragma once
// The loop of twin and control, one half-period at a time.

#include <cstdint>
#include <optional>

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_compensation.hpp>
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

    // The light samples of the half before, until the next `advance`.
    [[nodiscard]] core::LightSamples light() const;

private:
    // Compensation beside the control, for a schedule that asks for what is measured.
    struct Adviser {
        core::GyroCompensationConfig config;
        core::GyroCompensationState state{};
    };

    ClosedLoop(const config::Config& config, std::int64_t end_tick, twin::Motion&& motion);

    twin::Twin twin_;
    core::GyroControlConfig control_config_;
    core::GyroControlState control_state_;
    core::ActuatorFrame actuator_;
    core::SensorFrame sensor_{};
    std::optional<Adviser> adviser_;
};

}  // namespace zlg::rig
