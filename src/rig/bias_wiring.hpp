#pragma once
// What the control presumes of the bias: when it is reversed, and what its beat must look like.

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_control.hpp>

namespace zlg::rig {

// Plateau of the bias over its mean in a half with linear edges.
[[nodiscard]] double plateau_ratio(const config::Gyro& gyro);

// errors  config::ConfigError where a half has no room for the shifts of gyro.dither.
[[nodiscard]] core::BiasCommutatorConfig commutator_of(const config::Config& config);

// Arm the monitors. What of the bias and of the perimeter would be one count of a tick is not let pass.
void add_monitors(const config::Config& config, core::GyroControlConfig& made);

}  // namespace zlg::rig
