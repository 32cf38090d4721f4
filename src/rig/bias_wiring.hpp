#pragma once
// What is presumed of the bias: its plateau, how fast its fringes are counted, when it is reversed.

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_control.hpp>

namespace zlg::rig {

// Plateau of the bias over its mean in a half with linear edges.
[[nodiscard]] double plateau_ratio(const config::Gyro& gyro);

// Fringe rate that the counter follows: a hundredth above 400 deg/s and the bias, unless it is given.
[[nodiscard]] double counter_max_hz(const config::Gyro& gyro);

// errors  config::ConfigError where a half has no room for the shifts of gyro.dither.
[[nodiscard]] core::BiasCommutatorConfig commutator_of(const config::Config& config);

}  // namespace zlg::rig
