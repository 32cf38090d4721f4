#include "celsius.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>
#include <zlg/logs/mapping.hpp>

namespace zlg::logs {

namespace {

struct TemperatureUnit {
    std::string_view name;
    std::string_view words;  // in small letters, each between blanks
    double celsius = 1.0;    // of one
    double zero_c = 0.0;
};

constexpr std::array<TemperatureUnit, 5> temperatures{{{"C", " c celsius centigrade "},
                                                       {"mC", " mc millicelsius ", 1e-3},
                                                       {"K", " k kelvin kelvins ", 1.0, -273.15},
                                                       {"mK", " mk millikelvin ", 1e-3, -273.15},
                                                       {"F", " f fahr fahrenheit ", 5.0 / 9.0, -160.0 / 9.0}}};

// Words of a factor, and of what is no temperature yet.
constexpr std::string_view of_others = " milli dc cc uc dk ck uk x10 x100 v mv volt volts adc lsb ohm ohms kohm ";

bool lists(std::string_view words, const std::string& word) {
    return words.find(fmt::format(" {} ", word)) != std::string_view::npos;
}

// tempF, temp_degF_avg and temp [°F] have the word f: a name is parted where its letters and digits end, and where a
// capital follows two small letters; of each part what stands behind "temp" and "deg" is left, in small letters.
std::vector<std::string> words_of(std::string name) {
    for (const std::string_view sign : {"\xC2\xB0", "\xC2\xBA"})
        for (std::size_t at = name.find(sign); at != std::string::npos; at = name.find(sign))
            name.erase(at, sign.size());
    std::vector<std::string> words(1);
    std::size_t n_small = 0;
    for (const char byte : name) {
        const auto c = static_cast<unsigned char>(byte);
        const bool is_part = std::isalnum(c) != 0 || c >= 0x80;
        if (!is_part || (std::isupper(c) != 0 && n_small >= 2)) words.emplace_back();
        if (is_part) words.back() += static_cast<char>(std::tolower(c));
        n_small = std::islower(c) != 0 ? n_small + 1 : 0;
    }
    for (std::string& word : words)
        for (const std::string_view before : {"temperature", "temp", "degrees", "degree", "deg"})
            if (word.starts_with(before)) word.erase(0, before.size());
    return words;
}

auto unit_in(const std::vector<std::string>& words) {
    return std::ranges::find_if(temperatures, [&](const TemperatureUnit& unit) {
        return std::ranges::any_of(words, [&](const std::string& word) { return lists(unit.words, word); });
    });
}

}  // namespace

std::string make_celsius(TextColumn& column) {
    const std::size_t open = std::min(column.name.find_first_of("[("), column.name.size());
    const std::vector<std::string> all = words_of(column.name);
    const auto words = words_of(column.name.substr(open, column.name.find_first_of("])", open) - open));
    const auto is_other = [](const std::string& word) { return lists(of_others, word); };
    // [1/10 C], (0.1 C), [C x 10].
    const auto is_factor = [](const std::string& word) { return !word.empty() && std::isdigit(word.front()) != 0; };
    const bool in_brackets = unit_in(words) != temperatures.end();
    if (std::ranges::any_of(words, is_other) || (in_brackets && std::ranges::any_of(words, is_factor)) ||
        is_other(all.back()))
        throw MappingError(
            fmt::format("{}: no temperature by its name; allowed are C, mC, K, mK and F (none: C)", described(column)));
    const auto unit = unit_in(in_brackets ? words : all);
    if (unit == temperatures.end())
        return fmt::format("{} is taken in C, which its name does not say", described(column));
    if (unit == temperatures.begin()) return {};
    column.values.change([&](double value) { return value * unit->celsius + unit->zero_c; });
    return fmt::format("{} is in {} by its name, and is taken in C", described(column), unit->name);
}

}  // namespace zlg::logs
