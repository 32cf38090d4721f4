#pragma once
// The settings that stand above a log.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zlg::logs {

// Pairs of key and value in their order: lines `# key = value` of a CSV log, /config of an HDF5 log.
using Settings = std::vector<std::pair<std::string, std::string>>;

// Length of a tick by the setting `tick_s`; empty where none says a number above 0.
[[nodiscard]] std::optional<double> said_tick_s(const Settings& settings);

// The version of a log's format: which random numbers its seed names, and which keys and columns it may hold.
//
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

// What stands above the rows of a log of either kind.
struct LogHeader {
    Settings settings;                  // in their order
    std::vector<std::string> warnings;  // unknown columns that are ignored, one line each
    bool complete = true;               // false: an HDF5 log that is being written, or whose writer was interrupted
    std::string fingerprint;            // of the whole run, 16 hexadecimal digits; empty: not said, or not complete
    FormatVersion format_version;       // empty: not said
};

}  // namespace zlg::logs
