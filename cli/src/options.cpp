#include "options.hpp"

#include <filesystem>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "failure.hpp"

namespace zlg::cli {
namespace {

void apply_options(config::Config& config, const Options& options) {
    if (!options.config_path.empty()) config::apply_file(config, options.config_path);
    for (const std::string& set : options.sets) config::apply_set(config, set);
    if (options.seed) config::apply_set(config, fmt::format("run.seed={}", *options.seed));
    if (options.duration_s) config::apply_set(config, fmt::format("run.duration_s={}", *options.duration_s));
}

// A log may name its tick and scale without a section, as an HDF5 log does in its root.
config::Settings with_full_keys(config::Settings settings) {
    for (auto& [key, value] : settings)
        if (key == "tick_s" || key == "scale_arcsec") key.insert(0, "gyro.");
    return settings;
}

}  // namespace

void add_config_options(CLI::App& verb, Options& options) {
    verb.add_option("--config", options.config_path, "configuration, TOML");
    verb.add_option("--set", options.sets, "section.key=value, over the file; repeatable")->allow_extra_args(false);
}

void add_run_options(CLI::App& verb, Options& options) {
    verb.add_option("--seed", options.seed, "seed of all noise");
    verb.add_option("--duration", options.duration_s, "length of the run, s");
    verb.add_option("--threads", options.threads, "threads, 1..64")->check(CLI::Range(1, 64));
}

void add_output_options(CLI::App& verb, Options& options) {
    verb.add_option("--out", options.out, "where to write");
    verb.add_flag("--force", options.force, "overwrite what exists");
    verb.add_flag("--json", options.json, "the result as one JSON object on standard output");
}

config::Config load_config(const Options& options) {
    config::Config config;
    apply_options(config, options);
    config::check(config);
    return config;
}

config::Config load_log_config(const Options& options, const config::Settings& log_settings,
                               const std::string& log_path) {
    const config::Settings settings = with_full_keys(log_settings);
    config::Config config;
    try {
        config::apply_log(config, settings, log_path);
    } catch (const config::ConfigError& error) {
        throw logs::FormatError{error.what()};
    }
    apply_options(config, options);
    config::check_compensation(config);
    config::check_against_log(config, settings, log_path);
    return config;
}

void check_table_path(const std::string& path) {
    if (path.empty()) throw UsageError{"--out is missing: name the file to write, with the suffix .csv"};
    const std::string suffix = std::filesystem::path{path}.extension();
    if (suffix != ".csv")
        throw UsageError{fmt::format("{}: the suffix '{}' names no format; allowed is .csv", path, suffix)};
}

}  // namespace zlg::cli
