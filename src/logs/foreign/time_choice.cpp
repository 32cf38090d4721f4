// Which column holds the times of the rows, and what must be said of it.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>
#include <zlg/text/spelling.hpp>

#include "row_clock.hpp"
#include "text_table/steps.hpp"
#include "text_table/time_names.hpp"

namespace zlg::logs {

namespace {

const ForeignColumn& column_at(const ForeignTable& table, std::int64_t number) {
    return table.columns[static_cast<std::size_t>(number - 1)];
}

// As a number of rows does, whatever it adds for each, and though it may begin anew.
bool is_numbered(const ForeignColumn& column) {
    const auto is_whole = [](double v) { return v == std::floor(v); };
    if (!column.is_number || column.is_part || !std::ranges::all_of(column.values, is_whole)) return false;
    LongColumn values = column.values;
    (void)go_on(values);
    if (values.size() < 3 || !std::is_sorted(values.begin(), values.end())) return false;
    const double usual = usual_step(values);
    std::size_t n = 0;
    for (std::size_t k = 1; k < values.size(); ++k) n += values[k] - values[k - 1] == usual ? 1u : 0u;
    return usual > 0.0 && 10 * n >= 9 * (values.size() - 1);
}

bool rises(const ForeignColumn& column) {
    if (!column.is_number || column.is_part) return false;
    return rises_as_time(column.values) || begin_of_range(column.values) > 0.0;
}

// As a column that is called time does, with holes or not, and though it may begin anew.
bool goes_on(const LongColumn& values) {
    if (values.size() < 2) return false;
    return (values.front() < values.back() && std::is_sorted(values.begin(), values.end())) ||
           begin_of_range(values) > 0.0;
}

// Numbers of rows by ones say nothing of times.
bool merely_numbers(const ForeignColumn& column) {
    return is_numbered(column) && !column.holds_dates && !unit_of(column.name) &&
           column.values[1] - column.values[0] == 1.0;
}

}  // namespace

bool is_said(const ForeignColumn& column, const ForeignTable& table, const Mapping& mapping) {
    std::vector<std::string> said = mapping.axes();
    for (std::string& one : mapping.raw_columns()) said.push_back(std::move(one));
    if (mapping.has("table_rate")) said.push_back(mapping.text("table_rate"));
    return std::ranges::any_of(said, [&](const auto& name) { return &column_named(table, name) == &column; });
}

namespace {

// Of these columns those that are not said to hold something else; all, where none is left.
std::vector<std::int64_t> free_of(const std::vector<std::int64_t>& all, const ForeignTable& table,
                                  const Mapping& mapping) {
    std::vector<std::int64_t> free;
    std::copy_if(all.begin(), all.end(), std::back_inserter(free),
                 [&](std::int64_t n) { return !is_said(column_at(table, n), table, mapping); });
    return free.empty() ? all : free;
}

TextColumn times_in(const ForeignColumn& column) {
    TextColumn times{.number = column.number, .name = column.name, .values = column.values};
    times.holds_dates = column.holds_dates;
    (void)go_on(times.values);
    return times;
}

// Both say one rate, as far as they say their units: a unit that is open, and not said, may be any of s, ms, us, ns.
bool agree(const ForeignColumn& a, const ForeignColumn& b, const ForeignTable& table, const Mapping& mapping) {
    const auto times_a = row_times(times_in(a), table.path, false), times_b = row_times(times_in(b), table.path, false);
    if (!times_a || !times_b) return true;
    const auto unit = [&mapping](const ForeignColumn& column) {
        if (column.holds_dates) return std::optional{1.0};
        if (mapping.has("time_unit")) return time_unit(mapping.text("time_unit"));
        return unit_of(column.name);
    };
    const auto unit_a = unit(a), unit_b = unit(b);
    double ratio = times_a->step / times_b->step * unit_b.value_or(1.0) / unit_a.value_or(1.0);
    if (!unit_a || !unit_b) ratio /= std::pow(1e3, std::round(std::log10(ratio) / 3.0));
    return std::fabs(ratio - 1.0) <= times_a->tolerance + times_b->tolerance;
}

// The first one that is named so, and those that contradict it.
std::vector<std::int64_t> named_times(const ForeignTable& table, const Mapping& mapping,
                                      bool (*is_name)(std::string_view)) {
    std::vector<std::int64_t> named;
    for (const ForeignColumn& column : table.columns) {
        if (column.is_part || !is_name(column.name) || !(column.holds_dates || goes_on(column.values))) continue;
        if (named.empty() || !agree(column_at(table, named.front()), column, table, mapping))
            named.push_back(column.number);
    }
    return named;
}

std::string rate_of(const ForeignTable& table, std::int64_t number) {
    const TextColumn times = times_in(column_at(table, number));
    return rate_in_words(times, row_times(times, table.path, false).value());
}

// By what is said, by names, by dates: the first that decides. More than one: it is open which.
std::vector<std::int64_t> time_columns(const ForeignTable& table, const Mapping& mapping) {
    if (mapping.has("time")) {
        const std::string name = mapping.text("time");
        if (name == "none" || name == "0") return {};
        return {column_named(table, name).number};
    }
    for (const auto is_name : {names_time, mentions_time})
        if (std::vector<std::int64_t> named = named_times(table, mapping, is_name); !named.empty())
            return free_of(named, table, mapping);
    std::vector<std::int64_t> dates, nameless;
    for (const ForeignColumn& column : table.columns) {
        if (column.holds_dates) dates.push_back(column.number);
        if (column.name.empty() && rises(column)) nameless.push_back(column.number);
    }
    if (!dates.empty()) return free_of(dates, table, mapping);
    if (!nameless.empty()) return free_of(nameless, table, mapping);
    // Numbers of rows show those that are missing, and no rate.
    if (!mapping.has("rate_hz") && (!mapping.has("tick_s") || mapping.has("half"))) return {};
    for (const bool by_name : {true, false})
        for (const ForeignColumn& column : table.columns)
            if (is_numbered(column) && names_counter(column.name) == by_name &&
                (by_name || mapping.text("holds") != "angle") && !is_said(column, table, mapping))
                return {column.number};
    return {};
}

}  // namespace

// How many of the column's unit make a second; empty: nobody says it.
std::optional<double> known_time_unit(const std::string& path, const std::string& name, bool holds_dates,
                                      const Mapping& mapping) {
    if (holds_dates) return 1.0;
    if (mapping.has("time_unit")) return time_unit(mapping.text("time_unit"));
    if (names_two_units(name))
        throw MappingError(
            fmt::format("{}: '{}' names two units of times; --map time_unit=... says which", path, name));
    return unit_of(name);
}

std::int64_t time_column(const ForeignTable& table, const Mapping& mapping) {
    const std::vector<std::int64_t> all = time_columns(table, mapping);
    return all.size() == 1 ? all.front() : 0;
}

std::string open_times(const ForeignTable& table, const Mapping& mapping) {
    const std::vector<std::int64_t> all = time_columns(table, mapping);
    if (all.size() < 2) return {};
    constexpr std::size_t most_named = 20;
    const auto named = std::span{all}.first(std::min(all.size(), most_named));
    const char* more = all.size() > most_named ? " and more" : "";
    if (names_time(column_at(table, all[0]).name))
        return fmt::format("time={} ({}; {})", fmt::join(named, "|"), rate_of(table, all[0]), rate_of(table, all[1]));
    return fmt::format("time={} or none (columns {}{} rise as times do, and no name says which)", fmt::join(named, "|"),
                       fmt::join(named, ", "), more);
}

std::vector<std::string> unused_times(const ForeignTable& table, const Mapping& mapping) {
    const bool is_none = mapping.text("time") == "none";
    if ((mapping.has("time") && !is_none) || mapping.has("half")) return {};
    const std::int64_t times = time_column(table, mapping);
    std::vector<std::string> notes;
    for (const ForeignColumn& column : table.columns) {
        if (column.number == times || column.values.size() < 2 || is_said(column, table, mapping)) continue;
        const bool is_named = names_time(column.name);
        if (times == 0 && is_named && !is_none && (column.is_number || !column.word.empty()))
            throw MappingError(
                fmt::format("{}, {}: is named as times are, and does not rise; --map time=none leaves it out",
                            table.path, described(column)));
        // Another column of times was held against the first where both are named.
        const bool holds_words =
            times == 0 && !is_none && (is_named || mentions_time(column.name)) && !column.is_number;
        const bool is_left = times == 0 || merely_numbers(column_at(table, times));
        // A date (datum) beside the time of the day.
        if (times != 0 && !column.is_number && text::lower_case(column.name).starts_with("dat")) {
            notes.push_back(
                fmt::format("{}: holds dates, and is not used: days that are missing are not seen", described(column)));
            continue;
        }
        if (holds_words)
            notes.push_back(fmt::format("{}: is named as times are, and '{}' is none that is known", described(column),
                                        column.first));
        else if (is_left && rises(column))
            notes.push_back(
                fmt::format("{}: rises as times and counters do, and is not used; --map time={} if it shows "
                            "rows that are missing",
                            described(column), column.number));
    }
    return notes;
}

std::string missing_of_clock(const ForeignTable& table, const Mapping& mapping) {
    if (mapping.has("rate_hz")) return {};
    if (const auto open = time_columns(table, mapping); open.size() > 1) {
        const auto says_unit = [&](std::int64_t n) {
            const ForeignColumn& column = column_at(table, n);
            return column.holds_dates || unit_of(column.name);
        };
        if (mapping.has("time_unit") || std::ranges::all_of(open, says_unit)) return {};
        return "time_unit=s, ms, us or ns (of these times)";
    }
    const std::int64_t number = time_column(table, mapping);
    if (number == 0) return "rate_hz=... (rows a second; no column of times was recognised, or time=COLUMN)";
    const ForeignColumn& column = column_at(table, number);
    const bool may_count = merely_numbers(column);
    if (may_count && column.name.empty() && !mapping.has("time"))
        return fmt::format(
            "time={0} if {1} holds the times and does not merely number the rows, time=COLUMN if "
            "another does, or rate_hz=... (rows a second)",
            number, described(column));
    if (known_time_unit(table.path, column.name, column.holds_dates, mapping)) return {};
    if (may_count)
        return fmt::format("rate_hz=... (rows a second; {} merely numbers them), or time_unit=s, ms, us, ns",
                           described(column));
    const auto found = row_times(times_in(column), table.path, false);
    constexpr const char* else_rate = "or rate_hz=... (rows a second), with time=none where it holds no times";
    if (!found) return fmt::format("time_unit=s, ms, us or ns (of {}), {}", described(column), else_rate);
    return fmt::format("time_unit=s (then {:.6g} Hz), ms ({:.6g} Hz), us or ns, of {}, {}", 1.0 / found->step,
                       1e3 / found->step, described(column), else_rate);
}

}  // namespace zlg::logs
