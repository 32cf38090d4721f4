#include <zlg/rig/refusal.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

namespace zlg::rig {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.'; }

bool names_key(std::string_view message, std::string_view key) {
    for (std::size_t at = message.find(key); at != std::string_view::npos; at = message.find(key, at + 1)) {
        const std::size_t end = at + key.size();
        const bool begins = at == 0 || !is_letter(message[at - 1]);
        if (begins && (end == message.size() || !is_letter(message[end]))) return true;
    }
    return false;
}

// Settings other than the defaults, but for [analysis].
config::Settings set_by_user(const config::Config& config) {
    config::Settings set;
    const config::Settings defaults = config::to_settings(config::Config{});
    for (const auto& setting : config::to_settings(config)) {
        if (!setting.first.starts_with("analysis.") &&
            std::find(defaults.begin(), defaults.end(), setting) == defaults.end())
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

std::string named(const config::Config& config, const std::string& message) {
    const config::Settings set = set_by_user(config);
    const auto is_named = [&](const auto& setting) { return names_key(message, setting.first); };
    if (set.empty() || std::any_of(set.begin(), set.end(), is_named)) return message;
    std::string list;
    for (const auto& setting : set) list += (list.empty() ? "" : ", ") + with_value(setting);
    return fmt::format("{}; set: {}", message, list);
}

void refuse(const config::Config& config, std::initializer_list<std::string_view> keys, std::string_view allowed) {
    std::string list;
    for (const auto& setting : config::to_settings(config))
        if (std::find(keys.begin(), keys.end(), setting.first) != keys.end())
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

void require_every_half(const config::Config& config, const std::string& log, const std::string& instead) {
    if (config.gyro.fidelity != config::Fidelity::events) return;
    throw config::ConfigError{fmt::format(
        "gyro.fidelity = \"events\": {} holds every half, and most lie within closed-form steps; {}", log, instead)};
}

}  // namespace zlg::rig
