#include "row_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <zlg/logs/error.hpp>
#include <zlg/logs/time_check.hpp>

#include "text_table/time_names.hpp"

namespace zlg::logs {

namespace {

const std::map<std::string, double> to_a_second{{"s", 1.0},  {"ms", 1e3},         {"us", 1e6},
                                                {"ns", 1e9}, {"min", 1.0 / 60.0}, {"h", 1.0 / 3600.0}};

bool is_numbered(std::span<const double> values) {
    return values.size() > 2 && values[1] - values[0] == 1.0 &&
           std::ranges::all_of(values, [](double v) { return v == std::floor(v); });
}

// How many of the column's unit make a second; empty: nobody says it.
std::optional<double> known_unit(const std::string& name, bool holds_dates, const Mapping& mapping) {
    if (holds_dates) return 1.0;
    if (mapping.has("time_unit")) return to_a_second.at(mapping.text("time_unit"));
    return unit_of(name);
}

// The number with the fewest digits that the times allow.
double simplest(double step, double tolerance) {
    for (int digits = 1; digits < 17; ++digits) {
        const double rounded = std::stod(fmt::format("{:.{}e}", step, digits - 1));
        if (std::fabs(rounded - step) <= tolerance * step) return rounded;
    }
    return step;
}

// The rows about a hole must be as far apart as their number says, the missing ones with them: stamps that come late after a
// pause of the program that wrote them look like a hole, and are none.
void check_holes(const TextColumn& times, const RowTimes& found, const std::string& path) {
    constexpr std::size_t reach = 12;
    const std::vector<double>& t = times.values;
    for (std::size_t h = 0; h < found.holes.size(); ++h) {
        const std::size_t row = found.holes[h].row;
        std::size_t from = row - std::min(row, reach), to = std::min(row + 1 + reach, t.size() - 1);
        if (h > 0) from = std::max(from, found.holes[h - 1].row + 1);
        if (h + 1 < found.holes.size()) to = std::min(to, found.holes[h + 1].row);
        const double rows = static_cast<double>(to - from) + static_cast<double>(found.holes[h].n_missing);
        const double steps = (t[to] - t[from]) / found.step;
        if (std::fabs(steps - rows) <= 0.6) continue;
        throw FormatError(
            fmt::format("{}, {}: after row {} the times jump from {} to {} and then do not go on evenly, so that they "
                        "do not say how many rows "
                        "are missing; --map time=none and --map rate_hz=... if none are",
                        path, described(times), row + 1, t[row], t[row + 1]));
    }
}

// A row that stands twice would shift all that follow by one. Stamps that are merely late or coarse make up for it beside.
void check_repetitions(const TextColumn& times, const std::string& path) {
    const std::vector<double>& t = times.values;
    std::size_t n_zero = 0;
    for (std::size_t k = 1; k < t.size(); ++k) n_zero += t[k] == t[k - 1] ? 1u : 0u;
    if (n_zero == 0 || 4 * n_zero > t.size()) return;
    const double mean = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    for (std::size_t k = 1; k < t.size(); ++k) {
        if (t[k] != t[k - 1]) continue;
        const std::size_t from = k > 1 ? k - 2 : 0, to = std::min(k + 1, t.size() - 1);
        if (t[to] - t[from] > (static_cast<double>(to - from) - 0.4) * mean) continue;
        throw FormatError(
            fmt::format("{}, {}: row {} has the time {} of the row before it; allowed are times that rise, or --map "
                        "time=none with rate_hz if no row stands twice",
                        path, described(times), k + 1, t[k]));
    }
}

// As a column that is called time does, with holes or not.
bool goes_on(std::span<const double> values) {
    return values.size() > 1 && values.front() < values.back() && std::ranges::is_sorted(values);
}

}  // namespace

std::int64_t time_column(const ForeignTable& table, const Mapping& mapping) {
    if (mapping.has("time")) {
        const std::string name = mapping.text("time");
        return name == "none" || name == "0" ? 0 : column_named(table, name).number;
    }
    const auto rises = [](const ForeignColumn& c) { return c.holds_dates || rises_as_time(c.values); };
    for (const ForeignColumn& column : table.columns)
        if (names_time(column.name) && (column.holds_dates || goes_on(column.values))) return column.number;
    for (const ForeignColumn& column : table.columns)
        if (column.holds_dates) return column.number;
    for (const ForeignColumn& column : table.columns)
        if (column.name.empty() && column.is_number && rises(column)) return column.number;
    return 0;
}

std::string missing_of_clock(const ForeignTable& table, const Mapping& mapping) {
    if (mapping.has("rate_hz")) return {};
    const std::int64_t number = time_column(table, mapping);
    if (number == 0) return "rate_hz=... (rows a second; no column of times was recognised, or time=COLUMN)";
    const ForeignColumn& column = table.columns[static_cast<std::size_t>(number - 1)];
    if (known_unit(column.name, column.holds_dates, mapping)) return {};
    if (is_numbered(column.values))
        return fmt::format("rate_hz=... (rows a second; {} merely numbers them), or time_unit=s, ms, us, ns",
                           described(column));
    TextColumn times{.number = column.number, .name = column.name, .values = column.values};
    const auto found = row_times(times, table.path, false);
    if (!found) return fmt::format("time_unit=s, ms, us or ns (of {})", described(column));
    return fmt::format("time_unit=s (then {:.6g} Hz), ms ({:.6g} Hz), us or ns, of {}", 1.0 / found->step,
                       1e3 / found->step, described(column));
}

RowClock row_clock(const TextTable& read, const std::string& path, const Mapping& mapping,
                   std::optional<double> presumed_step_s) {
    RowClock clock;
    const auto rate_hz = mapping.real("rate_hz");
    if (rate_hz) presumed_step_s = 1.0 / *rate_hz;
    if (!read.times) {
        if (!presumed_step_s) throw MappingError(fmt::format("{}: --map rate_hz=... is missing: rows a second", path));
        clock.step_s = *presumed_step_s;
        return clock;
    }
    const TextColumn& times = *read.times;
    clock.times = row_times(times, path, true);
    if (!clock.times) {
        if (!presumed_step_s)
            throw FormatError(
                fmt::format("{}, {}: too few rows for a rate; allowed are 3 or more", path, described(times)));
        clock.step_s = *presumed_step_s;
        return clock;
    }
    check_repetitions(times, path);
    check_holes(times, *clock.times, path);
    const double step = clock.times->step;
    const auto unit = known_unit(times.name, times.holds_dates, mapping);
    if (unit) {
        const double by_times_s = step / *unit;
        if (presumed_step_s && std::fabs(by_times_s / *presumed_step_s - 1.0) > clock.times->tolerance)
            throw MappingError(
                fmt::format("{}, {}: a row is {:.6g} s by its times, {:.6g} s by what is said; allowed is one "
                            "value (time_unit=s, ms, us, ns, or time=none)",
                            path, described(times), by_times_s, *presumed_step_s));
        clock.step_s = presumed_step_s.value_or(simplest(by_times_s, clock.times->tolerance - 1e-3 + 1e-9));
    } else if (presumed_step_s) {
        const std::string why = contradiction(times, *clock.times, 1.0 / *presumed_step_s);
        if (!why.empty())
            throw MappingError(
                fmt::format("{}, {}, and a row is {:.6g} s by what is said; allowed is one value (time_unit=s, "
                            "ms, us, ns, or time=none)",
                            path, why, *presumed_step_s));
        if (const std::string name = presumed_unit(times, *clock.times, 1.0 / *presumed_step_s); !name.empty())
            clock.notes.push_back(fmt::format("{} is read as {}, which its name does not say", described(times), name));
        clock.step_s = *presumed_step_s;
    } else {
        throw MappingError(
            fmt::format("{}: --map time_unit=s, ms, us or ns is missing, of {}", path, described(times)));
    }
    if (std::ranges::adjacent_find(times.values) != times.values.end())
        clock.notes.push_back(
            fmt::format("{}: its times repeat, so that a single row that is missing is not seen", described(times)));
    clock.notes.push_back(fmt::format("{}: a row is {:.9g} s", described(times), clock.step_s));
    if (clock.times->n_missing > 0)
        clock.notes.push_back(missing_in_words(read, path, *clock.times).substr(path.size() + 2));
    return clock;
}

}  // namespace zlg::logs
