// What a foreign file says of itself, and what must be asked.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <zlg/logs/imported.hpp>
#include <zlg/logs/row_times.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>

#include "mixed_rows.hpp"
#include "row_clock.hpp"
#include "text_table/time_names.hpp"
#include "units.hpp"

namespace zlg::logs {

namespace {

bool all_of_known(const ForeignColumn& column, bool (*holds)(double)) {
    return std::ranges::all_of(column.values, [holds](double v) { return std::isnan(v) || holds(v); });
}

bool is_constant(const ForeignColumn& column) {
    return std::adjacent_find(column.values.begin(), column.values.end(), std::not_equal_to{}) == column.values.end();
}

bool is_whole(double v) { return v == std::floor(v); }

// Of two values, as a sign or a switch has them.
bool is_state(const ForeignColumn& column) {
    return column.is_number && (all_of_known(column, [](double v) { return v == 1.0 || v == -1.0; }) ||
                                all_of_known(column, [](double v) { return v == 0.0 || v == 1.0; }));
}

std::string may_be(const ForeignColumn& column, std::int64_t times) {
    if (column.number == times) return column.holds_dates ? "the times of the rows, as dates" : "the times of the rows";
    if (column.holds_dates) return "dates";
    if (!column.is_number) return "words, not read";
    if (const auto unit = unit_in_name(column.name))
        return fmt::format("{}, {}", unit->kind == UnitKind::rate ? "a rate" : "an angle or increments", unit->name);
    const bool is_switch = all_of_known(column, [](double v) { return v >= 0.0; });
    if (is_state(column) && (is_switch || !is_constant(column)))
        return is_switch ? "loop_closed, valid or lit" : "bias_sign or mode";
    if (is_constant(column)) return "a constant";
    if (rises_as_time(column.values)) return "rises steadily: an angle, a number of rows or times; no rate";
    return all_of_known(column, is_whole) ? "whole numbers, as counts are" : "numbers";
}

// Columns of a raw log that have our names.
void take_raw_names(ForeignLook& look) {
    for (const std::string& key : raw_keys()) {
        // The first has loop_closed in its place, and the second needs a timer beside it.
        if (key == "loop_open" || key == "edge_offset_ticks") continue;
        if (look.mapping.has(key) || (key == "loop_closed" && look.mapping.has("loop_open"))) continue;
        const auto is_it = [&](const ForeignColumn& c) { return text::lower_case(c.name) == key; };
        if (std::ranges::count_if(look.table.columns, is_it) != 1) continue;
        const auto& found = *std::ranges::find_if(look.table.columns, is_it);
        refuse_words(found);
        if (!found.is_number) continue;
        look.mapping.set(key, fmt::format("{}", found.number), "names");
        look.said.push_back(fmt::format("{} is {}, by its name", key, described(found)));
    }
}

void check_raw(ForeignLook& look) {
    const Mapping& m = look.mapping;
    if (!m.has("bias_sign"))
        look.missing.push_back("bias_sign=COLUMN or alternating:1 or alternating:-1 (the first row's)");
    if (!m.has("mode")) look.missing.push_back("mode=COLUMN or always:1 or always:-1");
    if (!m.has("loop_closed") && !m.has("loop_open"))
        look.missing.push_back("loop_closed=COLUMN (or loop_open=COLUMN), or always:1 where the loop was never opened");
    if (!m.has("scale_arcsec")) look.missing.push_back("scale_arcsec=... (what a count is worth)");
    if (!m.has("tick_s") && !missing_of_clock(look.table, m).empty())
        look.missing.push_back("tick_s=... (the whole bias period, two halves)");
    if (m.has("edge_offset_ticks") && !m.has("timer_hz")) look.missing.push_back("timer_hz=... (of edge_offset_ticks)");
}

// The axis, where the file leaves no choice: the only column of a rate by its unit, or the only column of numbers.
// Returns whether its name says its unit, or that of each that it may be.
bool take_axis(ForeignLook& look, std::int64_t times) {
    std::vector<const ForeignColumn*> numbers, rates;
    bool may_be_another = false;  // an angle without a name, or what nobody can read
    for (const ForeignColumn& column : look.table.columns) {
        const bool may_be_read = column.is_number || !column.word.empty();
        if (column.is_part || column.number == times || is_constant(column) || is_state(column)) continue;
        const bool is_unread = !may_be_read && !column.holds_dates && column.words.size() >= most_words;
        const bool only_rises = rises_as_time(column.values) && look.mapping.text("holds") != "angle" &&
                                (!unit_in_name(column.name) || mentions_time(column.name));
        const bool may_be_angle = only_rises && !all_of_known(column, is_whole) && !mentions_time(column.name);
        may_be_another = may_be_another || is_unread || may_be_angle;
        if (!may_be_read || only_rises) continue;
        numbers.push_back(&column);
        if (!names_rate(column.name)) continue;
        refuse_words(column);
        rates.push_back(&column);
    }
    const ForeignColumn* only = nullptr;
    if (rates.size() == 1 && (numbers.size() == 1 || !names_statistic(rates.front()->name))) only = rates.front();
    if (rates.empty() && numbers.size() == 1 && !may_be_another) only = numbers.front();
    if (only != nullptr) {
        refuse_words(*only);
        look.mapping.set_axes({fmt::format("{}", only->number)});
        look.said.push_back(fmt::format("the axis is {}", described(*only)));
        return true;
    }
    std::string choice;
    for (const ForeignColumn* column : rates.size() < 2 ? numbers : rates)
        if (choice.size() < 200)
            choice += fmt::format("{}{}", choice.empty() ? "" : ", ",
                                  column->name.empty() ? fmt::format("{}", column->number)
                                                       : fmt::format("'{}'", text::excerpt(column->name, 40, ' ')));
    look.missing.push_back(fmt::format("axis=COLUMN{}{}", choice.empty() ? "" : ", of " + choice,
                                       rates.empty() ? " (or counts=COLUMN of a raw log)" : ""));
    return rates.size() > 1;
}

// What was said goes before the name; of what the file says all must agree.
void check_unit(ForeignLook& look, const ForeignColumn& column, std::optional<AngleUnit>& unit, bool is_later) {
    const auto refuse = [&](const std::string& why) {
        throw MappingError(
            fmt::format("{}, {}: {}; --map unit=... says which", look.table.path, described(column), why));
    };
    const auto named = unit_in_name(column.name);
    if (look.mapping.has("unit")) {
        if (named && named->name != unit->name)
            look.said.push_back(
                fmt::format("{} is read in {} as said, against its name", described(column), unit->name));
        return;
    }
    const auto before = unit_in_name(std::string_view{column.name}.substr(0, column.name.find_first_of("[(")));
    if (named && before && named->name != before->name)
        refuse(fmt::format("its name has {}, its line of units or brackets {}", before->name, named->name));
    if (is_later && (unit ? unit->name : "") != (named ? named->name : ""))
        refuse(fmt::format("its unit is {}, that of the axes before {}; allowed is one", named ? named->name : "open",
                           unit ? unit->name : "open"));
    if (!is_later) unit = named;
}

// A line of a head that says what a number is worth, as much as a message holds; empty: it says nothing. That of an
// accelerometer is of no gyro.
std::string scale_in(const std::string& line) {
    constexpr auto words =
        std::to_array<std::string_view>({"gscale", "gyroscale", "gyro_scale", "scale", "scale_factor", "scalefactor",
                                         "sensitivity", "lsb", "resolution", "skalierung", "empfindlichkeit"});
    const std::string small = text::lower_case(line);
    if (small.find_first_of("0123456789") == std::string::npos) return {};
    const auto is_letter = [&small](std::size_t at) {
        return at < small.size() && (std::isalpha(static_cast<unsigned char>(small[at])) != 0 || small[at] == '_');
    };
    for (const std::string_view word : words)
        for (std::size_t at = small.find(word); at != std::string::npos; at = small.find(word, at + 1))
            if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size()) &&
                small.substr(at < 5 ? 0 : at - 5, 5) != "full ")
                return text::excerpt(line, 60, ' ');
    return {};
}

