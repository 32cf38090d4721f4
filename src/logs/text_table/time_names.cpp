#include "time_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <string>
#include <vector>

namespace zlg::logs {

namespace {

// A word of the name, in small letters, and what is left behind it.
std::string next_word(std::string_view& name) {
    const auto is_letter = [](char c) {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || (static_cast<unsigned char>(c) & 0x80) != 0;
    };
    while (!name.empty() && !is_letter(name.front())) name.remove_prefix(1);
    std::string word;
    for (; !name.empty() && is_letter(name.front()); name.remove_prefix(1))
        word += static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
    return word;
}

struct NamedUnit {
    std::string_view name;
    double to_a_second;
};

constexpr std::array<NamedUnit, 16> units{{{"s", 1.0},
                                           {"sec", 1.0},
                                           {"secs", 1.0},
                                           {"second", 1.0},
                                           {"seconds", 1.0},
                                           {"sekunden", 1.0},
                                           {"ms", 1e3},
                                           {"msec", 1e3},
                                           {"us", 1e6},
                                           {"usec", 1e6},
                                           {"\xC2\xB5s", 1e6},
                                           {"\xCE\xBCs", 1e6},
                                           {"ns", 1e9},
                                           {"min", 1.0 / 60.0},
                                           {"h", 1.0 / 3600.0},
                                           {"hours", 1.0 / 3600.0}}};

// Of the words behind the first one, how many make a second.
std::vector<double> units_in(std::string_view name) {
    std::vector<double> all;
    (void)next_word(name);
    while (!name.empty()) {
        const std::string word = next_word(name);
        const auto found = std::ranges::find(units, std::string_view{word}, &NamedUnit::name);
        if (found != units.end()) all.push_back(found->to_a_second);
    }
    return all;
}

}  // namespace

std::optional<double> unit_of(std::string_view name) {
    const std::vector<double> all = units_in(name);
    return all.empty() ? std::nullopt : std::optional{all.front()};
}

bool names_two_units(std::string_view name) {
    const std::vector<double> all = units_in(name);
    return std::ranges::adjacent_find(all, std::ranges::not_equal_to{}) != all.end();
}

bool names_time(std::string_view column_name) {
    constexpr std::array<std::string_view, 11> words{"time",    "zeit",  "timestamp", "stamp",   "tow",        "utc",
                                                     "gpstime", "epoch", "datetime",  "uhrzeit", "zeitstempel"};
    std::string_view rest = column_name;
    const std::string word = next_word(rest);
    // T is a temperature, and so is t [C].
    if (word == "t" && column_name.find('t') != std::string_view::npos) {
        std::string_view behind = rest;
        return next_word(behind).empty() || unit_of(column_name).has_value();
    }
    return std::ranges::find(words, std::string_view{word}) != words.end();
}

}  // namespace zlg::logs
