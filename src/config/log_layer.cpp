#include <fmt/format.h>

#include <array>
#include <map>
#include <zlg/config/log_settings.hpp>
#include <zlg/config/schema.hpp>

#include "former_keys.hpp"
#include "key.hpp"

namespace zlg::config {

namespace {

bool is_ours(std::string_view dotted_key, std::string_view value) {
    const auto dot = dotted_key.find('.');
    if (dot == std::string_view::npos || !is_known_section(dotted_key.substr(0, dot))) return false;
    return !find_former(dotted_key, value);
}

// These say how the counts were recorded, so that another value would make wrong angles of them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> facts_of_a_log{
    {{"gyro", "tick_s"}, {"gyro", "scale_arcsec"}}};

// As the key's value, for one number can be written in many ways.
std::string read_value(std::string_view dotted_key, std::string_view value, std::string_view log_name) {
    Config config;
    apply_pair(config, dotted_key, value, log_name);
    const auto dot = dotted_key.find('.');
    return value_text(*find_key(dotted_key.substr(0, dot), dotted_key.substr(dot + 1)), config);
}

void refuse_nearly_ours(std::string_view dotted_key, std::string_view log_name) {
    const auto dot = dotted_key.find('.');
    if (dot == std::string_view::npos) return;
    const std::string_view section = dotted_key.substr(0, dot);
    if (const auto meant = misspelt_section(section))
        throw ConfigError(
            fmt::format("{}: {}: unknown section [{}]; did you mean [{}]?", log_name, dotted_key, section, *meant));
}

}  // namespace

Settings checked_log_settings(Settings log_settings, std::string_view log_name) {
    std::map<std::string, std::string> seen;
    for (auto& [key, value] : log_settings) {
        if (key == "tick_s" || key == "scale_arcsec") key.insert(0, "gyro.");
        refuse_nearly_ours(key, log_name);
        if (!is_ours(key, value)) continue;
        const auto [first, is_new] = seen.emplace(key, value);
        if (is_new || first->second == value) continue;
        if (read_value(key, first->second, log_name) != read_value(key, value, log_name))
            throw ConfigError(fmt::format("{}: {} stands twice, as {} and as {}; allowed is one value", log_name, key,
                                          first->second, value));
    }
    return log_settings;
}

void apply_log(Config& config, const Settings& log_settings, std::string_view log_name) {
    Config result = config;
    for (const auto& [key, value] : log_settings) {
        if (is_ours(key, value)) apply_pair(result, key, value, log_name);
    }
    config = std::move(result);
}

void require_log_facts(const Config& config, std::string_view log_name, bool scale_is_used) {
    std::string absent;
    std::string cure;
    const auto look = [&](std::string_view name, std::string_view unit) {
        const std::string key = fmt::format("gyro.{}", name);
        if (is_given(config, key)) return;
        absent += fmt::format("{}{}", absent.empty() ? "" : " and ", name);
        cure += fmt::format(" --set {}={}", key, unit);
    };
    look("tick_s", "SECONDS");
    if (scale_is_used) look("scale_arcsec", "ARCSEC_PER_COUNT");
    if (absent.empty()) return;
    throw ConfigError(
        fmt::format("{}: does not say {}, for which there is no default; give{}", log_name, absent, cure));
}

void check_against_log(const Config& config, const Settings& log_settings, std::string_view log_name) {
    Config logged = config;
    apply_log(logged, log_settings, log_name);
    for (const auto& [section, name] : facts_of_a_log) {
        const Key& key = *find_key(section, name);
        const std::string ours = value_text(key, config);
        const std::string of_log = value_text(key, logged);
        if (ours == of_log) continue;
        throw ConfigError(fmt::format("{} = {}: {} was recorded with {}; allowed is that value or none", dotted(key),
                                      ours, log_name, of_log));
    }
}

}  // namespace zlg::config
