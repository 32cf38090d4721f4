#pragma once
// The version of a log's format: which random numbers its seed names, and which keys and columns it may hold.

#include <optional>
#include <string>

namespace zlg::logs {

// From 2 on a configuration with its seed names the same run on every machine; version 1 had other random numbers.
inline constexpr int first_format_version = 1;
// Up to 2 a raw log could have the column coil_ua, and its settings keys that are gone since.
inline constexpr int format_version = 3;

// Of a log that says none it is not known.
using FormatVersion = std::optional<int>;

// `value` as it stands in the log at `place`.
//
// errors  FormatError: none of these.
[[nodiscard]] int checked_format_version(double value, const std::string& place);

}  // namespace zlg::logs
