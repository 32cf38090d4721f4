// Rows of several sensors by turns are no samples of one.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>
#include <zlg/logs/imported.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>

#include "mixed_rows.hpp"
#include "row_clock.hpp"

namespace zlg::logs {

namespace {

constexpr std::size_t most_sensors = 16;

bool names_sensor(const std::string& name) {
    constexpr std::string_view names =
        " id sensor sensor_id sensorid device device_id channel kanal node can_id axis achse ";
    return !name.empty() && names.find(fmt::format(" {} ", text::lower_case(name))) != std::string_view::npos;
}

// Of each row which of a few words or whole numbers stands in it; empty where they are many, or one.
std::vector<std::int64_t> kinds_of(const ForeignColumn& column) {
    std::vector<std::int64_t> kinds;
    if (!column.is_number) {
        if (!column.holds_dates && column.words.size() >= 2 && column.words.size() <= most_sensors)
            kinds = column.kinds;
        return kinds;
    }
    std::map<double, std::int64_t> known;
    for (const double value : column.values) {
        if (std::isnan(value)) continue;
        kinds.push_back(known.try_emplace(value, std::ssize(known)).first->second);
        if (value != std::floor(value) || known.size() > most_sensors) return {};
    }
    return known.size() < 2 || kinds.size() < column.values.size() ? std::vector<std::int64_t>{} : kinds;
}

// Rows of one kind, one after the other.
struct Run {
    std::int64_t kind = 0;
    std::size_t n = 0;
};

std::vector<Run> runs_of(const std::vector<std::int64_t>& kinds) {
    std::vector<Run> runs;
    for (const std::int64_t kind : kinds) {
        if (runs.empty() || runs.back().kind != kind) runs.push_back({kind, 0});
        ++runs.back().n;
    }
    return runs;
}

// Each is nearly always followed by one and the same other, after as many rows, as sensors by turns are; noise of a few
// counts is not.
bool take_turns(const std::vector<Run>& runs) {
    std::map<std::int64_t, std::map<std::int64_t, std::size_t>> next;
    std::map<std::size_t, std::size_t> lengths;
    for (std::size_t k = 1; k < runs.size(); ++k) {
        ++next[runs[k - 1].kind][runs[k].kind];
        ++lengths[runs[k - 1].n];
    }
    const auto most = [](const auto& counts) {
        std::size_t n = 0;
        for (const auto& [what, count] : counts) n = std::max(n, count);
        return n;
    };
    std::size_t n_usual = 0;
    for (const auto& [kind, counts] : next) n_usual += most(counts);
    return 20 * n_usual >= 19 * (runs.size() - 1) && 10 * most(lengths) >= 9 * (runs.size() - 1);
}

struct Moments {
    double n = 0.0, sum = 0.0, squares = 0.0;

