#pragma once
// The compensation that a configuration asks for, of a gyro that runs.

#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_compensation.hpp>

namespace zlg::rig {

// compensation.relock; where it is unset, mean_square, for whose columns a gyro that runs has the light.
[[nodiscard]] core::RelockMethod asked_relock(const config::Config& config);

// errors  config::ConfigError, as `compensation_config`.
[[nodiscard]] core::GyroCompensationConfig asked_compensation(const config::Config& config);

// What an angle log says of itself: the settings on which its angles rest, `asked_relock` among them.
[[nodiscard]] config::Settings angle_settings(config::Config config);

}  // namespace zlg::rig
