#pragma once
// The one table of all keys of a configuration: it reads, checks, writes and documents them.
//
// A configuration is built in layers, the later over the earlier: start from Config{} (the defaults), then `apply_log`,
// `apply_file`, `apply_set`, then `check`. Of all keys only gyro.tick_s and gyro.scale_arcsec describe how a log was
// recorded, so an explicit value that differs from the log's own is refused by `check_against_log`, called last.
// Every apply function either takes in its whole text or leaves the configuration as it was.

#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::config {

// A configuration that cannot be used: where it stands, key, value, what is allowed.
struct ConfigError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Dotted keys (`gyro.tick_s`) and their values as TOML, in the order of the table or of a log.
using Settings = std::vector<std::pair<std::string, std::string>>;

enum class ValueKind {
    real,
    optional_real,
    integer,
    text,
    reals,
    choice,
    choices,
    interval,
    column,
    points,
    optional_choice
};
inline constexpr std::array value_kind_names{"real",   "optional_real", "integer",        "text",
                                             "reals",  "choice",        "choices",        "interval",
                                             "column", "points",        "optional_choice"};

// What is known of one key.
struct KeyInfo {
    std::string section;
    std::string name;
    std::string unit;  // empty where it has none
    std::string meaning;
    std::string default_text;  // TOML; empty where it is unset
    std::string allowed;       // in words
    ValueKind kind{};
    std::vector<std::string> choices;  // of a choice
};

// TOML text; `source_name` begins the messages, as in `lab.toml:3: ...`.
//
// errors  ConfigError: TOML syntax, unknown section or key (the nearest known one is named), wrong type, out of range.
void apply_toml(Config& config, std::string_view text, std::string_view source_name);

// errors  ConfigError: as apply_toml; the file cannot be read.
void apply_file(Config& config, const std::string& path);

// One `section.key=value`. The value is read as TOML; what is not valid TOML is a string.
//
// errors  ConfigError: as apply_toml; no equals sign, no dot.
void apply_set(Config& config, std::string_view setting);

// One key with its value as in apply_set; `source_name` begins the messages.
void apply_pair(Config& config, std::string_view dotted_key, std::string_view value, std::string_view source_name);

// The settings of a log: those of a known section; others (`flags`, notes of the laboratory) are none of ours.
// Keys and values that a former version knew are stepped over (`former_keys_note` names them); elsewhere they are
// errors.
//
// errors  ConfigError: as apply_pair. It blames the log, not the user's configuration.
void apply_log(Config& config, const Settings& log_settings, std::string_view log_name);

// The length of a tick and the worth of a count are facts of a log that have no default: one of the layers of a
// configuration for a log must have given them.
//
// errors  ConfigError: none has given tick_s, or scale_arcsec where it is used; the line says what gives it.
void require_log_facts(const Config& config, std::string_view log_name, bool scale_is_used = true);

// errors  ConfigError: gyro.tick_s or gyro.scale_arcsec differs from the one that the log gives.
void check_against_log(const Config& config, const Settings& log_settings, std::string_view log_name);

// Every range again (a Config may have been filled by code), and the rules between keys.
//
// errors  ConfigError: the first rule that is broken.
void check(const Config& config);

// The part of `check` on which the compensation of a recorded log depends: the keys of [compensation], tick and scale.
void check_compensation(const Config& config);

// The part of `check` on temperature and field; of a file, once its points are there, also on these.
void check_environment(const Config& config);

// Whether a layer has set this key, or code has made it other than the default.
//
// errors  std::invalid_argument: there is no such key.
[[nodiscard]] bool is_given(const Config& config, std::string_view dotted_key);

// Those of these keys that are set and that no layer has given, as `key = value` with commas between.
[[nodiscard]] std::string not_given(const Config& config, std::span<const std::string_view> dotted_keys);

[[nodiscard]] bool is_known_section(std::string_view name);

// The section that an unknown name is but for one letter, or for its case; nothing where it is none of ours.
[[nodiscard]] std::optional<std::string_view> misspelt_section(std::string_view name);

// Every key that is set; reals in the shortest form that reads back to the same number.
[[nodiscard]] Settings to_settings(const Config& config);

// Those that are not the defaults.
[[nodiscard]] Settings changed_settings(const Config& config);

// All that are set, as a TOML file.
[[nodiscard]] std::string to_toml(const Config& config);

[[nodiscard]] std::vector<KeyInfo> describe_keys();

// Of a key that there is; empty where it has none.
[[nodiscard]] std::string unit_of(std::string_view dotted_key);

// The table as a chapter of the documentation, one Markdown table per section.
[[nodiscard]] std::string reference_markdown();

}  // namespace zlg::config
