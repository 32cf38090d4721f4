#pragma once
// What the monitors of the control hold a half against.

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_control.hpp>

namespace zlg::rig {

// Arm the monitors. What of the bias and of the perimeter would be one count of a tick is not let pass.
void add_monitors(const config::Config& config, core::GyroControlConfig& made);

}  // namespace zlg::rig
