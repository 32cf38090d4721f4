#include <fmt/format.h>

#include <array>
#include <zlg/config/schema.hpp>

#include "key.hpp"

namespace zlg::config {

namespace {

bool is_ours(std::string_view dotted_key) {
    const auto dot = dotted_key.find('.');
    return dot != std::string_view::npos && is_known_section(dotted_key.substr(0, dot));
}

// These say how the counts were recorded, so that another value would make wrong angles of them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> facts_of_a_log{
    {{"gyro", "tick_s"}, {"gyro", "scale_arcsec"}}};

}  // namespace

void apply_log(Config& config, const Settings& log_settings, std::string_view log_name) {
    Config result = config;
    for (const auto& [key, value] : log_settings) {
        if (is_ours(key)) apply_pair(result, key, value, log_name);
    }
    config = std::move(result);
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
