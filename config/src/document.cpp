#include <fmt/format.h>

#include <zlg/config/schema.hpp>

#include "key.hpp"

namespace zlg::config {

Settings to_settings(const Config& config) {
    Settings settings;
    for (const Key& key : all_keys()) {
        std::string text = value_text(key, config);
        if (!text.empty()) settings.emplace_back(dotted(key), std::move(text));
    }
    return settings;
}

std::string to_toml(const Config& config) {
    std::string text;
    std::string_view section;
    for (const Key& key : all_keys()) {
        if (key.section != section) {
            section = key.section;
            text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
        }
        const std::string value = value_text(key, config);
        if (!value.empty()) text += fmt::format("{} = {}\n", key.name, value);
    }
    return text;
}

std::vector<KeyInfo> describe_keys() {
    const Config defaults;
    std::vector<KeyInfo> infos;
    for (const Key& key : all_keys()) {
        infos.push_back({std::string{key.section}, std::string{key.name}, std::string{key.unit},
                         std::string{key.meaning}, value_text(key, defaults), allowed_text(key)});
    }
    return infos;
}

std::string reference_markdown() {
    std::string text;
    std::string section;
    for (const KeyInfo& key : describe_keys()) {
        if (key.section != section) {
            section = key.section;
            text += fmt::format("{}## [{}]\n\n| key | unit | default | allowed | meaning |\n|---|---|---|---|---|\n",
                                text.empty() ? "" : "\n", section);
        }
        const std::string default_cell = key.default_text.empty() ? "unset" : fmt::format("`{}`", key.default_text);
        text +=
            fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.unit, default_cell, key.allowed, key.meaning);
    }
    return text;
}

}  // namespace zlg::config
