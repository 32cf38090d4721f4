#include <memory>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/study/calibrate.hpp>

#include "src/as_json.hpp"
#include "src/calibration_text.hpp"
#include "src/failure.hpp"
#include "src/mapping_input.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct CalibrateOptions : Options {
    std::vector<std::string> raws;
    std::vector<double> rate_arcsec_s;
    bool from_laser = false;
};

config::Config said(const CalibrateOptions& options) {
    config::Config config;
    if (!options.config_path.empty()) config::apply_file(config, options.config_path);
    for (const std::string& set : options.sets) config::apply_set(config, set);
    return config;
}

void check_usage(const CalibrateOptions& options) {
    if (options.from_laser && !options.raws.empty())
        throw UsageError{fmt::format("--from-laser: takes no log; {} is one. A configuration is named by --config",
                                     options.raws.front())};
    if (!options.from_laser && options.raws.empty())
        throw UsageError{"RAW is missing: name the logs, or derive the constants by --from-laser"};
    if (options.out.empty()) return;
    require_suffix(options.out, ".toml");
    for (const std::string& raw : options.raws) refuse_own_input(raw, options.out);
}

void calibrate_from_laser(const CalibrateOptions& options) {
    const rig::LaserCalibration found = rig::calibration_of_laser(load_config(options));
    const std::string toml = study::calibration_toml(found);
    if (!options.out.empty()) write_file(options.out, toml, options.force);
    print(options.json ? pretty(laser_json(found)) : toml);
}

void calibrate(const CalibrateOptions& options) {
    check_usage(options);
    if (options.from_laser) return calibrate_from_laser(options);
    Progress progress;
    const study::CalibrationResult result = study::calibrate({
        .logs = options.raws,
        .rate_arcsec_s = options.rate_arcsec_s,
        .rate_name = "--rate-arcsec-s",
        .said = said(options),
        .open = [&](const std::string& path) { return open_raw(options, path); },
        .on_progress = [&](double fraction) { progress.show(fraction); },
    });
    for (const std::string& warning : result.warnings) complain("warning: " + warning);
    if (!options.out.empty()) write_file(options.out, study::calibration_toml(result), options.force);
    print(options.json ? pretty(calibration_json(result)) : calibration_text(result));
    if (!result.any_determined()) throw CLI::RuntimeError{result_says_no};
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
