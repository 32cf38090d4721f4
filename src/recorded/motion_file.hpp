#pragma once
// A recorded motion, as [motion] describes its file.

#include <zlg/config/config.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::recorded {

// errors  logs::IoError, logs::FormatError: also a number that is missing, or rows that are, by the times of the
// others;
//         config::ConfigError: a column of times by default, times that contradict motion.rate_hz.
[[nodiscard]] twin::Motion motion_of_file(const config::Motion& motion);

}  // namespace zlg::recorded
