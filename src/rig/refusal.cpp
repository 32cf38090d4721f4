#include "refusal.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

namespace zlg::rig {
namespace {

using Name = std::pair<std::string_view, std::string_view>;

constexpr auto twin_names = std::to_array<Name>({
    {"tick_s", "gyro.tick_s"},
    {"scale_arcsec", "gyro.scale_arcsec"},
    {"bias_hz", "gyro.bias_hz"},
    {"bias_chi", "gyro.bias_chi"},
    {"bias_edge_s", "gyro.bias_edge_s"},
    {"first_bias_sign", "gyro.first_bias_sign"},
    {"bias_temperature_coefficient_per_c", "gyro.bias_temperature_coefficient_per_c"},
    {"reference_temperature_c", "gyro.reference_temperature_c"},
    {"temperature_rise_c", "gyro.temperature_rise_c"},
    {"light_samples", "gyro.light_samples"},
    {"light_noise_lambda", "gyro.light_noise_lambda"},
    {"discriminator_per_lambda", "gyro.discriminator_per_lambda"},
    {"counter_max_hz", "gyro.counter_max_hz"},
    {"magnetic_arcsec_s", "drift.magnetic_arcsec_s"},
    {"magnetic_thermal_arcsec_s", "drift.magnetic_thermal_arcsec_s"},
    {"thermal_time_s", "drift.thermal_time_s"},
    {"nonmagnetic_arcsec_s", "drift.nonmagnetic_arcsec_s"},
    {"random_walk_arcsec_sqrt_s", "drift.random_walk_arcsec_sqrt_s"},
    {"loop_tau_s", "perimeter.tau_s"},
    {"loop_limit_lambda", "perimeter.limit_lambda"},
    {"miss_lambda", "perimeter.miss_lambda"},
    {"expansion_lambda_per_c", "perimeter.expansion_lambda_per_c"},
    {"half_wave_v", "piezo.half_wave_v"},
    {"half_wave_temperature_coefficient_per_c", "piezo.half_wave_temperature_coefficient_per_c"},
    {"piezo_hysteresis", "piezo.hysteresis"},
    {"piezo_hysteresis_stroke_v", "piezo.hysteresis_stroke_v"},
    {"piezo_creep_per_decade", "piezo.creep_per_decade"},
    {"mirror_hz", "piezo.mirror_hz"},
    {"mirror_damping", "piezo.mirror_damping"},
    {"high_voltage_rc_s", "piezo.rc_s"},
    {"slew_v_s", "piezo.slew_v_s"},
    {"piezo_min_v", "piezo.range_min_v"},
    {"piezo_max_v", "piezo.range_max_v"},
    {"dac_bits", "piezo.dac_bits"},
    {"adc_bits", "piezo.adc_bits"},
    {"adc_noise_v", "piezo.adc_noise_v"},
    {"vibration_hz", "faults.vibration_hz"},
    {"external", "digital"},
});

constexpr auto laser_names = std::to_array<Name>({
    {"perimeter_m", "laser.perimeter_m"},
    {"round_trip_loss_ratio", "laser.round_trip_loss_ratio"},
    {"gain_loss_ratio", "laser.gain_loss_ratio"},
    {"doppler_half_width_hz", "laser.doppler_half_width_hz"},
    {"homogeneous_half_width_hz", "laser.homogeneous_half_width_hz"},
    {"isotope_shift_hz", "laser.isotope_shift_hz"},
    {"upper_isotope_ratio", "laser.upper_isotope_ratio"},
    {"zeeman_hz_per_g", "laser.zeeman_hz_per_g"},
    {"opposite_sigma_coupling", "laser.opposite_sigma_coupling"},
    {"bias_field_g", "laser.bias_field_g"},
    {"max_field_g", "laser.bias_field_g"},
    {"lock_left_hz", "laser.lock_in_left_hz"},
    {"lock_right_hz", "laser.lock_in_right_hz"},
    {"scatter_phase_rad", "laser.scatter_phase_deg"},
    {"comparator_threshold", "laser.comparator_threshold"},
    {"counts_per_turn", "laser.quadrature"},
});

constexpr auto fault_names =
    std::to_array<Name>({{"at_s", "faults.at_s"}, {"duration_s", "faults.duration_s"}, {"size", "faults.size"}});

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.'; }

std::string_view key_of(std::string_view word, std::span<const Name> names) {
    const auto found = std::ranges::find(names, word, &Name::first);
    return found != names.end() ? found->second : word;
}

std::string replaced(std::string_view text, std::span<const Name> names) {
    std::string result;
    while (!text.empty()) {
        std::size_t n = 0;
        while (n < text.size() && is_letter(text[n])) ++n;
        result += key_of(text.substr(0, n), names);
        if (n < text.size()) result += text[n++];
        text.remove_prefix(n);
    }
    return result;
}

bool names_key(std::string_view message, std::string_view key) {
    for (std::size_t at = message.find(key); at != std::string_view::npos; at = message.find(key, at + 1)) {
        const std::size_t end = at + key.size();
        const bool begins = at == 0 || !is_letter(message[at - 1]);
        if (begins && (end == message.size() || !is_letter(message[end]))) return true;
    }
    return false;
}

// What makes a gyro, where it differs from the default.
config::Settings set_by_user(const config::Config& config) {
    config::Settings set;
    const config::Settings defaults = config::to_settings(config::Config{});
    for (const auto& setting : config::to_settings(config)) {
        if (!setting.first.starts_with("analysis.") && std::ranges::find(defaults, setting) == defaults.end())
            set.push_back(setting);
    }
    return set;
}

std::string with_value(const std::pair<std::string, std::string>& setting) {
    constexpr std::size_t longest = 60;
    return fmt::format("{} = {}{}", setting.first, setting.second.substr(0, longest),
                       setting.second.size() > longest ? "..." : "");
}

}  // namespace

std::string with_keys(std::string_view message) {
    std::span<const Name> names{twin_names};
    if (message.starts_with("twin: fault ")) names = fault_names;
    if (message.starts_with("laser") || message.starts_with("twin: laser")) names = laser_names;
    for (const std::string_view prefix : {"twin: ", "laser: ", "laser."})
        if (message.starts_with(prefix)) message.remove_prefix(prefix.size());
    return replaced(message, names);
}

std::string named(const config::Config& config, const std::string& message) {
    const config::Settings set = set_by_user(config);
    const auto is_named = [&](const auto& setting) { return names_key(message, setting.first); };
    if (set.empty() || std::ranges::any_of(set, is_named)) return message;
    std::string list;
    for (const auto& setting : set) list += (list.empty() ? "" : ", ") + with_value(setting);
    return fmt::format("{}; set: {}", message, list);
}

void refuse(const config::Config& config, std::initializer_list<std::string_view> keys, std::string_view allowed) {
    std::string list;
    for (const auto& setting : config::to_settings(config))
        if (std::ranges::find(keys, setting.first) != keys.end())
            list += (list.empty() ? "" : ", ") + with_value(setting);
    throw config::ConfigError{named(config, fmt::format("{}: allowed is {}", list, allowed))};
}

void refuse_rate(const config::Config& config, std::string_view what) {
    std::string list;
    for (const auto& setting : set_by_user(config))
        for (const std::string_view section :
             {"gyro.", "laser.", "drift.", "motion.", "faults.", "perimeter.", "piezo."})
            if (setting.first.starts_with(section)) list += with_value(setting) + ", ";
    throw config::ConfigError{fmt::format("{}a rate beyond any counter: {}", list, what)};
}

}  // namespace zlg::rig
