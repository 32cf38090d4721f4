#pragma once
// Compensation as the configuration and a raw log together ask for it.

#include <string>

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/logs/raw_log.hpp>

namespace zlg::cli {

// mean_square where the log has what it needs, none where not; an explicit method is obeyed or refused.
//
// errors  config::ConfigError: the log lacks the column that the method needs.
[[nodiscard]] core::RelockMethod choose_relock(const config::Config& config, const logs::RawHeader& header,
                                               const std::string& path);

// errors  config::ConfigError: edges that are shifted and longer than half a tick.
[[nodiscard]] core::GyroCompensationConfig compensation_of(const config::Config& config, core::RelockMethod relock,
                                                           const logs::RawHeader& header, const std::string& path);

}  // namespace zlg::cli
