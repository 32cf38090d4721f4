#include "calibration_text.hpp"

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

namespace zlg::cli {
namespace {

using analysis::Constant;
using nlohmann::json;

// No key of a configuration: it says how to renew two of them.
constexpr std::string_view scale_name = "detuning_scale";

std::string with_unit(const std::string& text, const std::string& unit) {
    return unit.empty() ? text : text + " " + unit;
}

// The configuration's own text of a key, so that it compares equal to a log's.
std::string text_of(const config::Config& config, std::string_view dotted_key) {
    for (const auto& [key, value] : config::to_settings(config))
        if (key == dotted_key) return value;
    return {};
}

std::string section_of(const std::string& key) { return key.substr(0, key.find('.')); }

std::string name_of(const std::string& key) { return key.substr(key.find('.') + 1); }

std::string toml_line(const Constant& c) {
    const std::string name = name_of(c.key);
    if (!c.estimate.determined) return fmt::format("# {}: not determined: {}\n", name, c.estimate.reason);
    return fmt::format("{} = {:.10g}  # +- {}\n", name, c.estimate.value,
                       with_unit(fmt::format("{:.3g}", c.estimate.sigma), c.unit));
}

std::string toml_section(const CalibrationResult& result, const std::string& section) {
    std::string text;
    for (const Constant& c : result.calibration.constants)
        if (c.key != scale_name && section_of(c.key) == section) text += toml_line(c);
    return text;
}

std::string scale_comment(const Constant& c) {
    if (!c.estimate.determined) return fmt::format("# {}: not determined: {}\n", c.key, c.estimate.reason);
    return fmt::format(
        "# {0} = {1:.6g} +- {2:.3g}: logged wavelengths per true one. bias_chi above is in logged units, as process "
        "needs it\n"
        "# for these logs. To log true wavelengths from now on, multiply discriminator_per_lambda by {1:.6g} and "
        "bias_chi by "
        "{3:.6g}.\n",
        c.key, c.estimate.value, c.estimate.sigma, c.estimate.value * c.estimate.value);
}

}  // namespace

std::string calibration_text(const CalibrationResult& result) {
    std::string text = fmt::format("{:<46}{:>16}{:>12}  unit\n", "constant", "value", "+-");
    for (const Constant& c : result.calibration.constants) {
        if (!c.estimate.determined) continue;
        text += fmt::format("{:<46}{:>16.8g}{:>12.3g}{}\n", c.key, c.estimate.value, c.estimate.sigma,
                            c.unit.empty() ? "" : "  " + c.unit);
    }
    for (const Constant& c : result.calibration.constants)
        if (!c.estimate.determined) text += fmt::format("{}: not determined: {}\n", c.key, c.estimate.reason);
    text += "\ngoodness of fit\n";
    for (const analysis::Goodness& g : result.calibration.goodness)
        text += fmt::format("{:<46}{:>16.4g}  {}\n", g.name, g.value, g.meaning);
    text += "\nlogs\n";
    for (const CalibrationFile& f : result.files)
        text += fmt::format(
            "{}: {:.6g} s, {} segments, {} re-locks{}\n", f.path, f.duration_s, f.segments, f.relocks,
            f.has_temperature ? fmt::format(", {:.4g}..{:.4g} C", f.temperature_min_c, f.temperature_max_c) : "");
    return text;
}

std::string calibration_toml(const CalibrationResult& result) {
    std::string text =
        fmt::format("# Found by zlg calibrate in {} log{}. What was not determined keeps its default.\n\n[gyro]\n",
                    result.files.size(), result.files.size() == 1 ? "" : "s");
    for (const char* name : {"tick_s", "scale_arcsec", "reference_temperature_c"})
        text += fmt::format("{} = {}\n", name, text_of(result.config, fmt::format("gyro.{}", name)));
    text += toml_section(result, "gyro");
    if (!result.warning.empty()) text += fmt::format("# warning: {}\n", result.warning);
    for (const Constant& c : result.calibration.constants)
        if (c.key == scale_name) text += scale_comment(c);
    for (const char* section : {"piezo", "drift"})
        text += fmt::format("\n[{}]\n{}", section, toml_section(result, section));
    return text;
}

json calibration_json(const CalibrationResult& result) {
    json constants = json::object();
    json not_determined = json::object();
    for (const Constant& c : result.calibration.constants) {
        if (c.estimate.determined)
            constants[c.key] = {{"value", c.estimate.value}, {"sigma", c.estimate.sigma}, {"unit", c.unit}};
        else
            not_determined[c.key] = c.estimate.reason;
    }
    json goodness = json::object();
    for (const analysis::Goodness& g : result.calibration.goodness)
        goodness[g.name] = {{"value", g.value}, {"meaning", g.meaning}};
    json files = json::array();
    for (const CalibrationFile& f : result.files) {
        files.push_back(
            {{"file", f.path}, {"duration_s", f.duration_s}, {"segments", f.segments}, {"relocks", f.relocks}});
        if (f.has_temperature) files.back()["temperature_c"] = {f.temperature_min_c, f.temperature_max_c};
    }
    return {{"constants", constants},
            {"not_determined", not_determined},
            {"goodness", goodness},
            {"files", files},
            {"tick_s", result.config.gyro.tick_s},
            {"scale_arcsec", result.config.gyro.scale_arcsec},
            {"reference_temperature_c", result.config.gyro.reference_temperature_c}};
}

}  // namespace zlg::cli
