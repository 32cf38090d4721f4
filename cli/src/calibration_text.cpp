#include "calibration_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "output.hpp"

namespace zlg::cli {
namespace {

using calibration::Constant;
using nlohmann::json;
using study::curve_signals;

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

}  // namespace

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
    for (const Constant& c : result.calibration.constants)
        if (!c.estimate.determined) text += fmt::format("{}: not determined: {}\n", c.key, c.estimate.reason);
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
            {"discriminator", discriminator},
            {"goodness", goodness},
            {"files", files},
            {"tick_s", result.config.gyro.tick_s},
            {"scale_arcsec", result.config.gyro.scale_arcsec},
            {"reference_temperature_c", result.config.gyro.reference_temperature_c}};
}

}  // namespace zlg::cli
