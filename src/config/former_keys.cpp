#include "former_keys.hpp"

#include <fmt/format.h>

#include <array>
#include <zlg/config/log_settings.hpp>

namespace zlg::config {
namespace {

constexpr std::string_view motion_is_learnt = "leave it out: the motion is learnt";
constexpr std::string_view value_is_fixed = "leave it out: its default is what is done";
constexpr std::string_view layout_is_mapped = "take --map with the same key";

constexpr std::array<FormerKey, 44> formers{{
    {"gyro", "coil_current", "", 3, "leave it out: the current is monitored, and not recorded"},
    {"switching", "after_step", "", 3, "leave it out: a switch waits for its time"},
    {"switching", "schedule", "growing", 3, "take switching.schedule = \"measured\""},
    {"compensation", "bridge", "optimal", 3, "take compensation.bridge = \"auto\""},
    {"compensation", "prior", "", 3, motion_is_learnt},
    {"compensation", "prior_band_hz", "", 3, motion_is_learnt},
    {"compensation", "prior_rate_arcsec_s", "", 3, motion_is_learnt},
    {"compensation", "prior_line_hz", "", 3, motion_is_learnt},
    {"compensation", "prior_line_arcsec_s", "", 3, motion_is_learnt},
    {"gyro", "counter_max_hz", "", 3, "leave it out: the counter follows the bias and 400 deg/s"},
    {"laser", "scatter_phase_deg", "", 3, value_is_fixed},
    {"laser", "comparator_threshold", "", 3, value_is_fixed},
    {"laser", "dispersion", "", 3, value_is_fixed},
    {"perimeter", "sample_gain", "", 3, value_is_fixed},
    {"perimeter", "settled_tau_s", "", 3, value_is_fixed},
    {"perimeter", "set_points", "", 3, value_is_fixed},
    {"piezo", "mirror_damping", "", 3, value_is_fixed},
    {"piezo", "dac_bits", "", 3, value_is_fixed},
    {"piezo", "adc_bits", "", 3, value_is_fixed},
    {"piezo", "adc_noise_v", "", 3, value_is_fixed},
    {"photodiodes", "skew_s", "", 3, value_is_fixed},
    {"photodiodes", "jitter_s", "", 3, value_is_fixed},
    {"switching", "last_segment", "", 3, "leave it out: the last segment is what the end of the run leaves of it"},
    {"switching", "switch_error_arcsec", "", 3, value_is_fixed},
    {"switching", "magnetic_arcsec_s", "", 3, value_is_fixed},
    {"faults", "vibration_hz", "", 3, value_is_fixed},
    {"analysis", "taus_per_decade", "", 3, "name the times in analysis.taus_s"},
    {"analysis", "taus", "log", 3, "name the times in analysis.taus_s"},
    {"analysis", "least_known_ratio", "", 3, value_is_fixed},
    {"analysis", "total_bias", "", 3, "leave it out: as_computed stands beside the deviation"},
    {"analysis", "angles", "", 3, "leave it out: the final angles are analysed"},
    {"analysis", "latitude_deg", "", 3,
     "leave it out: the Earth turns 15.041067 arcsec/s times sine of latitude about the vertical"},
    {"analysis", "table_same_rate_ratio", "", 3, value_is_fixed},
    {"analysis", "column", "", 3, "take --map axis=COLUMN"},
    {"analysis", "column_holds", "", 3, "take --map holds=rate, increment or angle"},
    {"analysis", "scale_arcsec", "", 3, "take --map unit=..., or unit=counts with scale_arcsec=..."},
    {"analysis", "rate_hz", "", 3, "take --map rate_hz=..., where no column of times says it"},
    {"analysis", "comment", "", 3, layout_is_mapped},
    {"analysis", "skip_lines", "", 3, layout_is_mapped},
    {"analysis", "separator", "", 3, layout_is_mapped},
    {"analysis", "decimal", "", 3, layout_is_mapped},
    {"analysis", "time_column", "", 3, "take --map time=COLUMN, or time=none"},
    {"analysis", "table_column", "", 3, "take --map table_rate=COLUMN"},
    {"analysis", "table_scale_arcsec_s", "", 3, "take --map table_unit=..."},
}};

// Without blanks about it and the quotes of a text.
std::string_view bare(std::string_view value) {
    constexpr std::string_view around = " \t\"'";
    const auto first = value.find_first_not_of(around);
    return first == std::string_view::npos ? std::string_view{}
                                           : value.substr(first, value.find_last_not_of(around) - first + 1);
}

}  // namespace

const FormerKey* find_former(std::string_view section, std::string_view name, std::string_view value) {
    for (const FormerKey& former : formers)
        if (former.section == section && former.name == name && (former.value.empty() || former.value == bare(value)))
            return &former;
    return nullptr;
}

std::string shown(const FormerKey& former) {
    const std::string value = former.value.empty() ? "" : fmt::format(" = \"{}\"", former.value);
    return fmt::format("{}.{}{}", former.section, former.name, value);
}

std::optional<std::string> former_keys_note(const Settings& log_settings, std::string_view log_name) {
    std::string found;
    for (const auto& [key, value] : log_settings) {
        const auto dot = std::min(key.find('.'), key.size());
        const std::string_view name = dot == key.size() ? std::string_view{} : std::string_view{key}.substr(dot + 1);
        const FormerKey* former = find_former(std::string_view{key}.substr(0, dot), name, value);
        if (former != nullptr) found += (found.empty() ? "" : ", ") + shown(*former);
    }
    if (found.empty()) return std::nullopt;
    return fmt::format("{}: settings of a former version are stepped over: {}", log_name, found);
}

}  // namespace zlg::config
