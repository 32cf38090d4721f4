#include "settings_lines.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/toml_depth.hpp>

namespace zlg::logs {
namespace {

constexpr std::string_view blanks = " \t";

// Prose with an equals sign in it is not a setting: a key has no blanks.
bool is_key(std::string_view text) { return !text.empty() && text.find_first_of(blanks) == std::string_view::npos; }

bool is_fingerprint(std::string_view text) {
    return text.size() == fingerprint_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// Takes the settings of that name out of them: `read(text)` is what one says, nothing where it is a note that stays.
//
// return  what all of them say; nothing where there is none.
template <class Read>
auto take_setting(Settings& settings, const std::string& name, const std::string& path, Read read) {
    decltype(read(std::string{})) found;
    std::erase_if(settings, [&](const auto& setting) {
        const auto said = setting.first == name ? read(setting.second) : std::nullopt;
        if (said && found && *found != *said)
            throw FormatError(
                fmt::format("{}: {} stands twice, as {} and as {}; allowed is one value", path, name, *found, *said));
        if (said) found = said;
        return said.has_value();
    });
    return found;
}

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

const std::string* find_of_gyro(const Settings& settings, const std::string& name) {
    const std::string* found = find_setting(settings, "gyro." + name);
    return found != nullptr ? found : find_setting(settings, name);
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

void check_timer_hz(double timer_hz, const std::string& place) {
    if (timer_hz >= 1.0 && timer_hz <= 1e15) return;
    throw FormatError(
        fmt::format("{}: edge_offset_ticks needs the timer's ticks per second: {} = {}; allowed is 1..1e15", place,
                    timer_setting, timer_hz));
}

double take_timer_hz(Settings& settings, std::optional<double> of_root, const std::string& place) {
    std::optional<double> found = of_root;
    std::erase_if(settings, [&](const auto& setting) {
        if (setting.first != timer_setting) return false;
        const std::optional<double> value = number_in(setting.second);
        if (!value || (found && *found != *value))
            throw FormatError(
                fmt::format("{}: {} = {}; allowed is one number, 1..1e15", place, timer_setting, setting.second));
        found = value;
        return true;
    });
    if (!found) {
        throw FormatError(fmt::format(
            "{}: the column edge_offset_ticks needs the timer's ticks per second: {} is missing (CSV: a line `# {} = "
            "...`, HDF5: an attribute of the root)",
            place, timer_setting, timer_setting));
    }
    check_timer_hz(*found, place);
    return *found;
}

int checked_format_version(double value, const std::string& place) {
    for (int known = first_format_version; known <= format_version; ++known)
        if (value == known) return known;
    throw FormatError(fmt::format("{}: format_version is {}; allowed is {} to {}", place, value, first_format_version,
                                  format_version));
}

FormatVersion take_format_version(Settings& settings, const std::string& path) {
    return take_setting(settings, version_setting, path, [&path](const std::string& text) -> FormatVersion {
        const auto number = number_in(text);
        if (!number) throw FormatError(fmt::format("{}: format_version is '{}'; allowed is a number", path, text));
        return checked_format_version(*number, path);
    });
}

void require_fingerprint(const std::string& fingerprint, const std::string& place) {
    if (is_fingerprint(fingerprint)) return;
    throw FormatError(fmt::format("{}: the fingerprint is '{}'; allowed are {} hexadecimal digits", place,
                                  text::excerpt(fingerprint, 40, '?'), fingerprint_digits));
}

void refuse_fingerprint(const std::string& path) {
    throw FormatError(fmt::format("{}: has no room for a fingerprint; allowed is one with has_fingerprint", path));
}

std::string take_fingerprint(Settings& settings, const std::string& path) {
    std::erase(settings, std::pair{std::string{"fingerprint"}, std::string{no_fingerprint}});
    const auto said = [](const std::string& text) { return is_fingerprint(text) ? std::optional{text} : std::nullopt; };
    return take_setting(settings, "fingerprint", path, said).value_or("");
}

}  // namespace zlg::logs
