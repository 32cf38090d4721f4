#pragma once
// The motion that a configuration describes, also where that is a recorded one.

#include <zlg/config/config.hpp>
#include <zlg/logs/text_columns.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::recorded {

// How a motion file is read, by the section [motion].
[[nodiscard]] logs::TextLayout text_layout(const config::Motion& motion);

// As rig::motion; of the kind "file", what the motion file holds.
//
// errors  logs::IoError, logs::FormatError: also a number that is missing, or rows that are, by the times of the
// others;
//         config::ConfigError: a column of times by default, times that contradict motion.rate_hz.
[[nodiscard]] twin::Motion motion(const config::Config& config);

}  // namespace zlg::recorded
