#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include <zlg/calibration/lab_reader.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/laser_calibration.hpp>

#include "as_json.hpp"
#include "calibration_text.hpp"
#include "failure.hpp"
#include "mapping_input.hpp"
#include "options.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace zlg::cli {
namespace {

constexpr std::string_view bias_coefficient = "gyro.bias_temperature_coefficient_per_c";
constexpr double max_rate_arcsec_s = 1e9;

struct CalibrateOptions : Options {
    std::vector<std::string> raws;
    std::vector<double> rate_arcsec_s;
    bool from_laser = false;
};

struct Lab {
    std::vector<calibration::LabLog> logs;
    std::vector<config::Config> configs;   // of each log, with the options over it
    std::vector<config::Config> recorded;  // how its detunings were read
};

calibration::LabLog read(logs::RawReader& raw, const std::string& path, double tick_s) {
    calibration::LabReader reader{path, tick_s};
    Progress progress;
    core::HalfRecord record;
    std::int64_t halves = 0;
    while (raw.next(record)) {
        reader.take(record);
        if (++halves % 100'000 == 0) progress.show(raw.fraction_read());
    }
    if (halves < 2) throw logs::FormatError{fmt::format("{}: holds no whole tick, which is two half-periods", path)};
    if (!raw.line_is_ended())
        complain(fmt::format("warning: {}: the last line has no end; the file may have been cut off", path));
    return reader.finish();
}

Lab read_all(const CalibrateOptions& options) {
    Lab lab;
    for (const std::string& path : options.raws) {
        logs::RawReader raw = open_raw(options, path);
        for (const std::string& warning : raw.header().warnings) complain("warning: " + warning);
        if (raw.header().has_edge_offset)
            complain(fmt::format("warning: {}: the shifts of the bias edges are left in its counts, as noise", path));
        lab.configs.push_back(load_log_config(options, raw.header().settings, path));
        lab.recorded.push_back(rig::as_recorded(lab.configs.back(), raw.header().settings, path));
        lab.logs.push_back(read(raw, path, lab.configs.back().gyro.tick_s));
    }
    return lab;
}

// Logs of one gyro, counted alike.
void check_agreement(const CalibrateOptions& options, const Lab& lab) {
    const config::Gyro& first = lab.configs.front().gyro;
    for (std::size_t k = 1; k < lab.configs.size(); ++k) {
        const config::Gyro& gyro = lab.configs[k].gyro;
        const auto differ = [&](const char* key, double a, double b) {
            return fmt::format("{} = {} in {}, {} in {}", key, a, options.raws.front(), b, options.raws[k]);
        };
        if (gyro.tick_s != first.tick_s)
            throw logs::FormatError{differ("gyro.tick_s", first.tick_s, gyro.tick_s) + "; allowed is one value"};
        if (gyro.scale_arcsec != first.scale_arcsec)
            throw logs::FormatError{differ("gyro.scale_arcsec", first.scale_arcsec, gyro.scale_arcsec) +
                                    "; allowed is one value"};
        if (gyro.reference_temperature_c != first.reference_temperature_c)
            throw config::ConfigError{
                differ("gyro.reference_temperature_c", first.reference_temperature_c, gyro.reference_temperature_c) +
                "; say with --set to which temperature the constants are to refer"};
        if (lab.configs[k].perimeter.loop != lab.configs.front().perimeter.loop)
            throw config::ConfigError{fmt::format("perimeter.loop differs between {} and {}; calibrate them apart",
                                                  options.raws.front(), options.raws[k])};
    }
}

bool read_by_one_slope(const Lab& lab) {
    return std::ranges::all_of(lab.recorded, [&lab](const config::Config& c) {
        return c.perimeter.discriminator_signal.empty() &&
               c.gyro.discriminator_per_lambda == lab.recorded.front().gyro.discriminator_per_lambda;
    });
}

// Of what is to be found, only what the user says is presumed, never what a log says of itself.
calibration::Presumed presumed(const CalibrateOptions& options, const Lab& lab) {
    const config::Config& of_logs = lab.configs.front();
    config::Config said;
    if (!options.config_path.empty()) config::apply_file(said, options.config_path);
    for (const std::string& set : options.sets) config::apply_set(said, set);
    return {.scale_arcsec = of_logs.gyro.scale_arcsec,
            .reference_temperature_c = of_logs.gyro.reference_temperature_c,
            .rate_arcsec_s = options.rate_arcsec_s,
            .bias_edge_s = of_logs.gyro.bias_edge_s,
            .counts_per_turn = static_cast<double>(counts_per_turn(of_logs.laser.quadrature)),
            .stepped_voltage = of_logs.perimeter.loop == config::Loop::digital,
            .read_by_slope = read_by_one_slope(lab),
            .bias_temperature_coefficient_per_c = said.gyro.bias_temperature_coefficient_per_c,
            .half_wave_temperature_coefficient_per_c = said.piezo.half_wave_temperature_coefficient_per_c};
}

std::vector<CalibrationFile> files_of(const std::vector<calibration::LabLog>& logs) {
    std::vector<CalibrationFile> files;
    for (const calibration::LabLog& log : logs)
        files.push_back({.path = log.name,
                         .duration_s = static_cast<double>(log.n_ticks) * log.tick_s,
                         .segments = std::ssize(log.segments),
                         .relocks = std::ssize(log.relocks),
                         .has_temperature = log.has_temperature(),
                         .temperature_min_c = log.temperature_min_c,
                         .temperature_max_c = log.temperature_max_c});
    return files;
}

// A bias frequency that was carried to the reference temperature from afar by a coefficient that nobody knows; empty
// where it was not.
std::string far_reference(const CalibrateOptions& options, const Lab& lab,
                          const calibration::Calibration& calibration) {
    constexpr double far_c = 5.0;
    for (const calibration::Constant& c : calibration.constants) {
        if (c.key == "gyro.bias_hz" && !c.estimate.determined) return {};
        if (c.key == bias_coefficient && c.estimate.determined) return {};
    }
    if (presumed(options, lab).bias_temperature_coefficient_per_c != 0.0) return {};
    for (const std::string& set : options.sets)
        if (set.starts_with(bias_coefficient)) return {};
    const double reference_c = lab.configs.front().gyro.reference_temperature_c;
    double nearest_c = std::numeric_limits<double>::infinity();
    for (const calibration::LabLog& log : lab.logs)
        if (log.has_temperature())
            nearest_c =
                std::min(nearest_c, std::max(log.temperature_min_c - reference_c, reference_c - log.temperature_max_c));
    if (!(nearest_c > far_c) || !std::isfinite(nearest_c)) return {};
    return fmt::format(
        "gyro.bias_hz is that of the logs, {:.3g} C or more from gyro.reference_temperature_c = {:g} C; "
        "{} is neither determined nor given",
        nearest_c, reference_c, bias_coefficient);
}

void check_usage(const CalibrateOptions& options) {
    for (const double rate_arcsec_s : options.rate_arcsec_s)
        if (!(std::abs(rate_arcsec_s) <= max_rate_arcsec_s))
            throw UsageError{
                fmt::format("--rate-arcsec-s {}: allowed is -1e9..1e9, more than any gyro turns", rate_arcsec_s)};
    if (options.rate_arcsec_s.size() > 1 && options.rate_arcsec_s.size() != options.raws.size())
        throw UsageError{fmt::format("--rate-arcsec-s: {} rates of {} logs; allowed is one for all or one for each",
                                     options.rate_arcsec_s.size(), options.raws.size())};
    if (options.from_laser && !options.raws.empty())
        throw UsageError{fmt::format("--from-laser: takes no log; {} is one. A configuration is named by --config",
                                     options.raws.front())};
    if (!options.from_laser && options.raws.empty())
        throw UsageError{"RAW is missing: name the logs, or derive the constants by --from-laser"};
    std::error_code ignored;
    for (std::size_t k = 1; k < options.raws.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (std::filesystem::equivalent(options.raws[j], options.raws[k], ignored))
                throw UsageError{fmt::format("{}: is named twice; each log counts once", options.raws[k])};
    if (options.out.empty()) return;
    require_suffix(options.out, ".toml");
    for (const std::string& raw : options.raws) refuse_own_input(raw, options.out);
}

bool any_determined(const calibration::Calibration& calibration) {
    for (const calibration::Constant& c : calibration.constants)
        if (c.estimate.determined) return true;
    return false;
}

void calibrate_from_laser(const CalibrateOptions& options) {
    const rig::LaserCalibration found = rig::calibration_of_laser(load_config(options));
    const std::string toml = laser_toml(found);
    if (!options.out.empty()) write_file(options.out, toml, options.force);
    print(options.json ? pretty(laser_json(found)) : toml);
}

void calibrate(const CalibrateOptions& options) {
    check_usage(options);
    if (options.from_laser) return calibrate_from_laser(options);
    const Lab lab = read_all(options);
    check_agreement(options, lab);
    CalibrationResult result{.files = files_of(lab.logs), .config = lab.configs.front()};
    result.slope_per_lambda = std::abs(lab.recorded.front().gyro.discriminator_per_lambda);
    result.calibration = calibration::calibrate(lab.logs, presumed(options, lab));
    result.warning = far_reference(options, lab, result.calibration);
    if (!result.warning.empty()) complain("warning: " + result.warning);
    if (!options.out.empty()) write_file(options.out, calibration_toml(result), options.force);
    print(options.json ? pretty(calibration_json(result)) : calibration_text(result));
    if (!any_determined(result.calibration)) throw CLI::RuntimeError{result_says_no};
}

}  // namespace

void add_calibrate(CLI::App& program) {
    const auto options = std::make_shared<CalibrateOptions>();
    CLI::App* verb = program.add_subcommand(
        "calibrate", "laboratory logs in, the constants that compensation presumes out, each with its sigma");
    verb->add_option("RAW", options->raws, "raw logs of one gyro, at rest or at a known rate");
    verb->add_flag("--from-laser", options->from_laser, "derive bias, chi and discriminator from [laser] instead");
    verb->add_option(
            "--rate-arcsec-s", options->rate_arcsec_s,
            "known rate of rotation, arcsec/s; one for all logs, or one for each in their order, with commas between")
        ->delimiter(',')
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_mapping_options(*verb, *options);
    add_config_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { calibrate(*options); });
}

}  // namespace zlg::cli
