#pragma once
// What a part refuses, in the words of the one who wrote the configuration: keys, their values, what is allowed.

#include <initializer_list>
#include <string>
#include <string_view>

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::rig {

// errors  config::ConfigError, always: `key = value, key = value: allowed is ...`, with what `named` adds.
[[noreturn]] void refuse(const config::Config& config, std::initializer_list<std::string_view> keys,
                         std::string_view allowed);

// errors  config::ConfigError where the core's check refuses what was made of the configuration.
void require_control(const config::Config& config, const core::GyroControlConfig& made);

// More than a counter of 64 bits can tell, or no number at all, shows only when the gyro runs.
[[noreturn]] void refuse_rate(const config::Config& config, std::string_view what);

}  // namespace zlg::rig
