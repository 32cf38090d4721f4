#include "log_settings.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include <zlg/config/spelling.hpp>

namespace zlg::python {
namespace {

void refuse_nearly_ours(const std::string& key, const std::string& name) {
    const std::size_t dot = key.find('.');
    if (dot == std::string::npos || config::is_known_section(key.substr(0, dot))) return;
    std::string section = key.substr(0, dot);
    std::ranges::transform(section, section.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const config::KeyInfo& known : config::describe_keys())
        if (config::letters_apart(section, known.section) <= 1)
            throw config::ConfigError{fmt::format("{}: {}: unknown section [{}]; did you mean [{}]?", name, key,
                                                  key.substr(0, dot), known.section)};
}

}  // namespace

config::Settings log_settings(config::Settings settings, const std::string& name) {
    std::map<std::string, std::string> seen;
    for (auto& [key, value] : settings) {
        if (key == "tick_s" || key == "scale_arcsec") key.insert(0, "gyro.");
        const auto [first, is_new] = seen.emplace(key, value);
        if (!is_new && first->second != value)
            throw config::ConfigError{fmt::format("{}: {} stands twice, as {} and as {}; allowed is one value", name,
                                                  key, first->second, value)};
        refuse_nearly_ours(key, name);
    }
    return settings;
}

}  // namespace zlg::python
