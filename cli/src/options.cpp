#include "options.hpp"

#include <filesystem>
#include <fstream>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <zlg/config/log_settings.hpp>
#include <zlg/logs/content_hash.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/table_file.hpp>
#include <zlg/logs/unfinished.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/text/inputs.hpp>

#include "failure.hpp"

namespace zlg::cli {
namespace {

void apply_options(config::Config& config, const Options& options) {
    if (!options.config_path.empty()) config::apply_file(config, options.config_path);
    for (const std::string& set : options.sets) config::apply_set(config, set);
    if (options.seed) config::apply_pair(config, "run.seed", *options.seed, "--seed");
    if (options.duration_s) config::apply_pair(config, "run.duration_s", *options.duration_s, "--duration");
}

}  // namespace

std::string typed_command() {
    std::ifstream file{"/proc/self/cmdline"};
    std::string command = "zlg", word;
    std::getline(file, word, '\0');
    while (std::getline(file, word, '\0')) {
        constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
        const bool is_plain = !word.empty() && word.find_first_not_of(plain) == std::string::npos;
        for (std::size_t at = word.find('\''); at != std::string::npos; at = word.find('\'', at + 4))
            word.replace(at, 1, "'\\''");
        command += is_plain ? " " + word : fmt::format(" '{}'", word);
    }
    return command;
}

// Of a pipe nothing is known after it was read.
std::string file_facts(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return path;
    return fmt::format("{}: {} bytes, last changed {:%Y-%m-%dT%H:%M:%S}Z, XXH64 {:016x}", path, status.st_size,
                       fmt::gmtime(status.st_mtime), logs::hash_of_file(path));
}

CLI::Validator is_a_name() {
    return {[](const std::string& name) {
                return name.empty() ? "the name is empty; allowed is the name of a file or folder" : "";
            },
            ""};
}

void add_config_options(CLI::App& verb, Options& options) {
    verb.add_option("--config", options.config_path, "configuration, TOML");
    verb.add_option("--set", options.sets, "section.key=value, over the file; repeatable")->allow_extra_args(false);
}

void add_run_options(CLI::App& verb, Options& options) {
    verb.add_option("--seed", options.seed, "seed of all noise (1)");
    verb.add_option("--duration", options.duration_s, "length of the run");
    verb.add_option("--threads", options.threads, "1..64 (2)")->check(CLI::Range(1, 64).description(""));
}

void add_output_options(CLI::App& verb, Options& options) {
    verb.add_option("--out", options.out, "where to write")->check(is_a_name());
    verb.add_flag("--force", options.force, "overwrite what exists");
    verb.add_flag("--json", options.json, "the result as one JSON object on standard output");
}

void add_light_option(CLI::App& verb, Options& options) {
    verb.add_flag("--light", options.light, "record every light sample too (HDF5 only)");
}

config::Config said_config(const Options& options) {
    config::Config config;
    apply_options(config, options);
    return config;
}

config::Config load_config(const Options& options) {
    config::Config config = said_config(options);
    config::check(config);
    if (config.motion.kind == config::MotionKind::file) text::note_input(config.motion.path);
    return config;
}

config::Config load_log_config(const Options& options, const config::Settings& log_settings,
                               const std::string& log_path, LogFacts used) {
    config::Settings settings;
    config::Config config;
    try {
        settings = config::checked_log_settings(log_settings, log_path);
        config::apply_log(config, settings, log_path);
    } catch (const config::ConfigError& error) {
        throw logs::FormatError{error.what()};
    }
    apply_options(config, options);
    if (used != LogFacts::none) config::require_log_facts(config, log_path, used == LogFacts::tick_and_scale);
    config::check_compensation(config);
    config::check_against_log(config, settings, log_path);
    return config;
}

void note_former_keys(const config::Settings& log_settings, const std::string& log_path) {
    if (const auto note = config::former_keys_note(log_settings, log_path)) complain("note: " + *note);
}

recorded::LogCompensation log_compensation(const Options& options, const logs::RawHeader& log,
                                           const std::string& log_path) {
    recorded::LogCompensation made =
        recorded::log_compensation(load_log_config(options, log.settings, log_path), log, log_path);
    const config::Config asked = load_config(options);
    const bool by_phase = asked.gyro.readout == config::Readout::phase;
    if (config::is_given(asked, "gyro.readout") && by_phase != log.has_fringe)
        made.notes.push_back(
            fmt::format("{}: gyro.readout = \"{}\" is for a gyro that runs; this log {} the column fringe, and its "
                        "angles come from {}",
                        log_path, by_phase ? "phase" : "count", log.has_fringe ? "has" : "lacks",
                        log.has_fringe ? "counts and fringe" : "whole counts"));
    if (!made.presumed.empty()) made.notes.push_back(made.presumed);
    for (const std::string& note : made.notes) complain("note: " + note);
    for (const std::string& warning : made.warnings) complain("warning: " + warning);
    return made;
}

void warn_uncorrected(const rig::Replay& replay, const std::string& log_path) {
    if (const std::string line = replay.uncorrected(log_path); !line.empty()) complain("warning: " + line);
}

void add_config_argument(CLI::App& verb, Options& options) {
    auto* positional =
        verb.add_option("CONFIG", options.config_path, "configuration, TOML; the paper's gyro without it");
    verb.add_option("--config", options.config_path, "the same, as an option")->excludes(positional);
    verb.add_option("--set", options.sets, "section.key=value, over the file; repeatable")->allow_extra_args(false);
}

study::Resolved resolve(const config::Config& config) {
    study::Resolved resolved = study::resolved(config);
    for (const std::string& note : resolved.notes) complain(note);
    for (const std::string& warning : resolved.warnings) complain("warning: " + warning);
    return resolved;
}

void refuse_a_run_that_lacks_switches(const rig::SwitchTally& tally) {
    if (!tally.lacks_many()) return;
    explain_exit(rig::sentence(tally));
    throw CLI::RuntimeError{result_says_no};
}

void refuse_own_input(const std::string& input, const std::string& output, const char* option) {
    std::error_code ignored;
    if (std::filesystem::equivalent(input, output, ignored))
        throw UsageError{fmt::format("{} {}: is the input; name another file", option, output)};
    // The output grows under this name first.
    if (std::filesystem::equivalent(input, output + ".part", ignored))
        throw UsageError{
            fmt::format("{} {}: would grow as {}, which is the input; name another file", option, output, input)};
}

void refuse_same_output(const std::string& path, const std::string& out, const char* option) {
    if (std::filesystem::weakly_canonical(path) == std::filesystem::weakly_canonical(out))
        throw UsageError{fmt::format("{} {}: is what --out writes; name another file", option, path)};
}

void require_suffix(const std::string& path, std::string_view suffix) {
    const std::string found = std::filesystem::path{path}.extension();
    if (found != suffix)
        throw UsageError{fmt::format("{}: the suffix '{}' names no format; allowed is {}", path, found, suffix)};
}

void write_all(const std::vector<Output>& outputs, bool force) {
    const logs::Together all_or_none;
    std::vector<logs::TableFile> files;
    for (const Output& o : outputs) {
        files.emplace_back(o.path, force);
        files.back().append(o.text);
        files.back().flush();
    }
    for (logs::TableFile& file : files) file.close();
}

void write_file(const std::string& path, const std::string& text, bool force) {
    logs::TableFile file{path, force};
    file.append(text);
    file.close();
}

logs::LogFormat log_format(const std::string& path) {
    if (path.empty()) throw UsageError{"--out is missing: name the file to write, with the suffix .csv, .h5 or .hdf5"};
    try {
        return logs::format_of(path);
    } catch (const logs::IoError& error) {
        throw UsageError{error.what()};
    }
}

int logged_light_samples(const Options& options, const config::Config& config, logs::LogFormat format) {
    if (!options.light) return 0;
    if (format == logs::LogFormat::csv)
        throw UsageError{"--light: a CSV log holds no light samples; allowed with .h5 or .hdf5"};
    return static_cast<int>(config.gyro.light_samples);
}

logs::RawColumns raw_columns(const config::Config& config) {
    logs::RawColumns columns = logs::all_raw_columns;
    columns.has_fringe = config.gyro.readout == config::Readout::phase;
    columns.has_edge_offset = config.gyro.dither != core::DitherMethod::none;
    columns.timer_hz = rig::timer_hz;
    return columns;
}

logs::RawWriterOptions copied_light(const logs::RawHeader& header, const std::string& path, logs::LogFormat format) {
    if (header.light_samples == 0) return {};
    if (format == logs::LogFormat::hdf5) return {.light_samples = header.light_samples, .light_b = header.has_light_b};
    complain(fmt::format("warning: {}: the light samples stay behind, a CSV log holds none", path));
    return {};
}

void rethrow_with(std::initializer_list<std::string> part_paths) {
    std::string note;
    for (const std::string& part : part_paths)
        if (text::is_own_output(part)) note += fmt::format("{}{}", note.empty() ? "" : ", ", part);
    if (!note.empty()) after_error = "; recorded until then: " + note;
    throw;
}

}  // namespace zlg::cli
