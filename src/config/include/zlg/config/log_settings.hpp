#pragma once
// The settings of a log, before they are taken for a configuration.

#include <optional>
#include <string>
#include <string_view>

#include <zlg/config/schema.hpp>

namespace zlg::config {

// With the full names of tick_s and scale_arcsec, which a log may give without a section.
//
// errors  ConfigError: one of our keys stands twice with different values, or one is in a section that is nearly ours.
[[nodiscard]] Settings checked_log_settings(Settings log_settings, std::string_view log_name);

// A line that names the settings which a former version knew and `apply_log` steps over; nothing where there are none.
[[nodiscard]] std::optional<std::string> former_keys_note(const Settings& log_settings, std::string_view log_name);

}  // namespace zlg::config