// Where whole numbers are the axis: what may say that they are in no unit.
std::string scale_in_words(const ForeignLook& look) {
    const auto axes = look.mapping.axes();
    if (axes.empty()) return {};
    const ForeignColumn& column = column_named(look.table, axes.front());
    if (!all_of_known(column, is_whole)) return {};
    if (text::lower_case(column.name).find("lsb") != std::string::npos)
        return fmt::format("'{}' says LSB", text::excerpt(column.name, 60, ' '));
    for (const std::string& line : look.table.head)
        if (const std::string scale = scale_in(line); !scale.empty()) return fmt::format("its head has '{}'", scale);
    return {};
}

void check_axes(ForeignLook& look, std::int64_t times) {
    const bool names_say = look.mapping.has("axis") || take_axis(look, times);
    const Mapping& m = look.mapping;
    std::optional<AngleUnit> unit;
    if (m.has("unit")) unit = unit_named(m.text("unit"));
    for (const std::string& axis : m.axes()) {
        const ForeignColumn& column = column_named(look.table, axis);
        refuse_words(column);
        if (!column.is_number)
            throw MappingError(fmt::format("{}: axis = '{}': {} holds words; allowed are numbers", look.table.path,
                                           axis, described(column)));
        check_unit(look, column, unit, axis != m.axes().front());
    }
    if (!m.has("unit") && unit && !m.axes().empty()) {
        look.mapping.set("unit", std::string{unit->name}, "names");
        look.said.push_back(fmt::format("its unit is {}, by its name", unit->name));
    }
    for (const std::string& line : look.table.head)
        if (m.axes().empty() && !scale_in(line).empty())
            look.said.push_back(fmt::format("its head has '{}'", scale_in(line)));
    // Of an axis that is still to be chosen its name will say it.
    const bool is_open = m.axes().empty() && names_say;
    if (!unit && !is_open) {
        const std::string of =
            m.axes().empty() ? "" : "of " + described(column_named(look.table, m.axes().front())) + "; ";
        look.missing.push_back(
            fmt::format("unit=... ({}{}; of counts and Hz scale_arcsec=... too)", of, allowed_units()));
    }
    if (!m.has("scale") && !(unit && unit->of_counts))
        if (const std::string in = scale_in_words(look); !in.empty())
            look.missing.push_back(
                fmt::format("scale=... (what a number is multiplied by to be in its unit; {}), or "
                            "scale=1 where it stands for itself",
                            in));
    if (!m.has("scale") && m.has("unit") && !unit->of_counts && !m.axes().empty() &&
        all_of_known(column_named(look.table, m.axes().front()), is_whole))
        look.said.push_back(fmt::format(
            "its numbers are whole, and read as so many {}; --map scale=... if they are in another one", unit->name));
    if (m.has("table_rate") && !m.has("table_unit") &&
        !unit_in_name(column_named(look.table, m.text("table_rate")).name))
        look.missing.push_back("table_unit=... (of the rate table's rate)");
    if (!m.has("holds") && !is_open) {
        if (unit && unit->kind == UnitKind::rate)
            look.mapping.set("holds", "rate", "names");
        else
            look.missing.push_back("holds=rate, increment or angle");
    }
    if (unit && unit->of_counts && !m.has("scale_arcsec"))
        look.missing.push_back("scale_arcsec=... (what a count is worth)");
    if (const std::string clock = missing_of_clock(look.table, m); !clock.empty()) look.missing.push_back(clock);
}

