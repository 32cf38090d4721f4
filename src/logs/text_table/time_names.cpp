#include "time_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <string>
#include <vector>

namespace zlg::logs {

namespace {

bool is_unit_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || (static_cast<unsigned char>(c) & 0x80) != 0;
}

bool is_unit_digit(char c) { return c >= '0' && c <= '9'; }

// A word of the name, in small letters, and what is left behind it. Ms are no milliseconds.
std::string next_word(std::string_view& name) {
    while (!name.empty() && !is_unit_letter(name.front())) name.remove_prefix(1);
    std::string word;
    for (; !name.empty() && is_unit_letter(name.front()); name.remove_prefix(1))
        word +=
            name.starts_with("Ms") ? 'M' : static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
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

// Of the digits at from..to: more than the number of an axis.
bool is_factor(std::string_view name, std::size_t from, std::size_t to) {
    const auto is = [name](std::size_t k, bool (*what)(char)) { return k < name.size() && what(name[k]); };
    if (is(to, [](char c) { return c == '.' || c == ','; }) && is(to + 1, is_unit_digit)) return true;
    // x100 is no word that 100 numbers.
    const bool behind_x = from > 0 && (name[from - 1] == 'x' || name[from - 1] == 'X') && !is(from - 2, is_unit_letter);
    const bool numbers_word = is(from - 1, is_unit_letter) && !behind_x;
    const bool is_long = to - from > 1;
    return is(to, is_unit_letter) ? is_long || !numbers_word : is_long && !numbers_word;
}

}  // namespace

bool names_factor(std::string_view name) {
    for (const std::string_view sign : {"*", "^", "\xC3\x97", "\xC2\xB7"})
        if (name.find(sign) != std::string_view::npos) return true;
    const std::size_t bracket = std::min(name.find_first_of("[(<"), name.size());
    if (std::ranges::any_of(name.substr(bracket), is_unit_digit)) return true;
    const std::string_view head = name.substr(0, bracket);
    for (std::size_t from = 0, to = 0; from < head.size(); from = to + 1) {
        for (to = from; to < head.size() && is_unit_digit(head[to]);) ++to;
        if (to > from && is_factor(head, from, to)) return true;
    }
    return false;
}

std::optional<double> unit_of(std::string_view name) {
    std::string_view behind = name;
    (void)next_word(behind);
    if (names_factor(behind)) return std::nullopt;
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
        return next_word(behind).empty() || !units_in(column_name).empty();
    }
    return std::ranges::find(words, std::string_view{word}) != words.end();
}

}  // namespace zlg::logs
