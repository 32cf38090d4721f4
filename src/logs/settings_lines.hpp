#pragma once
// The lines `# key = value` above a table.

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

// A number as TOML writes it; empty where it is none.
[[nodiscard]] std::optional<double> number_in(std::string text);

}  // namespace zlg::logs