    [[nodiscard]] double mean() const { return sum / n; }
    [[nodiscard]] double variance() const { return std::max(squares / n - mean() * mean(), 0.0); }
};

// The rows of two kinds differ in their mean or their scatter: a counter of the rows changes neither.
bool differ(const ForeignColumn& column, const std::vector<std::int64_t>& kinds) {
    constexpr double sigmas = 8.0, fewest = 8.0, times = 3.0;
    std::map<std::int64_t, Moments> moments;
    for (std::size_t k = 0; k < std::min(kinds.size(), column.values.size()); ++k) {
        const double value = column.values[k] - column.values.front();
        if (std::isnan(value)) continue;
        Moments& of = moments[kinds[k]];
        of.n += 1.0;
        of.sum += value;
        of.squares += value * value;
    }
    for (const auto& [kind, a] : moments)
        for (const auto& [other, b] : moments) {
            if (a.n < fewest || b.n < fewest || kind == other) continue;
            const double error = std::sqrt(a.variance() / a.n + b.variance() / b.n);
            if (std::fabs(a.mean() - b.mean()) > sigmas * error || a.variance() > times * b.variance()) return true;
        }
    return false;
}

}  // namespace

std::optional<std::pair<std::string, std::string>> mixed_rows(ForeignLook& look) {
    constexpr std::size_t seldom = 50, fewest = 8;  // rows of a kind; turns of each
    if (look.mapping.has("sensor")) return std::nullopt;
    for (const ForeignColumn& column : look.table.columns) {
        const std::vector<std::int64_t> kinds = kinds_of(column);
        if (kinds.empty() || is_said(column, look.table, look.mapping)) continue;
        const std::vector<Run> runs = runs_of(kinds);
        const bool is_often = runs.size() * seldom > kinds.size() && runs.size() > fewest;
        bool is_mixed = names_sensor(column.name);
        if (!is_mixed && is_often && (!column.is_number || take_turns(runs)))
            is_mixed = std::ranges::any_of(look.table.columns, [&](const ForeignColumn& other) {
                return &other != &column && other.is_number && !other.is_part && !rises_as_time(other.values) &&
                       kinds_of(other).empty() && differ(other, kinds);
            });
        if (!is_mixed && is_often && !column.is_number && take_turns(runs))
            look.said.push_back(
                fmt::format("{}: {} and others stand by turns, and are read as rows of one sensor; --map sensor={} "
                            "takes those of one",
                            described(column), column.first, column.first));
        if (!is_mixed) continue;
        const auto other = std::ranges::find_if(kinds, [&](std::int64_t kind) { return kind != kinds.front(); });
        const auto at = static_cast<std::size_t>(other - kinds.begin());
        if (column.is_number)
            return std::pair{std::string{"none"},
                             fmt::format("sensor=none if its rows are of one ({} is {} and {} by turns)",
                                         described(column), column.first, column.values[at])};
        const std::string second = text::excerpt(column.words[static_cast<std::size_t>(*other)], 30, ' ');
        return std::pair{column.words[static_cast<std::size_t>(kinds.front())],
                         fmt::format("sensor={} or {} ({} has them by turns; none: they are of one)", column.first,
                                     second, described(column))};
    }
    return std::nullopt;
}

bool holds_rows_of_others(const ForeignLook& look) {
    std::vector<bool> is_empty;
    for (const std::string& axis : look.mapping.axes()) {
        const std::vector<double>& values = column_named(look.table, axis).values;
        is_empty.resize(values.size(), true);
        for (std::size_t k = 0; k < values.size(); ++k) is_empty[k] = is_empty[k] && std::isnan(values[k]);
    }
    if (std::count(is_empty.begin(), is_empty.end(), false) == 0) return false;
    std::vector<bool> is_of_another(is_empty.size());
    for (const ForeignColumn& column : look.table.columns) {
        if (is_said(column, look.table, look.mapping)) continue;
        const auto is_here = [&](std::size_t k) { return k < column.values.size() && !std::isnan(column.values[k]); };
        bool is_other = true;
        for (std::size_t k = 0; k < is_empty.size(); ++k) is_other = is_other && (is_empty[k] || !is_here(k));
        for (std::size_t k = 0; k < is_empty.size(); ++k)
            is_of_another[k] = is_of_another[k] || (is_other && is_here(k));
    }
    return 2 * std::count(is_of_another.begin(), is_of_another.end(), true) >
           std::count(is_empty.begin(), is_empty.end(), true);
}

std::size_t take_out_empty_rows(TextTable& read, std::size_t n_axes) {
    const auto is_empty = [&](std::size_t k) {
        return std::all_of(read.columns.begin(), read.columns.begin() + static_cast<std::ptrdiff_t>(n_axes),
                           [k](const TextColumn& column) { return std::isnan(column.values[k]); });
    };
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < read.times->values.size(); ++k)
        if (is_empty(k)) rows.push_back(k);
    leave_out(read, rows);
    return rows.size();
}

}  // namespace zlg::logs
