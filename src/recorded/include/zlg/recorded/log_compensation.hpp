#pragma once
// The compensation of a recorded log: what its columns allow of what the configuration asks for.

#include <string>
#include <vector>

#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/replay.hpp>

namespace zlg::recorded {

struct LogCompensation {
    config::Config config;  // as it was given, with compensation.relock decided
    core::GyroCompensationConfig compensation;
    std::string presumed;         // one line: constants that neither log nor configuration gives; empty: none is used
    bool lacks_detuning = false;  // for that reason alone nothing is subtracted after a closing
    std::vector<std::string> notes;     // what is done in place of what was asked or logged, a line each
    std::vector<std::string> warnings;  // what was asked and is not done
};

// What a log says of itself, and over it the keys that `said` was given.
//
// errors  logs::FormatError for the log's settings; config::ConfigError: a tick or scale that nobody says or that are
//         contradicted, and what else the compensation of a log depends on.
[[nodiscard]] config::Config config_of_log(const config::Config& said, const config::Settings& of_log,
                                           const std::string& path, bool scale_is_used = true);

// compensation.relock unset: mean_square where the log has the column for it, none where not; an explicit method is
// obeyed or refused.
//
// The log's detunings have come through the curve that its settings name; where these name none, they come through that
// of [perimeter] here.
//
// config    what the user asks for over the settings of the log, or without them.
// log_name  begins every line.
// errors    config::ConfigError: the log lacks the column that the method needs; edges are shifted and longer than half
// a tick, or
//           their timer is none; those of `rig::compensation_config`.
[[nodiscard]] LogCompensation log_compensation(const config::Config& config, const logs::RawHeader& log,
                                               const std::string& log_name);

// How the detunings of a log were read: the curve that it names, or none, and its slope, or that of the configuration.
//
// errors  config::ConfigError for the log's settings.
[[nodiscard]] config::Config as_recorded(config::Config config, const config::Settings& log_settings,
                                         const std::string& log_name);

// errors  logs::FormatError where the halves that were replayed hold no whole tick.
void require_a_tick(const rig::Replay& replay, const std::string& log_name);

}  // namespace zlg::recorded
