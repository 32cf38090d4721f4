#pragma once
// The motion that a configuration describes, also where that is a recorded one.

#include <zlg/config/config.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::recorded {

// As rig::motion; of the kind "file", what the motion file holds.
//
// errors  logs::IoError, logs::FormatError: also a number that is missing, or rows that are, by the times of the
// others;
//         config::ConfigError: a column of times by default, times that contradict motion.rate_hz, a file that can be
//         read in two ways.
[[nodiscard]] twin::Motion motion(const config::Config& config);

}  // namespace zlg::recorded
