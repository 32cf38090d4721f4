#pragma once
// The compensation that a configuration asks for: of a gyro that runs, and of a log that one has recorded.

#include <string>
#include <vector>

#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/logs/raw_log.hpp>

namespace zlg::rig {

// compensation.relock; where it is unset, mean_square, for whose columns a gyro that runs has the light.
[[nodiscard]] core::RelockMethod asked_relock(const config::Config& config);

// Of a gyro that runs.
//
// errors  config::ConfigError, as `compensation_config`.
[[nodiscard]] core::GyroCompensationConfig asked_compensation(const config::Config& config);

struct LogCompensation {
    config::Config config;  // as it was given, with compensation.relock decided
    core::GyroCompensationConfig compensation;
    bool lacks_detuning = false;        // for that reason alone nothing is subtracted after a closing
    std::vector<std::string> notes;     // what is done in place of what was asked, a line each
    std::vector<std::string> warnings;  // what was asked and is not done
};

// Of a recorded log. compensation.relock unset: mean_square where the log has the column for it, none where not; an explicit
// method is obeyed or refused.
//
// The log's detunings have come through the curve that its settings name; where these name none, they come through that of
// [perimeter] here.
//
// config    what the user asks for over the settings of the log, or without them.
// log_name  begins every line.
// errors    config::ConfigError: the log lacks the column that the method needs; edges are shifted and longer than half a tick, or
//           their timer is none; those of `compensation_config`.
[[nodiscard]] LogCompensation asked_compensation(const config::Config& config, const logs::RawHeader& log,
                                                 const std::string& log_name);

// How the detunings of a log were read: the curve that it names, or none, and its slope, or that of the configuration.
//
// errors  config::ConfigError for the log's settings.
[[nodiscard]] config::Config as_recorded(config::Config config, const config::Settings& log_settings,
                                         const std::string& log_name);

// What an angle log says of itself: the settings on which its angles rest, `asked_relock` among them.
[[nodiscard]] config::Settings angle_settings(config::Config config);

}  // namespace zlg::rig
