#pragma once
// The settings above a log.

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace zlg::fuzz {

using Settings = std::vector<std::pair<std::string, std::string>>;

// A carriage return in the middle of a line is read and cannot be written; HDF5 holds settings as TOML, which is UTF-8
// and knows no control characters.
inline bool can_be_written(const Settings& settings, bool as_toml) {
    const auto is_plain = [](char c) { return c == '\t' || (c >= 0x20 && c < 0x7f); };
    return std::all_of(settings.begin(), settings.end(), [&](const auto& setting) {
        const std::string text = setting.first + setting.second;
        if (!as_toml) return text.find('\r') == std::string::npos;
        return std::all_of(text.begin(), text.end(), is_plain);
    });
}

inline Settings without(Settings settings, std::initializer_list<std::string_view> keys) {
    std::erase_if(settings, [&](const auto& s) { return std::find(keys.begin(), keys.end(), s.first) != keys.end(); });
    return settings;
}

}  // namespace zlg::fuzz
