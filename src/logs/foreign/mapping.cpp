#include <zlg/logs/mapping.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>
#include <zlg/text/toml_document.hpp>
#include <zlg/text/toml_text.hpp>
#include <zlg/text/whole_file.hpp>

#include "units.hpp"

namespace zlg::logs {

namespace {

enum class Takes { word, column, columns, positive, whole, real, raw_column };

struct Key {
    std::string_view name;
    Takes takes;
    std::string_view allowed;  // the words themselves where `takes` is word and they are listed with |
    std::string_view meaning;
};

constexpr auto keys = std::to_array<Key>({
    {"separator", Takes::word, "tab|semicolon|bar|comma|space", "what parts the columns of a text file"},
    {"decimal", Takes::word, "point|comma", "the decimal mark of a text file"},
    {"comment", Takes::word, "", "how lines of a text file begin that are skipped; # where it is not set"},
    {"skip_lines", Takes::whole, "a whole number from 0", "lines of a text file above the names of the columns"},
    {"encoding", Takes::word, "utf-8|latin-1|windows-1251", "of the letters of a text file"},
    {"sensor", Takes::word, "",
     "the word that stands in the rows of one sensor, where several stand by turns; none: they are of one"},
    {"table", Takes::word, "", "group or data set of HDF5, variable of MATLAB"},
    {"topic", Takes::word, "", "the sensor of a bag that holds several"},
    {"time", Takes::column, "a column, or none", "the times of the rows"},
    {"time_unit", Takes::word, "s|ms|us|ns|min|h|d", "the unit of these times"},
    {"rate_hz", Takes::positive, "a number above 0", "rows a second, where no column of times says it"},
    {"tick_s", Takes::positive, "a number above 0", "the whole bias period of a raw log, two halves"},
    {"scale_arcsec", Takes::positive, "a number above 0", "what a count is worth"},
    {"axis", Takes::columns, "a column, or a list of them", "the angle or the rate of an axis"},
    {"holds", Takes::word, "rate|increment|angle", "what the axis holds"},
    {"unit", Takes::word, "", "the unit of the axis"},
    {"scale", Takes::real, "a number", "what the axis is multiplied by to be in that unit"},
    {"table_rate", Takes::column, "", "the rate of a rate table that turned the gyro"},
    {"table_unit", Takes::word, "", "its unit, where its name does not say it"},
    {"missing", Takes::real, "a number", "the value that stands for a missing one, such as -9999"},
    {"half", Takes::raw_column, "", "the number of the half"},
    {"bias_sign", Takes::raw_column, "", "the sign of the bias field"},
    {"bias_sign_plus", Takes::real, "a number", "the value in that column which stands for +1"},
    {"mode", Takes::raw_column, "", "the helicity"},
    {"mode_plus", Takes::real, "a number", "the value in that column which stands for +1"},
    {"counts", Takes::raw_column, "", "fringes counted in the row"},
    {"loop_closed", Takes::raw_column, "", "1 while the perimeter loop is closed"},
    {"loop_open", Takes::raw_column, "", "1 while it is open, in place of loop_closed"},
    {"valid", Takes::raw_column, "", "0 where the counts cannot be trusted"},
    {"detuning_lambda", Takes::raw_column, "", "as in docs/logs.md"},
    {"detuning_sq_lambda2", Takes::raw_column, "", "as in docs/logs.md"},
    {"piezo_v", Takes::raw_column, "", "as in docs/logs.md"},
    {"temperature_c", Takes::raw_column, "", "as in docs/logs.md"},
    {"fringe", Takes::raw_column, "", "as in docs/logs.md"},
    {"span", Takes::raw_column, "", "as in docs/logs.md"},
    {"lit", Takes::raw_column, "", "as in docs/logs.md"},
    {"edge_offset_ticks", Takes::raw_column, "", "as in docs/logs.md"},
    {"timer_hz", Takes::positive, "a number above 0", "ticks a second of the timer of edge_offset_ticks"},
});

std::string allowed_of(const Key& key) {
    if (key.name == "unit" || key.name == "table_unit") return allowed_units();
    if (key.takes == Takes::raw_column) return "a column, or always:VALUE, or alternating:VALUE";
    return std::string{key.allowed};
}

const Key& key_of(const std::string& name, const std::string& where) {
    const auto found = std::ranges::find(keys, std::string_view{name}, &Key::name);
    if (found != keys.end()) return *found;
    const auto nearest = std::min_element(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
        return text::letters_apart(name, a.name) < text::letters_apart(name, b.name);
    });
    throw MappingError(fmt::format("{}: unknown key '{}'; did you mean '{}'? (zlg import --keys lists all)", where,
                                   text::excerpt(name, 60, ' '), nearest->name));
}

std::optional<double> number_in(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

bool is_listed(std::string_view allowed, std::string_view value) {
    if (value.empty() || value.find('|') != std::string_view::npos) return false;
    return fmt::format("|{}|", allowed).find(fmt::format("|{}|", value)) != std::string::npos;
}

// Stands for a column that there is not.
bool is_fixed(std::string_view value) { return value.starts_with("always:") || value.starts_with("alternating:"); }

bool takes(const Key& key, const std::string& value) {
    const auto number = number_in(value);
    switch (key.takes) {
        case Takes::word:
            if (key.name == "unit" || key.name == "table_unit") return unit_named(value).has_value();
            return key.allowed.empty() ? !value.empty() || key.name == "comment" : is_listed(key.allowed, value);
        case Takes::positive: return number && *number > 0.0;
        case Takes::whole: return number && *number >= 0.0 && *number == std::floor(*number) && *number <= 1e6;
        case Takes::real: return number.has_value();
        case Takes::column:
        case Takes::columns:
        case Takes::raw_column: break;
    }
    if (key.takes == Takes::raw_column && is_fixed(value)) return fixed_value(value).has_value();
    return !value.empty();
}

[[noreturn]] void refuse_value(const std::string& where, const Key& key, const std::string& value) {
    throw MappingError(
        fmt::format("{}: {} = '{}'; allowed is {}", where, key.name, text::excerpt(value, 60, ' '), allowed_of(key)));
}

std::string text_of(const toml::node& value) {
    if (const auto text = value.value_exact<std::string>()) return *text;
    if (const auto whole = value.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
    if (const auto real = value.value_exact<double>()) return fmt::format("{}", *real);
    return {};
}

// A text, a number, or for the axes a list of those.
void set_from(Mapping& mapping, const std::string& key, const toml::node& value, const std::string& where) {
    if (key == "axis" && value.is_array()) {
        std::vector<std::string> axes;
        for (const toml::node& each : *value.as_array()) axes.push_back(text_of(each));
        const bool good = !axes.empty() && !std::ranges::any_of(axes, &std::string::empty);
        if (!good) refuse_value(where, key_of(key, where), "[...]");
        mapping.set_axes(std::move(axes));
        return;
    }
    const bool is_plain = value.is_string() || value.is_integer() || value.is_floating_point();
    if (!is_plain) refuse_value(where, key_of(key, where), "a value of another type");
    mapping.set(key, text_of(value), where);
}

}  // namespace

void Mapping::set(const std::string& name, const std::string& value, const std::string& where) {
    const Key& key = key_of(name, where);
    if (!takes(key, value)) refuse_value(where, key, value);
    if (key.takes == Takes::columns)
        axes_ = {value};
    else
        values_.insert_or_assign(name, value);
}

bool Mapping::has(std::string_view key) const { return key == "axis" ? !axes_.empty() : values_.contains(key); }

std::string Mapping::text(std::string_view key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::string{} : found->second;
}

std::optional<double> Mapping::real(std::string_view key) const { return number_in(text(key)); }

std::vector<std::string> Mapping::keys_set() const {
    std::vector<std::string> all;
    if (!axes_.empty()) all.emplace_back("axis");
    for (const auto& [key, value] : values_) all.push_back(key);
    return all;
}

std::vector<std::string> Mapping::raw_columns() const {
    std::vector<std::string> columns;
    for (const auto& [key, value] : values_)
        if (is_raw_key(key) && !is_fixed(value)) columns.push_back(value);
    return columns;
}

std::string Mapping::toml() const {
    std::string lines;
    for (const Key& key : keys) {
        if (!has(key.name)) continue;
        std::string value;
        if (key.name == "axis") {
            for (const std::string& axis : axes_)
                value += fmt::format("{}{}", value.empty() ? "" : ", ", text::toml_string(axis));
            value = fmt::format("[{}]", value);
        } else {
            const bool is_number =
                key.takes == Takes::positive || key.takes == Takes::whole || key.takes == Takes::real;
            value = is_number ? text(key.name) : text::toml_string(text(key.name));
        }
        lines += fmt::format("{} = {}  # {}\n", key.name, value, key.meaning);
    }
    return lines;
}

void apply_mapping_file(Mapping& mapping, const std::string& path) {
    try {
        const toml::table table = text::parse_toml(text::read_whole(path));
        for (const auto& [key, value] : table) set_from(mapping, std::string{key.str()}, value, path);
    } catch (const toml::parse_error& error) {
        throw MappingError(fmt::format("{}:{}: {}; allowed is TOML", path, error.source().begin.line,
                                       std::string{error.description()}));
    } catch (const text::CannotRead& error) {
        throw IoError(fmt::format("cannot read {}: {}", path, error.what()));
    } catch (const text::TooLong& error) {
        throw MappingError(error.what());
    }
}

void apply_mapping_pair(Mapping& mapping, const std::string& pair) {
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0)
        throw MappingError(fmt::format("--map {}: allowed is key=value", text::excerpt(pair, 60, ' ')));
    const std::string key = pair.substr(0, equals), value = pair.substr(equals + 1);
    if (key == "axis" && value.starts_with('[')) {
        try {
            const toml::table table = text::parse_toml("axis = " + value);
            set_from(mapping, key, *table.get("axis"), "--map");
            return;
        } catch (const toml::parse_error&) {
            // A name that begins so.
        }
    }
    mapping.set(key, value, "--map");
}

std::string mapping_keys_text() {
    std::string lines;
    for (const Key& key : keys) {
        const std::string allowed = allowed_of(key);
        lines += fmt::format("{:<20} {}{}\n", key.name, key.meaning,
                             allowed.empty() ? std::string{} : fmt::format(" ({})", allowed));
    }
    return lines;
}

std::vector<std::string> raw_keys() {
    std::vector<std::string> names;
    for (const Key& key : keys)
        if (key.takes == Takes::raw_column) names.emplace_back(key.name);
    return names;
}

std::optional<double> fixed_value(std::string_view said) {
    return is_fixed(said) ? number_in(said.substr(said.find(':') + 1)) : std::nullopt;
}

bool is_raw_key(std::string_view name) {
    const auto found = std::ranges::find(keys, name, &Key::name);
    return found != keys.end() && found->takes == Takes::raw_column;
}

}  // namespace zlg::logs
