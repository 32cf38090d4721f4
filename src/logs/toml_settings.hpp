#pragma once
// Settings as the TOML text of an HDF5 log, and back.
//
// A log's settings are texts: what stood behind the equals sign. A text that is a TOML value becomes `key = text`, one
// that is none becomes a literal string, and what neither would bring back letter by letter becomes a comment line
// `# key = text`, as in a CSV log.

#include <string>
#include <string_view>
#include <zlg/logs/settings.hpp>

namespace zlg::logs {

// errors  FormatError: a setting with a line break or NUL.
[[nodiscard]] std::string settings_to_toml(const Settings& settings);

// Dotted keys in the order of their lines, values as they are spelled there; comment lines `# key = text` included.
//
// errors  FormatError: no valid TOML; `place` begins the message.
[[nodiscard]] Settings settings_from_toml(std::string_view text, const std::string& place);

}  // namespace zlg::logs
