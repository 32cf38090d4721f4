#include "settings_lines.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <zlg/logs/error.hpp>
#include <zlg/text/toml_depth.hpp>

namespace zlg::logs {
namespace {

constexpr std::string_view blanks = " \t";

// Prose with an equals sign in it is not a setting: a key has no blanks.
bool is_key(std::string_view text) { return !text.empty() && text.find_first_of(blanks) == std::string_view::npos; }

}  // namespace

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

void collect_setting(std::string_view line, Settings& settings) {
    line.remove_prefix(1);
    const auto equals = line.find('=');
    if (equals == std::string_view::npos) return;
    const std::string_view key = trimmed(line.substr(0, equals));
    if (is_key(key)) settings.emplace_back(key, trimmed(line.substr(equals + 1)));
}

void require_one_line(const std::string& key, const std::string& value) {
    if ((key + value).find_first_of(std::string_view{"\n\r\0", 3}) == std::string::npos) return;
    throw FormatError(fmt::format("the setting {} cannot be logged: it holds a line break or NUL", key));
}

void require_shallow_keys(const Settings& settings, const std::string& place) {
    for (const auto& [key, value] : settings) {
        const auto depth = std::count(key.begin(), key.end(), '.') + 1;
        if (depth > text::max_toml_levels)
            throw FormatError(fmt::format("{}: the setting {}... is nested {} deep; allowed is {}", place,
                                          key.substr(0, 40), depth, text::max_toml_levels));
    }
}

void write_settings(TableFile& file, const Settings& settings) {
    for (const auto& [key, value] : settings) {
        require_one_line(key, value);
        file.append(fmt::format("# {} = {}\n", key, value));
    }
}

const std::string* find_setting(const Settings& settings, const std::string& key) {
    const auto found = std::find_if(settings.rbegin(), settings.rend(), [&](const auto& s) { return s.first == key; });
    return found == settings.rend() ? nullptr : &found->second;
}

std::optional<double> said_tick_s(const Settings& settings) {
    for (const auto& [key, text] : settings) {
        const auto tick_s = key == "tick_s" ? number_in(text) : std::nullopt;
        if (tick_s && std::isfinite(*tick_s) && *tick_s > 0.0) return tick_s;
    }
    return std::nullopt;
}

std::optional<double> number_in(std::string text) {
    std::erase(text, '_');
    if (text.starts_with('+')) text.erase(0, 1);
    double value = 0.0;
    const auto [stop, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace zlg::logs
