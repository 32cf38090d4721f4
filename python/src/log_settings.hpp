#pragma once
// What stands above the rows of a log.

#include <string>

#include <zlg/config/schema.hpp>

namespace zlg::python {

// The settings with the full names of tick_s and scale_arcsec, which a log may give without a section.
//
// errors  ConfigError: a key that stands twice with different values, or in a section that is nearly one of ours.
[[nodiscard]] config::Settings log_settings(config::Settings settings, const std::string& name);

}  // namespace zlg::python
