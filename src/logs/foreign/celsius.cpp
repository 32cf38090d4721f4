#include "celsius.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>
#include <zlg/text/spelling.hpp>

#include "units.hpp"

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
                                                       {"F", " f fahrenheit ", 5.0 / 9.0, -160.0 / 9.0}}};

// deg F, degrees_F and °F as f.
std::string spelt_as_temperature(std::string_view word) {
    std::string text = text::small_letters(word);
    for (const std::string_view degrees : {"degrees", "degree", "deg", "\xC2\xB0", "\xC2\xBA", " ", "_", "."})
        for (std::size_t at = text.find(degrees); at != std::string::npos; at = text.find(degrees))
            text.erase(at, degrees.size());
    return text;
}

// Where the name has brackets its unit is in them, else behind the last stroke, point, underscore or blank.
std::vector<std::string_view> places(std::string_view name) {
    std::vector<std::string_view> all = unit_places(name);
    if (name.find_first_of("[(") == std::string_view::npos)
        for (const char mark : {'/', '.'})
            if (const std::size_t at = name.rfind(mark); at != std::string_view::npos)
                all.push_back(name.substr(at + 1));
    return all;
}

// That of degrees Celsius where the name has none.
TemperatureUnit temperature_unit_of(std::string_view name) {
    for (const std::string_view place : places(name))
        for (const TemperatureUnit& unit : temperatures)
            if (unit.words.find(fmt::format(" {} ", spelt_as_temperature(place))) != std::string_view::npos)
                return unit;
    return temperatures.front();
}

}  // namespace

std::string make_celsius(TextColumn& column) {
    const TemperatureUnit unit = temperature_unit_of(column.name);
    if (unit.name == temperatures.front().name) return {};
    column.values.change([&](double value) { return value * unit.celsius + unit.zero_c; });
    return fmt::format("{} is in {} by its name, and is taken in C", described(column), unit.name);
}

}  // namespace zlg::logs
