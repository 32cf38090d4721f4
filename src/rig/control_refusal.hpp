#pragma once
// What the core's check refuses, in the words of the one who wrote the configuration.

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_control.hpp>

namespace zlg::rig {

// errors  config::ConfigError where the core's check refuses what was made of the configuration.
void require_control(const config::Config& config, const core::GyroControlConfig& made);

}  // namespace zlg::rig
