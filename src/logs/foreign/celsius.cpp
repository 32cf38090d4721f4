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
constexpr std::string_view of_others = " milli dc cc uc dk ck uk x10 x100 v mv volt volts adc lsb ohm ohms ";

bool lists(std::string_view words, const std::string& word) {
    return words.find(fmt::format(" {} ", word)) != std::string_view::npos;
}

// tempF, temp_degF_avg and temp [°F] have the word f: a name is parted where its letters and digits end, and where a
// capital follows two small letters; of each part what stands behind "temp" and "deg" is left, in small letters.
std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words(1);
    std::size_t n_small = 0;
    for (const char byte : name) {
        const auto c = static_cast<unsigned char>(byte);
        if (c >= 0x80) continue;  // of the sign of degrees
        if (std::isalnum(c) == 0 || (std::isupper(c) != 0 && n_small >= 2)) words.emplace_back();
        if (std::isalnum(c) != 0) words.back() += static_cast<char>(std::tolower(c));
        n_small = std::islower(c) != 0 ? n_small + 1 : 0;
    }
    for (std::string& word : words)
        for (const std::string_view before : {"temperature", "temp", "degrees", "degree", "deg"})
            if (word.starts_with(before)) word.erase(0, before.size());
    return words;
}

// [1/10 C], (0.1 C), [C x 10].
bool has_factor(std::string_view name) {
    const std::string_view brackets = name.substr(std::min(name.find_first_of("[("), name.size()));
    return brackets.find_first_of("0123456789") != brackets.npos && brackets.find_first_of("/.x*") != brackets.npos;
}

}  // namespace

std::string make_celsius(TextColumn& column) {
    const std::vector<std::string> words = words_of(column.name);
    const auto is_other = [](const std::string& word) { return lists(of_others, word); };
    if (has_factor(column.name) || std::ranges::any_of(words, is_other))
        throw MappingError(
            fmt::format("{} is in no unit of temperature that is known by its name; allowed are C, mC, "
                        "K, mK and F (none: C)",
                        described(column)));
    const auto unit = std::ranges::find_if(temperatures, [&](const TemperatureUnit& u) {
        return std::ranges::any_of(words, [&](const std::string& word) { return lists(u.words, word); });
    });
    if (unit == temperatures.end())
        return fmt::format("{} is taken in C, which its name does not say", described(column));
    if (unit == temperatures.begin()) return {};
    column.values.change([&](double value) { return value * unit->celsius + unit->zero_c; });
    return fmt::format("{} is in {} by its name, and is taken in C", described(column), unit->name);
}

}  // namespace zlg::logs
