#pragma once
// The environment that a configuration describes, also where files hold it.

#include <zlg/config/config.hpp>

namespace zlg::recorded {

// The same with the points of its files, which keep their names: temperature.profile and field.course.
//
// errors  logs::IoError, logs::FormatError: also a number that is missing; config::ConfigError: points that are no
//         course.
[[nodiscard]] config::Config with_environment(config::Config config);

}  // namespace zlg::recorded
