#include "units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>
#include <vector>
#include <zlg/text/spelling.hpp>

#include "text_table/time_names.hpp"

namespace zlg::logs {

namespace {

constexpr double deg = 3600.0;
constexpr double rad = deg * 180.0 / std::numbers::pi;

constexpr std::array<AngleUnit, 21> units{
    {{"deg/s", UnitKind::rate, deg},        {"deg/min", UnitKind::rate, deg / 60.0},
     {"deg/h", UnitKind::rate, 1.0},        {"mdeg/s", UnitKind::rate, deg / 1e3},
     {"rad/s", UnitKind::rate, rad},        {"mrad/s", UnitKind::rate, rad / 1e3},
     {"urad/s", UnitKind::rate, rad / 1e6}, {"nrad/s", UnitKind::rate, rad / 1e9},
     {"arcsec/s", UnitKind::rate, 1.0},     {"counts/s", UnitKind::rate, 1.0, true},
     {"Hz", UnitKind::rate, 1.0, true},     {"deg", UnitKind::angle, deg},
     {"mdeg", UnitKind::angle, deg / 1e3},  {"rad", UnitKind::angle, rad},
     {"mrad", UnitKind::angle, rad / 1e3},  {"urad", UnitKind::angle, rad / 1e6},
     {"arcmin", UnitKind::angle, 60.0},     {"arcsec", UnitKind::angle, 1.0},
     {"marcsec", UnitKind::angle, 1e-3},    {"turns", UnitKind::angle, 360.0 * deg},
     {"counts", UnitKind::angle, 1.0, true}}};

void replace(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

// One spelling of each word.
std::string usual_spelling(std::string_view word) {
    std::string text = without_powers(word);
    replace(text, " per ", "/");
    std::erase(text, ' ');
    if (text.size() > 1 && text[0] == 'M' && text[1] >= 'a') return text;
    text = text::small_letters(text);
    // Each word of the second is spelt as the first, in this order.
    constexpr auto spellings = std::to_array<std::pair<std::string_view, std::string_view>>(
        {{"deg", "\xC2\xB0 \xC2\xBA \u0433\u0440\u0430\u0434 degrees degree"},
         {"deg/", "grad/"},
         {"u", "\xC2\xB5 \xCE\xBC"},
         {"", "\xC2\xB7"},
         {"arcsec",
          "\u0443\u0433\u043b.\u0441\u0435\u043a \u0443\u0433\u043b.\u0441 arcseconds arc-sec bogensekunden \" '' "
          "\xE2\x80\xB3"},
         {"mrad", "\u043c\u0440\u0430\u0434"},
         {"rad", "\u0440\u0430\u0434 radians"},
         {"/", "_"},
         {"/s", "/\u0441\u0435\u043a /\u0441 /seconds /second /sec"},
         {"/h", "/\u0447\u0430\u0441 /\u0447 /hour /hr /std"},
         {"/min", "/\u043c\u0438\u043d /minute"},
         {"counts", "pulses"}});
    for (auto [to, words] : spellings)
        for (std::size_t end = 0; !words.empty(); words.remove_prefix(std::min(end + 1, words.size()))) {
            end = std::min(words.find(' '), words.size());
            replace(text, words.substr(0, end), to);
        }
    if (text == "dps") return "deg/s";
    if (text == "dph") return "deg/h";
    if (text == "mdps") return "mdeg/s";
    if (text == "asec") return "arcsec";
    if (text == "count") return "counts";
    if (text == "hz") return "Hz";
    return text;
}

// 10 deg/s, deg/s*10, 1e-3 deg/s and Mdeg/s become deg/s.
std::string without_factor(std::string_view text) {
    std::string unit{text};
    std::erase_if(unit, [](char c) { return std::string_view{"0123456789.,*^+- "}.find(c) != std::string_view::npos; });
    const std::size_t begin = unit.find_first_not_of("eExX/_M");
    if (begin == std::string::npos) return {};
    return unit.substr(begin, unit.find_last_not_of("eExX/_") + 1 - begin);
}

// The parts of a column's name that may be its unit, the likeliest first: in brackets, or behind the last underscores.
std::vector<std::string_view> unit_places(std::string_view name) {
    std::vector<std::string_view> places;
    std::size_t open = name.find_first_of("[(");
    const bool has_brackets = open != std::string_view::npos;
    for (; open != std::string_view::npos; open = name.find_first_of("[(", open + 1)) {
        const std::size_t close = name.find_first_of("])", open);
        if (close == std::string_view::npos) break;
        places.push_back(name.substr(open + 1, close - open - 1));
    }
    if (has_brackets) return places;
    // rate_deg_s before rate_s; a name that is nothing but a unit says nothing of a quantity.
    for (std::size_t at = name.find_first_of("_ "); at != std::string_view::npos; at = name.find_first_of("_ ", at + 1))
        places.push_back(name.substr(at + 1));
    if (places.size() > 2) places.erase(places.begin(), places.end() - 2);
    return places;
}

template <class Reads> std::optional<AngleUnit> first_unit(std::string_view name, const Reads& reads) {
    for (const std::string_view place : unit_places(name))
        if (const auto unit = reads(place)) return unit;
    return std::nullopt;
}

}  // namespace

std::optional<AngleUnit> unit_named(std::string_view word) {
    const std::string usual = usual_spelling(word);
    const auto found = std::ranges::find(units, std::string_view{usual}, &AngleUnit::name);
    if (found == units.end()) return std::nullopt;
    return *found;
}

std::optional<AngleUnit> unit_in_name(std::string_view name) {
    if (names_factor(name)) return std::nullopt;
    const auto unit = first_unit(name, unit_named);
    return unit && unit->name == "Hz" ? std::nullopt : unit;
}

bool names_rate(std::string_view name) {
    const auto unit = first_unit(name, [](std::string_view text) { return unit_named(without_factor(text)); });
    return unit && unit->kind == UnitKind::rate && unit->name != "Hz";
}

std::string allowed_units() {
    std::string all;
    for (const AngleUnit& unit : units) all += fmt::format("{}{}", all.empty() ? "" : ", ", unit.name);
    return all;
}

}  // namespace zlg::logs
