#include "celsius.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <zlg/text/spelling.hpp>

#include "units.hpp"

namespace zlg::logs {

namespace {

struct TemperatureUnit {
    std::string_view words;  // in small letters, each between blanks
    std::string_view name;
    double celsius = 1.0;  // of one
    double zero_c = 0.0;
};

constexpr std::array<TemperatureUnit, 4> units{{{" c degc celsius \xC2\xB0"
                                                 "c ",
                                                 "C"},
                                                {" mc mdegc millicelsius m\xC2\xB0"
                                                 "c ",
                                                 "mC", 1e-3},
                                                {" k kelvin ", "K", 1.0, -273.15},
                                                {" f degf fahrenheit \xC2\xB0"
                                                 "f ",
                                                 "F", 5.0 / 9.0, -160.0 / 9.0}}};

// That of degrees Celsius where the name has none.
TemperatureUnit unit_of(std::string_view name) {
    for (const std::string_view place : unit_places(name))
        for (const TemperatureUnit& unit : units)
            if (unit.words.find(fmt::format(" {} ", text::small_letters(place))) != std::string_view::npos) return unit;
    return units.front();
}

}  // namespace

std::string make_celsius(TextColumn& column) {
    const TemperatureUnit unit = unit_of(column.name);
    if (unit.name == units.front().name) return {};
    column.values.change([&](double value) { return value * unit.celsius + unit.zero_c; });
    return fmt::format("{} is in {} by its name, and is taken in C", described(column), unit.name);
}

}  // namespace zlg::logs
