#include <algorithm>
#include <span>
#include <variant>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

#include "key.hpp"

namespace zlg::config {
namespace {

std::vector<std::string> words(std::span<const std::string_view> names) { return {names.begin(), names.end()}; }

// What a program that fills a Config from outside must know of the value.
void tell_kind(const Slot& slot, KeyInfo& info) {
    info.kind = static_cast<ValueKind>(slot.index());
    if (const auto* choices = std::get_if<ChoiceList>(&slot)) info.choices = words(choices->names);
    const auto* choice = std::get_if<Choice>(&slot);
    if (choice == nullptr) return;
    info.choices = words(choice->names);
    if (choice->get({}) < 0) info.kind = ValueKind::optional_choice;
}

}  // namespace

Settings to_settings(const Config& config) {
    Settings settings;
    for (const Key& key : all_keys()) {
        std::string text = value_text(key, config);
        if (!text.empty()) settings.emplace_back(dotted(key), std::move(text));
    }
    return settings;
}

Settings changed_settings(const Config& config) {
    const Settings defaults = to_settings({});
    Settings settings = to_settings(config);
    std::erase_if(settings, [&](const auto& each) {
        return std::find(defaults.begin(), defaults.end(), each) != defaults.end();
    });
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
        infos.push_back({std::string{key.section},
                         std::string{key.name},
                         std::string{key.unit},
                         std::string{key.meaning},
                         value_text(key, defaults),
                         allowed_text(key),
                         {},
                         {}});
        tell_kind(key.slot, infos.back());
    }
    return infos;
}

std::string unit_of(std::string_view dotted_key) {
    const auto dot = dotted_key.find('.');
    return std::string{find_key(dotted_key.substr(0, dot), dotted_key.substr(dot + 1))->unit};
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
