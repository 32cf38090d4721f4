#pragma once
// When the gyro switches.

#include <cstdint>

#include <zlg/config/config.hpp>
#include <zlg/core/control/switch_schedule.hpp>

namespace zlg::rig {

// Whole ticks of a time, 1 at least.
[[nodiscard]] std::int64_t ticks_of(double time_s, double tick_s);

// errors  config::ConfigError for an interval that is still "optimal".
[[nodiscard]] core::SwitchScheduleConfig schedule_of(const config::Config& config);

}  // namespace zlg::rig
