#pragma once
// The options that verbs share, and the configuration that follows from them.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/recorded/log_compensation.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/study/resolved.hpp>

namespace zlg::cli {

struct Options {
    std::string config_path;
    std::vector<std::string> sets;
    std::optional<std::string> seed;  // read as the configuration reads them
    std::optional<std::string> duration_s;
    int threads = 2;
    std::string out;
    bool light = false;  // the raw log holds every light sample
    bool force = false;
    bool json = false;
    std::string mapping_path;       // of files of other programs
    std::vector<std::string> maps;  // over it
    bool strict = false;            // values that may be no measurements make exit status 1
};

void add_config_options(CLI::App& verb, Options& options);
void add_config_argument(CLI::App& verb, Options& options);  // CONFIG as an argument or an option, and --set
void add_run_options(CLI::App& verb, Options& options);      // seed, duration, threads
void add_output_options(CLI::App& verb, Options& options);   // out, force, json
// Of the name of an output. A shell gives an empty one for a variable that is not set, which must not mean the default.
[[nodiscard]] CLI::Validator is_a_name();
void add_light_option(CLI::App& verb, Options& options);

// --set over --config over the defaults.
//
// errors  config::ConfigError.
[[nodiscard]] config::Config said_config(const Options& options);

// The same as a gyro that can be.
//
// errors  config::ConfigError.
[[nodiscard]] config::Config load_config(const Options& options);

// The facts of a log that are used: how long its ticks are, what a count is worth.
enum class LogFacts { none, tick, tick_and_scale };

// The same over the settings of a log, checked as far as compensation depends on it.
//
// errors  logs::FormatError for the log's settings; config::ConfigError, also where its tick or scale is contradicted,
//         or is used and stands neither in the log nor in the options.
[[nodiscard]] config::Config load_log_config(const Options& options, const config::Settings& log_settings,
                                             const std::string& log_path, LogFacts used = LogFacts::tick_and_scale);

// One line on standard error about the settings of a log that only a former version knew.
void note_former_keys(const config::Settings& log_settings, const std::string& log_path);

// The compensation of a raw log, with a line on standard error for each note and warning.
//
// errors  those of load_log_config and of recorded::log_compensation.
[[nodiscard]] recorded::LogCompensation log_compensation(const Options& options, const logs::RawHeader& log,
                                                         const std::string& log_path);

// Of a log for whose want of detuning nothing is subtracted after a closing: a line on standard error where its loop
// was opened.
void warn_uncorrected(const rig::Replay& replay, const std::string& log_path);

// As study::resolved, with a line on standard error for each note and warning.
//
// errors  config::ConfigError where [laser] does not make a gyro.
[[nodiscard]] study::Resolved resolve(const config::Config& config);

// The end of a verb whose gyro was to switch and never did: one line on standard error, and exit 1.
void refuse_a_run_that_lacks_switches(const rig::SwitchTally& tally);

// errors  UsageError where both are the same file; `option` names the output.
void refuse_own_input(const std::string& input, const std::string& output, const char* option = "--out");

// An output that `option` names must be another file than that of --out.
//
// errors  UsageError for the same one.
void refuse_same_output(const std::string& path, const std::string& out, const char* option);

[[nodiscard]] constexpr bool is_raw(logs::LogKind kind) {
    return kind == logs::LogKind::raw_csv || kind == logs::LogKind::raw_hdf5;
}
[[nodiscard]] constexpr bool is_angles(logs::LogKind kind) {
    return kind == logs::LogKind::angle_csv || kind == logs::LogKind::angle_hdf5;
}

// errors  UsageError: the name has another suffix.
void require_suffix(const std::string& path, std::string_view suffix);

// All or none: none gets its name before all are written.
//
// errors  logs::IoError.
struct Output {
    std::string path;
    std::string text;
};
void write_all(const std::vector<Output>& outputs, bool force);

// As it was typed, for a shell.
[[nodiscard]] std::string typed_command();

// "w.csv: 192 bytes, last changed 2026-11-28T09:30:00Z, XXH64 44bc2cf5ad770999". errors  logs::IoError.
[[nodiscard]] std::string file_facts(const std::string& path);

// errors  logs::IoError.
void write_file(const std::string& path, const std::string& text, bool force);

// The path of a log to be written: its suffix chooses the format.
//
// errors  UsageError for no path or an unknown suffix.
logs::LogFormat log_format(const std::string& path);

// How many light samples of a half the raw log is to hold: all or none.
//
// errors  UsageError: they are asked for in a CSV log, which has no room for them.
[[nodiscard]] int logged_light_samples(const Options& options, const config::Config& config, logs::LogFormat format);

// What a raw log of this gyro holds: shifts of the bias edges only where there are any.
[[nodiscard]] logs::RawColumns raw_columns(const config::Config& config);

// The light samples that go along into a copy: with a warning where a CSV log cannot take them.
[[nodiscard]] logs::RawWriterOptions copied_light(const logs::RawHeader& header, const std::string& path,
                                                  logs::LogFormat format);

// Throws the error that is being handled again, with the names of the recordings that it left unfinished.
[[noreturn]] void rethrow_with(std::initializer_list<std::string> part_paths);

}  // namespace zlg::cli
