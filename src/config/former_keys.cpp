#include "former_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <zlg/config/log_settings.hpp>

namespace zlg::config {
namespace {

constexpr std::string_view learnt[]{"compensation.prior", "compensation.prior_band_hz",
                                    "compensation.prior_rate_arcsec_s", "compensation.prior_line_hz",
                                    "compensation.prior_line_arcsec_s"};

constexpr std::string_view fixed[]{"laser.scatter_phase_deg",
                                   "laser.comparator_threshold",
                                   "perimeter.sample_gain",
                                   "perimeter.settled_tau_s",
                                   "perimeter.set_points",
                                   "piezo.mirror_damping",
                                   "piezo.dac_bits",
                                   "piezo.adc_bits",
                                   "piezo.adc_noise_v",
                                   "photodiodes.skew_s",
                                   "photodiodes.jitter_s",
                                   "switching.switch_error_arcsec",
                                   "switching.magnetic_arcsec_s",
                                   "faults.vibration_hz",
                                   "analysis.least_known_ratio",
                                   "analysis.table_same_rate_ratio"};

constexpr std::string_view mapped[]{"analysis.comment", "analysis.skip_lines", "analysis.separator",
                                    "analysis.decimal"};

constexpr std::pair<std::span<const std::string_view>, std::string_view> groups[]{
    {learnt, "leave it out: the motion is learnt"},
    {fixed, "leave it out: its default is what is done"},
    {mapped, "take --map with the same key"},
};

constexpr FormerKey others[]{
    {"gyro.coil_current", "", "leave it out: the current is monitored, and not recorded"},
    {"switching.after_step", "", "leave it out: a switch waits for its time"},
    {"switching.schedule", "growing", "take switching.schedule = \"measured\""},
    {"compensation.bridge", "optimal", "take compensation.bridge = \"auto\""},
    {"gyro.counter_max_hz", "", "leave it out: the counter follows the bias and 400 deg/s"},
    {"switching.last_segment", "", "leave it out: the last segment is what the end of the run leaves of it"},
    {"analysis.taus_per_decade", "", "name the times in analysis.taus_s"},
    {"analysis.taus", "log", "name the times in analysis.taus_s"},
    {"analysis.deviations", "mtotdev", "take \"mdev\" or \"totdev\""},
    {"analysis.deviations", "htotdev", "take \"ohdev\""},
    {"analysis.total_bias", "", "leave it out: as_computed stands beside the deviation"},
    {"analysis.angles", "", "leave it out: the final angles are analysed"},
    {"analysis.latitude_deg", "",
     "leave it out: the Earth turns 15.041067 arcsec/s times sine of latitude about the vertical"},
    {"analysis.column", "", "take --map axis=COLUMN"},
    {"analysis.column_holds", "", "take --map holds=rate, increment or angle"},
    {"analysis.scale_arcsec", "", "take --map unit=..., or unit=counts with scale_arcsec=..."},
    {"analysis.rate_hz", "", "take --map rate_hz=..., where no column of times says it"},
    {"analysis.time_column", "", "take --map time=COLUMN, or time=none"},
    {"analysis.table_column", "", "take --map table_rate=COLUMN"},
    {"analysis.table_scale_arcsec_s", "", "take --map table_unit=..."},
};

}  // namespace

std::optional<FormerKey> find_former(std::string_view key, std::string_view value) {
    for (const FormerKey& other : others)
        if (other.key == key && value.find(other.value) != std::string_view::npos) return other;
    for (const auto& [keys, now] : groups)
        if (const auto found = std::find(keys.begin(), keys.end(), key); found != keys.end())
            return FormerKey{*found, "", now};
    return std::nullopt;
}

std::string shown(const FormerKey& former) {
    return std::string{former.key} + (former.value.empty() ? "" : fmt::format(" = \"{}\"", former.value));
}

std::optional<std::string> former_keys_note(const Settings& log_settings, std::string_view log_name) {
    std::string found;
    for (const auto& [key, value] : log_settings)
        if (const auto former = find_former(key, value)) found += (found.empty() ? "" : ", ") + shown(*former);
    if (found.empty()) return std::nullopt;
    return fmt::format("{}: settings of a former version are stepped over: {}", log_name, found);
}

}  // namespace zlg::config
