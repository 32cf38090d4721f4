#include "time_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <vector>
#include <zlg/text/spelling.hpp>

namespace zlg::logs {

namespace {

bool is_unit_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || (static_cast<unsigned char>(c) & 0x80) != 0;
}

bool is_unit_digit(char c) { return c >= '0' && c <= '9'; }

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

// A word of the name, in small letters, and what is left behind it. Ms are no milliseconds. A capital begins a word
// behind a small letter.
std::string next_word(std::string_view& name) {
    while (!name.empty() && !is_unit_letter(name.front())) name.remove_prefix(1);
    std::string word;
    for (; !name.empty() && is_unit_letter(name.front()); name.remove_prefix(1)) {
        word += name.front();
        if (word.size() > 1 && name.size() > 1 && name[0] >= 'a' && name[0] <= 'z' && is_capital(name[1])) {
            name.remove_prefix(1);
            break;
        }
    }
    std::string small = text::small_letters(word);
    if (word.starts_with("Ms")) small.front() = 'M';
    return small;
}

// Behind the group or the message that the column is in: `t` of data.t, meas/t and header.stamp.t [s], and `t/s` of
// meas.t/s.
std::string_view last_part(std::string_view name) {
    const std::string_view head = name.substr(0, name.find_first_of("[(<"));
    const std::size_t end = head.find_last_not_of(" ./");
    if (end == std::string_view::npos) return name;
    std::size_t at = head.find_last_of("./", end);
    if (at == std::string_view::npos) return name;
    std::string_view behind = head.substr(at + 1, end - at);
    if (time_unit(next_word(behind)) && behind.empty()) at = at > 0 ? head.find_last_of("./", at - 1) : at;
    return at == std::string_view::npos ? name : name.substr(at + 1);
}

// Words of a unit, with blanks between, and how many of it make a second.
struct NamedUnit {
    std::string_view words;
    double to_a_second;
};

constexpr auto units =
    std::to_array<NamedUnit>({{" s sec secs second seconds sekunden \u0441 \u0441\u0435\u043a ", 1.0},
                              {" ms msec millis milliseconds \u043c\u0441 ", 1e3},
                              {" us usec usecs micros microseconds \xC2\xB5s \xCE\xBCs \u043c\u043a\u0441 ", 1e6},
                              {" ns nsec nsecs nanosec nanoseconds ", 1e9},
                              {" min \u043c\u0438\u043d ", 1.0 / 60.0},
                              {" h hours \u0447 ", 1.0 / 3600.0},
                              {" d days mjd jd ", 1.0 / 86400.0}});

// Words that are a name of times and their unit at once.
constexpr std::array<std::string_view, 4> names_of_units{"millis", "micros", "mjd", "jd"};

// Of the words behind the first one, how many make a second.
std::vector<double> units_in(std::string_view name) {
    std::vector<double> all;
    name = last_part(name);
    for (bool is_first = true; !name.empty(); is_first = false) {
        const std::string word = next_word(name);
        if (is_first && std::ranges::find(names_of_units, std::string_view{word}) == names_of_units.end()) continue;
        if (const auto unit = time_unit(word)) all.push_back(*unit);
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
    if (!is(to, is_unit_letter)) return is_long && !numbers_word;
    // The number of a device, as in 4F2B, has letters that are no unit.
    std::string_view behind = name.substr(to);
    const std::string word = next_word(behind);
    return is_long || (!numbers_word && (word.size() > 1 || time_unit(word)));
}

bool has_word(std::string_view column_name, std::string_view words) {
    std::string_view rest = last_part(column_name);
    while (!rest.empty())
        if (words.find(fmt::format(" {} ", next_word(rest))) != std::string_view::npos) return true;
    return false;
}

}  // namespace

std::optional<double> time_unit(std::string_view word) {
    const std::string as_listed = fmt::format(" {} ", word);
    const auto found = std::ranges::find_if(
        units, [&](const NamedUnit& unit) { return unit.words.find(as_listed) != std::string_view::npos; });
    return found == units.end() ? std::nullopt : std::optional{found->to_a_second};
}

bool names_factor(std::string_view full_name) {
    const std::string plain = without_powers(full_name);
    const std::string_view name = plain;
    for (const std::string_view sign : {"*", "^", "\xC3\x97", "\xC2\xB7", "\xC2\xB2"})
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

std::string without_powers(std::string_view name) {
    std::string plain{name};
    for (const std::string_view power : {" s^-1", "*s^-1", "\xC2\xB7s^-1", ".s^-1", " s-1", ".s-1", "\xC2\xB7s-1",
                                         " s\xE2\x81\xBB\xC2\xB9", "\xC2\xB7s\xE2\x81\xBB\xC2\xB9"})
        if (const std::size_t at = plain.find(power); at != std::string::npos) plain.replace(at, power.size(), "/s");
    return plain;
}

std::optional<double> unit_of(std::string_view name) {
    std::string_view behind = last_part(name);
    (void)next_word(behind);
    if (names_factor(behind)) return std::nullopt;
    const std::vector<double> all = units_in(name);
    return all.empty() ? std::nullopt : std::optional{all.front()};
}

bool names_two_units(std::string_view name) {
    const std::vector<double> all = units_in(name);
    return std::adjacent_find(all.begin(), all.end(), std::not_equal_to{}) != all.end();
}

bool names_time(std::string_view column_name) {
    constexpr auto words = std::to_array<std::string_view>(
        {"time", "zeit", "timestamp", "stamp", "tow", "utc", "gpstime", "epoch", "datetime", "uhrzeit", "zeitstempel",
         "millis", "micros", "mjd", "jd", "\u0432\u0440\u0435\u043c\u044f"});
    std::string_view rest = last_part(column_name);
    const std::string word = next_word(rest);
    // T is a temperature, and so is t [C].
    if (word == "t" && column_name.find('t') != std::string_view::npos) {
        std::string_view behind = rest;
        return next_word(behind).empty() || !units_in(column_name).empty();
    }
    return std::ranges::find(words, std::string_view{word}) != words.end();
}

bool mentions_time(std::string_view column_name) {
    return has_word(column_name, " time timestamp stamp zeit tow epoch unix utc elapsed micros millis mjd ");
}

bool names_statistic(std::string_view column_name) {
    return has_word(column_name, " sigma std stddev stdev sd rms var bias offset err unc uncertainty range limit ");
}

bool names_counter(std::string_view column_name) {
    return has_word(column_name,
                    " n nr no sample samples index idx seq frame count counter packet cnt sequence iteration "
                    "\u043d\u043e\u043c\u0435\u0440 ");
}

}  // namespace zlg::logs
