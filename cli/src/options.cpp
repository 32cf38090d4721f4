#include "options.hpp"

#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include <zlg/config/spelling.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/design_study.hpp>

#include "failure.hpp"

namespace zlg::cli {
namespace {

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

void apply_options(config::Config& config, const Options& options) {
    if (!options.config_path.empty()) config::apply_file(config, options.config_path);
    for (const std::string& set : options.sets) config::apply_set(config, set);
    if (options.seed) config::apply_pair(config, "run.seed", *options.seed, "--seed");
    if (options.duration_s) config::apply_pair(config, "run.duration_s", *options.duration_s, "--duration");
}

// A key that stands twice with different values, or in a section that is nearly one of ours: which is meant?
void refuse_doubtful(const config::Settings& settings, const std::string& path) {
    std::map<std::string, std::string> seen;
    for (const auto& [key, value] : settings) {
        const auto [first, is_new] = seen.emplace(key, value);
        if (!is_new && first->second != value)
            throw logs::FormatError{fmt::format("{}: {} stands twice, as {} and as {}; allowed is one value", path, key,
                                                first->second, value)};
        const std::size_t dot = key.find('.');
        if (dot == std::string::npos || config::is_known_section(key.substr(0, dot))) continue;
        for (const config::KeyInfo& known : config::describe_keys())
            if (config::letters_apart(lower_case(key.substr(0, dot)), known.section) <= 1)
                throw logs::FormatError{fmt::format("{}: {}: unknown section [{}]; did you mean [{}]?", path, key,
                                                    key.substr(0, dot), known.section)};
    }
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

void add_light_option(CLI::App& verb, Options& options) {
    verb.add_flag("--light", options.light, "record every light sample too (HDF5 only)");
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
    refuse_doubtful(settings, log_path);
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

config::Config as_recorded(config::Config config, const config::Settings& log_settings, const std::string& log_path) {
    config.perimeter = {};
    config::apply_log(config, with_full_keys(log_settings), log_path);
    return config;
}

void add_config_argument(CLI::App& verb, Options& options) {
    auto* positional =
        verb.add_option("CONFIG", options.config_path, "configuration, TOML; the paper's gyro without it");
    verb.add_option("--config", options.config_path, "the same, as an option")->excludes(positional);
    verb.add_option("--set", options.sets, "section.key=value, over the file; repeatable")->allow_extra_args(false);
}

config::Config with_laser_curve(const config::Config& config) {
    if (config.gyro.fidelity != config::Fidelity::laser) return config;
    const config::Config calibrated = rig::calibrated_by_laser(config);
    const double presumed_hz = config.gyro.bias_hz;
    const double laser_hz = calibrated.gyro.bias_hz;
    if (!(std::abs(presumed_hz - laser_hz) <= 0.05 * laser_hz))
        complain(
            fmt::format("warning: gyro.bias_hz = {:.6g} is presumed, [laser] makes {:.6g}: see zlg calibrate "
                        "--from-laser",
                        presumed_hz, laser_hz));
    const bool slope_is_told = config.gyro.discriminator_per_lambda != config::Gyro{}.discriminator_per_lambda;
    if (slope_is_told || !config.perimeter.discriminator_signal.empty()) return config;
    config::Config told = config;
    told.gyro.discriminator_per_lambda = calibrated.gyro.discriminator_per_lambda;
    told.perimeter.discriminator_detuning_lambda = calibrated.perimeter.discriminator_detuning_lambda;
    told.perimeter.discriminator_signal = calibrated.perimeter.discriminator_signal;
    complain("gyro.fidelity = laser: perimeter.discriminator_signal is not given and taken from [laser]");
    return told;
}

config::Config with_interval(const config::Config& config) {
    const config::Config resolved = study::with_interval(config);
    if (config.switching.interval_optimal)
        complain(fmt::format(
            "switching.interval_s = \"optimal\" is {:.4g} s here, by design.switch_error_arcsec = {:.4g} and [drift]",
            resolved.switching.interval_s, config.design.switch_error_arcsec));
    return resolved;
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

config::Settings angle_settings(const config::Config& config) {
    config::Settings settings;
    for (const auto& setting : config::to_settings(config))
        if (setting.first.starts_with("gyro.") || setting.first.starts_with("compensation.") ||
            setting.first == "drift.random_walk_arcsec_sqrt_s" || setting.first.starts_with("perimeter.discriminator_"))
            settings.push_back(setting);
    return settings;
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
    std::error_code ignored;
    for (const std::string& part : part_paths)
        if (std::filesystem::exists(part, ignored)) note += fmt::format("{}{}", note.empty() ? "" : ", ", part);
    if (note.empty()) throw;
    note = "; recorded until then: " + note;
    try {
        throw;
    } catch (const logs::IoError& error) {
        throw logs::IoError{error.what() + note};
    } catch (const logs::FormatError& error) {
        throw logs::FormatError{error.what() + note};
    } catch (const config::ConfigError& error) {
        throw config::ConfigError{error.what() + note};
    } catch (const std::exception& error) {
        throw std::runtime_error{error.what() + note};
    }
}

}  // namespace zlg::cli
