#include "toml_settings.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <zlg/text/toml_document.hpp>
#include <zlg/text/toml_text.hpp>

#include <algorithm>
#include <array>
#include <sstream>
#include <zlg/logs/error.hpp>

#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

// The parser counts letters, not bytes.
std::string_view letters(std::string_view line, std::size_t first, std::size_t end) {
    const auto byte_of = [&](std::size_t letter) {
        std::size_t byte = 0;
        for (std::size_t n = 1; byte < line.size(); ++byte) {
            const bool begins_a_letter = (static_cast<unsigned char>(line[byte]) & 0xC0) != 0x80;
            if (begins_a_letter && n++ == letter) break;
        }
        return byte;
    };
    const std::size_t begin = byte_of(first);
    return line.substr(begin, byte_of(end) - begin);
}

std::string real(double value) {
    std::string text = fmt::format("{}", value);
    const bool is_real = text.find_first_of(".eni") != std::string::npos;
    return is_real ? text : text + ".0";
}

// On one line, and such that it reads back to the same value.
std::string spelled(const toml::node& node) {
    std::string text;
    if (const toml::array* array = node.as_array()) {
        for (const toml::node& element : *array) text += (text.empty() ? "" : ", ") + spelled(element);
        return "[" + text + "]";
    }
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table) {
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", text::toml_string(key.str()), spelled(value));
        }
        return "{" + text + "}";
    }
    if (const auto* string = node.as_string()) return text::toml_string(string->get());
    if (const auto* number = node.as_floating_point()) return real(number->get());
    std::ostringstream other;
    node.visit([&](const auto& value) { other << value; });
    return other.str();
}

bool is_toml_value(std::string_view text) {
    try {
        const toml::table document = text::parse_toml(fmt::format("v = {}", text));
        return document.size() == 1 && document.contains("v");
    } catch (const toml::parse_error&) {
        return false;
    }
}

// The document's own spelling, where the value is on one line. A literal string that would be no TOML without its
// quotes is how a bare text was written.
std::string text_of(const toml::node& value, const std::vector<std::string_view>& lines) {
    const toml::source_region& at = value.source();
    if (at.begin.line == 0 || at.begin.line != at.end.line || at.begin.line > lines.size()) return spelled(value);
    const std::string_view slice = letters(lines[at.begin.line - 1], at.begin.column, at.end.column);
    const auto* string = value.as_string();
    if (string != nullptr && slice == fmt::format("'{}'", string->get()) && !is_toml_value(string->get())) {
        return string->get();
    }
    return is_toml_value(slice) ? std::string{slice} : spelled(value);
}

struct Found {
    toml::source_position at;
    std::string key;
    std::string value;
};

struct Collector {
    void collect(const toml::table& table, const std::string& prefix) {
        for (const auto& [name, value] : table) {
            const std::string key = prefix + std::string{name.str()};
            if (const toml::table* inner = value.as_table()) {
                collect(*inner, key + ".");
                continue;
            }
            const toml::source_region& at = value.source();
            for (auto line = at.begin.line; line <= at.end.line && line <= is_value.size(); ++line) {
                is_value[line - 1] = true;
            }
            found.push_back({at.begin, key, text_of(value, lines)});
        }
    }

    void collect_comments() {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            Settings setting;
            if (lines[i].starts_with('#') && !is_value[i]) collect_setting(lines[i], setting);
            const auto line = static_cast<toml::source_index>(i + 1);
            for (auto& [key, value] : setting) found.push_back({{line, 1}, std::move(key), std::move(value)});
        }
    }

    std::vector<std::string_view> lines;
    std::vector<bool> is_value = std::vector<bool>(lines.size());  // inside a string of several lines, # is no comment
    std::vector<Found> found;
};

bool is_dotted_key(std::string_view key) {
    constexpr std::string_view letters_of_keys = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
    return key.find('.') != std::string_view::npos && key.find_first_not_of(letters_of_keys) == std::string_view::npos;
}

// TOML takes a key once, and a value cannot be a section too.
bool collides(std::string_view key, const std::vector<std::string_view>& keys) {
    const auto contains = [](std::string_view section, std::string_view inner) {
        return inner.starts_with(section) && (inner.size() == section.size() || inner[section.size()] == '.');
    };
    return std::ranges::any_of(keys,
                               [&](std::string_view other) { return contains(key, other) || contains(other, key); });
}

bool reads_back(const std::string& line, const std::string& key, const std::string& value) {
    try {
        const Settings settings = settings_from_toml(line, "");
        return settings.size() == 1 && settings[0].first == key && settings[0].second == value;
    } catch (const FormatError&) {
        return false;
    }
}

// TOML is UTF-8 throughout; one stray byte would make the whole text unreadable.
std::string comment_line(const std::string& key, const std::string& value) {
    std::string line = fmt::format("# {} = {}\n", key, value);
    try {
        static_cast<void>(settings_from_toml(line, ""));
        return line;
    } catch (const FormatError&) {
        throw FormatError(fmt::format(
            "the setting {} cannot be logged as HDF5: allowed is UTF-8 text without control characters", key));
    }
}

}  // namespace

std::string settings_to_toml(const Settings& settings) {
    std::string text;
    std::vector<std::string_view> keys;
    for (const auto& setting : settings) {
        const auto& key = setting.first;  // a structured binding cannot be captured by every compiler's lambda
        const auto& value = setting.second;
        require_one_line(key, value);
        const std::array lines{fmt::format("{} = {}\n", key, value), fmt::format("{} = '{}'\n", key, value)};
        const bool is_free = is_dotted_key(key) && !collides(key, keys);
        const auto line = std::ranges::find_if(
            lines, [&](const std::string& candidate) { return is_free && reads_back(candidate, key, value); });
        if (line != lines.end()) keys.push_back(key);
        text += line != lines.end() ? *line : comment_line(key, value);
    }
    return text;
}

Settings settings_from_toml(std::string_view text, const std::string& place) {
    Collector collector{.lines = lines_of(text)};
    try {
        const toml::table document = text::parse_toml(text);
        collector.collect(document, "");
    } catch (const toml::parse_error& error) {
        const auto& at = error.source().begin;
        throw FormatError(fmt::format("{}:{}:{}: {}", place, at.line, at.column, error.description()));
    }
    collector.collect_comments();
    std::ranges::stable_sort(collector.found, [](const Found& a, const Found& b) { return a.at < b.at; });
    Settings settings;
    for (Found& found : collector.found) settings.emplace_back(std::move(found.key), std::move(found.value));
    return settings;
}

}  // namespace zlg::logs