// Keys that this kind of file does not read.
void refuse_keys_of_others(const ForeignLook& look) {
    struct Of {
        std::string_view key;
        std::array<std::string_view, 2> natures;
        std::string_view what;
    };
    constexpr std::array<std::string_view, 2> text{"text", "text"}, tree{"HDF5", "a MATLAB"},
        bag{"a ROS bag", "an MCAP"};
    constexpr auto keys = std::to_array<Of>({{"separator", text, "text"},
                                             {"decimal", text, "text"},
                                             {"comment", text, "text"},
                                             {"skip_lines", text, "text"},
                                             {"encoding", text, "text"},
                                             {"sensor", text, "text"},
                                             {"table", tree, "HDF5 and MATLAB"},
                                             {"topic", bag, "bags"}});
    for (const Of& of : keys) {
        const std::string value = look.mapping.text(of.key);
        const bool reads = std::ranges::any_of(of.natures, [&](auto n) { return look.table.nature.starts_with(n); });
        // That its rows are of one sensor can be said of any file.
        if (!look.mapping.has(of.key) || reads || (of.key == "sensor" && value == "none")) continue;
        throw MappingError(fmt::format("{}: {} = {} is of {}, and this is {}; allowed is to leave it out",
                                       look.table.path, of.key, value, of.what, look.table.nature));
    }
}

