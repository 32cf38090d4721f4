#pragma once
// The lines `# key = value` above a table: the settings, and among them what a log says of itself.

#include <optional>
#include <string>
#include <string_view>
#include <zlg/logs/settings.hpp>
#include <zlg/logs/table_file.hpp>

namespace zlg::logs {

// errors  FormatError: a key or a value that does not stay on its line.
void require_one_line(const std::string& key, const std::string& value);

// errors  FormatError: a dotted key that would be a tree of such a depth as no setting has.
void require_shallow_keys(const Settings& settings, const std::string& place);

// errors  FormatError: a key or a value that does not stay on its line; IoError.
void write_settings(TableFile& file, const Settings& settings);

// Without blanks and tabs before and behind.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// A line `# key = value` is appended to `settings`; another remark is not.
void collect_setting(std::string_view line, Settings& settings);

// The value of the last setting of that name; null: there is none.
[[nodiscard]] const std::string* find_setting(const Settings& settings, const std::string& key);
// The same of `gyro.NAME` or, where that is none, `NAME`.
[[nodiscard]] const std::string* find_of_gyro(const Settings& settings, const std::string& name);

// A number as TOML writes it; empty where it is none.
[[nodiscard]] std::optional<double> number_in(std::string text);

// The timer of a raw log with shifted bias edges: among the settings of a CSV log, an attribute of the root of an HDF5
// log.
inline constexpr const char* timer_setting = "timer_hz";

// Takes timer_hz out of the settings; `of_root` is the attribute.
//
// errors  FormatError: there is none, two that differ, no number, or one out of range; `place` begins the message.
[[nodiscard]] double take_timer_hz(Settings& settings, std::optional<double> of_root, const std::string& place);

// errors  FormatError: not within 1..1e15; `place` begins the message.
void check_timer_hz(double timer_hz, const std::string& place);

// A line of a CSV log, an attribute of the root of an HDF5 log.
inline constexpr const char* version_setting = "format_version";

// Takes format_version out of the settings of the CSV log at `path`.
//
// errors  FormatError: no number, two that differ, none of the versions that there are.
[[nodiscard]] FormatVersion take_format_version(Settings& settings, const std::string& path);

// The fingerprint of a run: room that is made before the rows and filled when all of them are there.
inline constexpr std::size_t fingerprint_digits = 16;

// HDF5: a scalar text, zeros until it is filled.
inline constexpr const char* fingerprint_path = "/fingerprint";

// CSV: the first line of the file, with dots for the digits until it is filled.
inline constexpr std::string_view fingerprint_line = "# fingerprint = ";
inline constexpr std::string_view no_fingerprint = "................";

// errors  FormatError: not 16 hexadecimal digits in lower case; names `place`.
void require_fingerprint(const std::string& fingerprint, const std::string& place);

// errors  FormatError: the log at `path` was begun without room for one.
[[noreturn]] void refuse_fingerprint(const std::string& path);

// The fingerprint that stands among the lines of a CSV log, which it leaves; empty where there is none. A line of that
// name with another value is a note of a laboratory, and stays.
//
// errors  FormatError: two of them that differ; names `path`.
[[nodiscard]] std::string take_fingerprint(Settings& settings, const std::string& path);

}  // namespace zlg::logs
