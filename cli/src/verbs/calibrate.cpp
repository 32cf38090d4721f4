#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/study/calibrate.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/mapping_input.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using calibration::Constant;
using nlohmann::json;
using study::curve_signals;

constexpr std::string_view table_name = "gyro.bias_temperature_table";
constexpr std::string_view curve_name = "perimeter.discriminator_signal";

std::string curve_text(const study::CalibrationResult& result) {
    const calibration::LossCurve& curve = result.calibration.curve;
    if (!curve.determined) return fmt::format("{}: not determined: {}\n", curve_name, curve.reason);
    std::string text = fmt::format("\n{:<46}{:>16}{:>12}  lambda\n", "discriminator: signal", "detuning", "+-");
    const std::vector<double> signal = curve_signals(result);
    for (std::size_t k = 2; k < signal.size(); k += 3)
        text +=
            fmt::format("{:<46.5f}{:>16.5f}{:>12.2g}\n", signal[k], curve.detuning_lambda[k], curve.sigma_lambda[k]);
    return text;
}

json laser_json(const rig::LaserCalibration& found) {
    const config::Config& c = found.config;
    return {{"constants",
             {{"gyro.bias_hz", {{"value", c.gyro.bias_hz}, {"unit", "Hz"}}},
              {"gyro.bias_chi", {{"value", c.gyro.bias_chi}, {"unit", ""}}},
              {"gyro.discriminator_per_lambda", {{"value", c.gyro.discriminator_per_lambda}, {"unit", "1/lambda"}}}}},
            {"discriminator",
             {{"detuning_lambda", c.perimeter.discriminator_detuning_lambda},
              {"signal", c.perimeter.discriminator_signal},
              {"centre_lambda", c.perimeter.discriminator_centre_lambda},
              {"third_wave_lambda", found.third_wave_lambda},
              {"error_lambda", found.curve_error_lambda},
              {"error_beyond_lambda", found.curve_error_beyond_lambda}}},
            {"chi_error_ratio", found.chi_error_ratio}};
}

std::string calibration_text(const study::CalibrationResult& result) {
    std::string text = fmt::format("{:<46}{:>16}{:>12}  unit\n", "constant", "value", "+-");
    for (const Constant& c : result.calibration.constants) {
        if (!c.estimate.determined) continue;
        text += fmt::format("{:<46}{:>16.8g}{:>12.3g}{}\n", c.key, c.estimate.value, c.estimate.sigma,
                            c.unit.empty() ? "" : "  " + c.unit);
    }
    if (const std::vector<double>& higher = result.calibration.chi_higher; !higher.empty())
        text += fmt::format("gyro.bias_chi_higher = [{:.6g}]\n", fmt::join(higher, ", "));
    const calibration::BiasTable& table = result.calibration.bias_table;
    if (!table.knots.empty()) text += fmt::format("{} = {:::.6g}, +- {::.2g}\n", table_name, table.knots, table.sigma);
    for (const Constant& c : result.calibration.constants)
        if (!c.estimate.determined) text += fmt::format("{}: not determined: {}\n", c.key, c.estimate.reason);
    if (table.knots.empty()) text += fmt::format("{}: not determined: {}\n", table_name, table.reason);
    text += curve_text(result);
    text += "\ngoodness of fit\n";
    for (const calibration::Goodness& g : result.calibration.goodness)
        text += fmt::format("{:<46}{:>16.4g}  {}\n", g.name, g.value, g.meaning);
    text += "\nlogs\n";
    for (const study::CalibratedLog& f : result.logs)
        text += fmt::format(
            "{}: {:.6g} s, {} segments, {} re-locks{}\n", printable(f.path), f.duration_s, f.segments, f.relocks,
            f.has_temperature ? fmt::format(", {:.4g}..{:.4g} C", f.temperature_min_c, f.temperature_max_c) : "");
    return text;
}

json calibration_json(const study::CalibrationResult& result) {
    json constants = json::object();
    json not_determined = json::object();
    for (const Constant& c : result.calibration.constants) {
        if (c.estimate.determined)
            constants[c.key] = {{"value", c.estimate.value}, {"sigma", c.estimate.sigma}, {"unit", c.unit}};
        else
            not_determined[c.key] = c.estimate.reason;
    }
    const calibration::LossCurve& curve = result.calibration.curve;
    json discriminator = json::object();
    if (curve.determined)
        discriminator = {{"detuning_lambda", curve.detuning_lambda},
                         {"signal", curve_signals(result)},
                         {"sigma_lambda", curve.sigma_lambda}};
    else
        not_determined[std::string{curve_name}] = curve.reason;
    const calibration::BiasTable& table = result.calibration.bias_table;
    if (table.knots.empty()) not_determined[std::string{table_name}] = table.reason;
    json goodness = json::object();
    for (const calibration::Goodness& g : result.calibration.goodness)
        goodness[g.name] = {{"value", g.value}, {"meaning", g.meaning}};
    json files = json::array();
    for (const study::CalibratedLog& f : result.logs) {
        files.push_back(
            {{"file", f.path}, {"duration_s", f.duration_s}, {"segments", f.segments}, {"relocks", f.relocks}});
        if (f.has_temperature) files.back()["temperature_c"] = {f.temperature_min_c, f.temperature_max_c};
    }
    return {{"constants", constants},
            {"not_determined", not_determined},
            {"bias_chi_higher", result.calibration.chi_higher},
            {"bias_temperature_table", {{"knots", table.knots}, {"sigma", table.sigma}}},
            {"discriminator", discriminator},
            {"goodness", goodness},
            {"files", files},
            {"tick_s", result.config.gyro.tick_s},
            {"scale_arcsec", result.config.gyro.scale_arcsec},
            {"reference_temperature_c", result.config.gyro.reference_temperature_c}};
}

struct CalibrateOptions : Options {
    std::vector<std::string> raws;
    std::vector<double> rate_arcsec_s;
    bool from_laser = false;
};

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
        .said = said_config(options),
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
    verb->add_option(
        "RAW", options->raws,
        "raw logs of one gyro, at rest or at a known rate, or files of other programs with counts (zlg import "
        "says what one of those is)");
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