// Keys that only the other kind of import reads.
void refuse_idle_keys(const ForeignLook& look) {
    constexpr std::array<std::string_view, 4> of_raw{"tick_s", "timer_hz", "mode_plus", "bias_sign_plus"};
    constexpr std::array<std::string_view, 6> of_axes{"axis", "holds", "unit", "scale", "table_rate", "table_unit"};
    const bool is_raw = look.makes == Makes::raw;
    const std::vector<std::string> columns = look.mapping.raw_columns();
    const auto is_column = [&](const std::string& key) {
        return std::ranges::find(columns, look.mapping.text(key)) != columns.end();
    };
    for (const std::string& key : look.mapping.keys_set()) {
        const bool is_of_axes = std::ranges::find(of_axes, key) != of_axes.end();
        const bool is_of_raw = is_raw_key(key) || std::ranges::find(of_raw, key) != of_raw.end();
        const bool is_of_both =
            (key == "temperature_c" && is_column(key)) || ((key == "mode" || key == "mode_plus") && is_column("mode"));
        const bool is_idle = is_raw ? is_of_axes : is_of_raw && !is_of_both;
        if (is_idle)
            throw MappingError(
                fmt::format("{}: {} = {} is {}; allowed is {}", look.table.path, key,
                            key == "axis" ? look.mapping.axes().front() : look.mapping.text(key),
                            is_raw ? "of angles, and this one has counts" : "of raw logs, and this one has no counts",
                            is_raw               ? "to leave it out, or counts"
                            : key == "mode_plus" ? "it beside mode=COLUMN"
                                                 : "to leave it out; rows a second are rate_hz"));
    }
    if (look.mapping.has("table_unit") && !look.mapping.has("table_rate"))
        throw MappingError(fmt::format("{}: table_unit = {} is of a rate table; allowed is it beside table_rate=COLUMN",
                                       look.table.path, look.mapping.text("table_unit")));
}

}  // namespace

ForeignLook look_at_foreign(const std::string& path, const Mapping& said) {
    ForeignLook look{.table = foreign_table(path, said), .mapping = said, .said = {}, .missing = {}, .may_be = {}};
    refuse_keys_of_others(look);
    for (const ForeignColumn& column : look.table.columns)
        if (is_raw_key(text::lower_case(column.name)) && text::lower_case(column.name) == "counts" && !said.has("axis"))
            look.makes = Makes::raw;
    if (said.has("counts")) look.makes = Makes::raw;
    const std::int64_t times = time_column(look.table, said);
    for (const ForeignColumn& column : look.table.columns) look.may_be.push_back(may_be(column, times));
    if (look.makes == Makes::raw) {
        take_raw_names(look);
        check_raw(look);
    } else {
        if (const auto mixed = mixed_rows(look)) {
            // All questions come at once: what the rows of the first sensor leave open is asked as well.
            try {
                Mapping of_first = said;
                of_first.set("sensor", mixed->first, path);
                look = look_at_foreign(path, of_first);
            } catch (const std::runtime_error&) {  // the rows of the first word make no table
            }
            look.missing.insert(look.missing.begin(), mixed->second);
            return look;
        }
        check_axes(look, times);
    }
    if (std::string open = open_times(look.table, look.mapping); !open.empty())
        look.missing.insert(look.missing.begin(), std::move(open));
    if (look.missing.empty())
        for (std::string& line : unused_times(look.table, look.mapping)) look.said.push_back(std::move(line));
    return look;
}

void require_whole(const ForeignLook& look) {
    refuse_idle_keys(look);
    if (look.missing.empty()) return;
    std::string all;
    for (const std::string& one : look.missing) all += fmt::format("{}--map {}", all.empty() ? "" : "; ", one);
    throw MappingError(fmt::format("{}: is missing: {} (zlg import FILE shows its columns)", look.table.path, all));
}

}  // namespace zlg::logs
