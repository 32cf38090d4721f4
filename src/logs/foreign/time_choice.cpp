// Which column holds the times of the rows, and what must be said of it.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <zlg/text/spelling.hpp>

#include "row_clock.hpp"
#include "text_table/time_names.hpp"

namespace zlg::logs {

namespace {

const std::map<std::string, double> to_a_second{{"s", 1.0},  {"ms", 1e3},         {"us", 1e6},
                                                {"ns", 1e9}, {"min", 1.0 / 60.0}, {"h", 1.0 / 3600.0}};

bool is_numbered(std::span<const double> values) {
    return values.size() > 2 && values[1] - values[0] == 1.0 &&
           std::ranges::all_of(values, [](double v) { return v == std::floor(v); });
}

bool names_row_numbers(const std::string& name) {
    constexpr std::array<std::string_view, 12> words{"n",   "nr",  "no",    "sample",    "sample_no", "index",
                                                     "idx", "seq", "frame", "sample_nr", "counter",   "packet"};
    return std::ranges::find(words, text::lower_case(name)) != words.end();
}

// As a column that is called time does, with holes or not.
bool goes_on(std::span<const double> values) {
    return values.size() > 1 && values.front() < values.back() && std::ranges::is_sorted(values);
}

// Of these columns those that are not said to hold something else; all, where none is left.
std::vector<std::int64_t> free_of(const std::vector<std::int64_t>& all, const ForeignTable& table,
                                  const Mapping& mapping) {
    std::set<std::int64_t> used;
    for (const std::string& name : mapping.axes()) used.insert(column_named(table, name).number);
    for (const std::string& name : mapping.raw_columns()) used.insert(column_named(table, name).number);
    std::vector<std::int64_t> free;
    std::ranges::copy_if(all, std::back_inserter(free), [&used](std::int64_t n) { return !used.contains(n); });
    return free.empty() ? all : free;
}

// By what is said, by names, by dates: the first that decides. More than one: it is open which.
std::vector<std::int64_t> time_columns(const ForeignTable& table, const Mapping& mapping) {
    if (mapping.has("time")) {
        const std::string name = mapping.text("time");
        if (name == "none" || name == "0") return {};
        return {column_named(table, name).number};
    }
    for (const ForeignColumn& column : table.columns)
        if (names_time(column.name) && (column.holds_dates || goes_on(column.values))) return {column.number};
    std::vector<std::int64_t> dates, nameless;
    for (const ForeignColumn& column : table.columns) {
        if (column.holds_dates) dates.push_back(column.number);
        if (column.name.empty() && column.is_number && rises_as_time(column.values)) nameless.push_back(column.number);
    }
    if (!dates.empty()) return free_of(dates, table, mapping);
    if (!nameless.empty()) return free_of(nameless, table, mapping);
    // Numbers of rows show those that are missing, and no rate.
    if (mapping.has("rate_hz"))
        for (const ForeignColumn& column : table.columns)
            if (names_row_numbers(column.name) && is_numbered(column.values) && goes_on(column.values))
                return {column.number};
    return {};
}

}  // namespace

// How many of the column's unit make a second; empty: nobody says it.
std::optional<double> known_time_unit(const std::string& path, const std::string& name, bool holds_dates,
                                      const Mapping& mapping) {
    if (holds_dates) return 1.0;
    if (mapping.has("time_unit")) return to_a_second.at(mapping.text("time_unit"));
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
    return fmt::format("time={} or none (columns {}{} rise as times do, and no name says which)", fmt::join(named, "|"),
                       fmt::join(named, ", "), more);
}

void refuse_unused_times(const ForeignTable& table, const Mapping& mapping) {
    if (mapping.has("time") || mapping.has("half") || !time_columns(table, mapping).empty()) return;
    for (const ForeignColumn& column : table.columns)
        if (names_time(column.name) && column.is_number && column.values.size() > 1)
            throw MappingError(
                fmt::format("{}, {}: is named as times are, and does not rise; --map time=none leaves it out",
                            table.path, described(column)));
}

std::string missing_of_clock(const ForeignTable& table, const Mapping& mapping) {
    if (mapping.has("rate_hz") || !open_times(table, mapping).empty()) return {};
    const std::int64_t number = time_column(table, mapping);
    if (number == 0) return "rate_hz=... (rows a second; no column of times was recognised, or time=COLUMN)";
    const ForeignColumn& column = table.columns[static_cast<std::size_t>(number - 1)];
    if (known_time_unit(table.path, column.name, column.holds_dates, mapping)) return {};
    if (is_numbered(column.values))
        return fmt::format("rate_hz=... (rows a second; {} merely numbers them), or time_unit=s, ms, us, ns",
                           described(column));
    TextColumn times{.number = column.number, .name = column.name, .values = column.values};
    const auto found = row_times(times, table.path, false);
    if (!found) return fmt::format("time_unit=s, ms, us or ns (of {})", described(column));
    return fmt::format("time_unit=s (then {:.6g} Hz), ms ({:.6g} Hz), us or ns, of {}", 1.0 / found->step,
                       1e3 / found->step, described(column));
}

}  // namespace zlg::logs
