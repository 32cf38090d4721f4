#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/config/schema.hpp>
#include <zlg/study/calibrate.hpp>

namespace zlg::study {
namespace {

using calibration::Constant;

// What the compensation is told with its sigma.
constexpr std::string_view lock_in_key = "compensation.lock_in_hz";

constexpr std::string_view chi_key = "gyro.bias_chi";

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

bool is_determined(const CalibrationResult& result, std::string_view key) {
    return std::ranges::any_of(result.calibration.constants,
                               [key](const Constant& c) { return c.key == key && c.estimate.determined; });
}

std::string toml_section(const CalibrationResult& result, const std::string& section) {
    std::string text;
    for (const Constant& c : result.calibration.constants)
        if (section_of(c.key) == section) text += toml_line(c);
    return text;
}

std::string list_line(std::string_view name, const std::vector<double>& values, std::string_view equals = " =") {
    std::string text = fmt::format("{}{} [", name, equals);
    for (std::size_t k = 0; k < values.size(); ++k)
        text += fmt::format("{}{:.{}g}", k == 0 ? "" : ", ", values[k], equals.empty() ? 2 : 7);
    return text + "]\n";
}

std::string curve_lines(const std::vector<double>& detuning_lambda, const std::vector<double>& signal) {
    return list_line("discriminator_detuning_lambda", detuning_lambda) + list_line("discriminator_signal", signal);
}

std::string curve_section(const CalibrationResult& result) {
    const calibration::LossCurve& curve = result.calibration.curve;
    if (!curve.determined) return fmt::format("# discriminator_signal: not determined: {}\n", curve.reason);
    return "# The inverse discriminator; bias_chi above holds with it, in the wavelengths of "
           "discriminator_detuning_lambda.\n" +
           curve_lines(curve.detuning_lambda, curve_signals(result)) +
           list_line("# +- lambda, of discriminator_detuning_lambda:", curve.sigma_lambda, "");
}

}  // namespace

std::vector<double> curve_signals(const CalibrationResult& result) {
    std::vector<double> signal = result.calibration.curve.logged_lambda;
    for (double& x : signal) x *= result.slope_per_lambda;
    return signal;
}

std::string calibration_toml(const rig::LaserCalibration& found) {
    const config::Gyro& gyro = found.config.gyro;
    std::string text = "# Derived by zlg calibrate from [laser].\n\n[gyro]\n";
    text += fmt::format("bias_hz = {:.10g}\n", gyro.bias_hz);
    text += fmt::format("bias_chi = {:.10g}  # the bias is within {:.2g} of its law up to 0.1 wavelength\n",
                        gyro.bias_chi, found.chi_error_ratio);
    text += fmt::format("discriminator_per_lambda = {:.10g}\n\n[perimeter]\n", gyro.discriminator_per_lambda);
    const bool goes_beyond = found.curve_error_beyond_lambda > 0.0;
    text += fmt::format("# Inverse discriminator: error {:.2g} wavelength up to {:.4g}{}.\n", found.curve_error_lambda,
                        found.third_wave_lambda,
                        goes_beyond ? fmt::format(", {:.2g} beyond", found.curve_error_beyond_lambda) : "");
    const config::Perimeter& perimeter = found.config.perimeter;
    return text + curve_lines(perimeter.discriminator_detuning_lambda, perimeter.discriminator_signal) +
           fmt::format("discriminator_centre_lambda = {:.7g}\n", perimeter.discriminator_centre_lambda);
}

std::string calibration_toml(const CalibrationResult& result) {
    std::string text =
        fmt::format("# Found by zlg calibrate in {} log{}. What was not determined keeps its default.\n\n[gyro]\n",
                    result.logs.size(), result.logs.size() == 1 ? "" : "s");
    for (const char* name : {"tick_s", "scale_arcsec", "reference_temperature_c"})
        text += fmt::format("{} = {}\n", name, text_of(result.config, fmt::format("gyro.{}", name)));
    text += toml_section(result, "gyro");
    if (is_determined(result, chi_key)) text += list_line("bias_chi_higher", result.calibration.chi_higher);
    const calibration::BiasTable& table = result.calibration.bias_table;
    text += table.knots.empty()
                ? fmt::format("# bias_temperature_table: not determined: {}\n", table.reason)
                : fmt::format("bias_temperature_table = {:::.8g}\n", table.knots) + list_line("# +-", table.sigma, "");
    if (!result.reference_warning.empty()) text += fmt::format("# warning: {}\n", result.reference_warning);
    text += "\n[perimeter]\n" + curve_section(result);
    for (const char* section : {"piezo", "field", "drift", "compensation"})
        text += fmt::format("\n[{}]\n{}", section, toml_section(result, section));
    for (const Constant& c : result.calibration.constants)
        if (c.key == lock_in_key && c.estimate.determined)
            text += fmt::format("lock_in_sigma_hz = {:.3g}\n", c.estimate.sigma);
    return text;
}

}  // namespace zlg::study
