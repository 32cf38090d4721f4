#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <zlg/logs/error.hpp>
#include <zlg/logs/imported.hpp>

#include "celsius.hpp"
#include "mixed_rows.hpp"
#include "raw_sources.hpp"
#include "row_clock.hpp"
#include "suspect_values.hpp"
#include "units.hpp"

namespace zlg::logs {

namespace {

constexpr double largest = 1e90;  // whose square, and the sum of many, is a number

std::string words_of(const Mapping& mapping) {
    const std::string holds = mapping.text("holds");
    return fmt::format("{}s, {}", holds, mapping.text("unit"));
}

double arcsec_of(const Mapping& mapping) {
    const AngleUnit unit = unit_named(mapping.text("unit")).value();
    return unit.arcsec * (unit.of_counts ? mapping.real("scale_arcsec").value() : 1.0) *
           mapping.real("scale").value_or(1.0);
}

void check_kind(const ForeignLook& look) {
    const AngleUnit unit = unit_named(look.mapping.text("unit")).value();
    const bool is_rate = look.mapping.text("holds") == "rate";
    if (is_rate == (unit.kind == UnitKind::rate)) return;
    throw MappingError(fmt::format("{}: holds = {} and unit = {}; allowed is {}", look.table.path,
                                   look.mapping.text("holds"), unit.name,
                                   is_rate ? "the unit of a rate" : "the unit of an angle, or holds=rate"));
}

ImportedAxis axis_of(const ForeignLook& look, TextColumn& column, const RowClock& clock) {
    const std::string holds = look.mapping.text("holds");
    const double arcsec = arcsec_of(look.mapping);
    if (holds != "angle" && rises_as_time(column.values))
        throw MappingError(fmt::format("{}, {} rises steadily and is no {}; allowed is another axis, or holds=angle",
                                       look.table.path, described(column), holds));
    refuse_wraps(look, column, unit_named(look.mapping.text("unit")).value());
    refuse_missing_marks(look.table.path, column);
    std::vector<std::string> warnings = no_measurements(column, holds);
    const double rate_hz = 1.0 / clock.step_s, each_s = holds == "increment" ? rate_hz : 1.0;
    std::size_t row = 0;
    column.values.change([&](double value) {
        ++row;
        value *= arcsec;
        if (!std::isnan(value) && !(std::fabs(value) <= largest))
            throw FormatError(fmt::format("{}, {}, row {}: {:g} arcsec; allowed is -1e90..1e90", look.table.path,
                                          described(column), row, value));
        return value * each_s;
    });
    if (clock.times) fill_holes(column.values, *clock.times);
    ImportedAxis axis{.name = described(column),
                      .holds = words_of(look.mapping),
                      .rate_hz = rate_hz,
                      .rates_arcsec_s = {},
                      .phase_arcsec = {},
                      .mode = {},
                      .warnings = std::move(warnings)};
    if (holds == "angle") {
        axis.phase_arcsec = std::move(column.values);
        const LongColumn& angle = axis.phase_arcsec;
        for (std::size_t k = 1; k < angle.size(); ++k)
            axis.rates_arcsec_s.push_back((angle[k] - angle[k - 1]) * rate_hz);
    } else {
        axis.rates_arcsec_s = std::move(column.values);
    }
    if (std::ranges::all_of(axis.rates_arcsec_s, [](double r) { return std::isnan(r); }))
        throw FormatError(fmt::format("{}, {}: no value is known", look.table.path, axis.name));
    return axis;
}

// Of each row; where it is not known that of the row before. Of angles it is that of the row that ends the turn.
std::vector<std::int8_t> modes_of(const ForeignLook& look, TextColumn& column, const RowClock& clock) {
    make_signs(column.values, look.mapping.real("mode_plus"), fmt::format("{}, {}", look.table.path, described(column)),
               "mode");
    if (clock.times) fill_holes(column.values, *clock.times);
    const bool is_angle = look.mapping.text("holds") == "angle";
    std::vector<std::int8_t> mode;
    std::int8_t last = 1;
    for (std::size_t k = 0; k < column.values.size(); ++k) {
        if (!std::isnan(column.values[k])) last = column.values[k] > 0.0 ? 1 : -1;
        if (k > 0 || !is_angle) mode.push_back(last);
    }
    return mode;
}

std::vector<double> table_rates(const ForeignLook& look, TextColumn& column, const RowClock& clock) {
    auto unit = unit_in_name(column.name);
    if (look.mapping.has("table_unit")) unit = unit_named(look.mapping.text("table_unit"));
    column.values.change([arcsec = unit.value().arcsec](double rate) { return rate * arcsec; });
    if (clock.times) fill_holes(column.values, *clock.times);
    return column.values.vector();
}

}  // namespace

ImportedAxes imported_axes(const ForeignLook& look) {
    require_whole(look);
    check_kind(look);
    std::vector<std::int64_t> wanted;
    for (const std::string& axis : look.mapping.axes()) wanted.push_back(column_named(look.table, axis).number);
    const std::int64_t times = time_column(look.table, look.mapping);
    if (std::ranges::find(wanted, times) != wanted.end())
        throw MappingError(
            fmt::format("{}: axis = {}: this column holds the times of the rows; allowed is another, or time=none",
                        look.table.path, times));
    const std::size_t n_axes = wanted.size();
    for (const char* key : {"mode", "temperature_c", "table_rate"})
        if (look.mapping.has(key)) wanted.push_back(column_named(look.table, look.mapping.text(key)).number);
    TextTable read = look.table.read(wanted, times);
    take_out_missing(look.mapping, read);
    ImportedAxes imported{.axes = {}, .table_rates_arcsec_s = {}, .temperature_c = {}, .notes = settle_times(read)};
    if (read.times && holds_rows_of_others(look))
        imported.notes.push_back(
            fmt::format("{} rows without a value of the axis hold those of others, and are left out",
                        take_out_empty_rows(read, n_axes)));
    std::vector<std::string> warnings = take_once(read, look.table.path);
    const RowClock clock = row_clock(read, look.table.path, look.mapping, std::nullopt);
    read.times.reset();
    std::copy(clock.notes.begin(), clock.notes.end(), std::back_inserter(imported.notes));
    std::copy(clock.warnings.begin(), clock.warnings.end(), std::back_inserter(warnings));
    if (look.mapping.has("table_rate")) imported.table_rates_arcsec_s = table_rates(look, read.columns.back(), clock);
    const auto mode =
        look.mapping.has("mode") ? modes_of(look, read.columns[n_axes], clock) : std::vector<std::int8_t>{};
    if (look.mapping.has("temperature_c")) {
        TextColumn& column = read.columns[n_axes + (look.mapping.has("mode") ? 1 : 0)];
        if (const std::string note = make_celsius(column); !note.empty()) imported.notes.push_back(note);
        if (clock.times) fill_holes(column.values, *clock.times);
        imported.temperature_c = column.values.vector();
        if (look.mapping.text("holds") == "angle") imported.temperature_c.erase(imported.temperature_c.begin());
    }
    for (std::size_t k = 0; k < n_axes; ++k) {
        imported.axes.push_back(axis_of(look, read.columns[k], clock));
        imported.axes.back().mode = mode;
        std::vector<std::string>& own = imported.axes.back().warnings;
        own.insert(own.begin(), warnings.begin(), warnings.end());
    }
    return imported;
}

TextColumn even_column(const ForeignTable& table, const Mapping& mapping) {
    const bool is_said = mapping.has("axis");
    const std::string axis = is_said ? mapping.axes().front() : "1";
    const ForeignColumn& chosen = column_named(table, axis);
    refuse_words(chosen);
    std::int64_t number = time_column(table, mapping);
    if (!is_said && (chosen.number == number || rises_as_time(chosen.values)))
        throw MappingError(
            fmt::format("--map axis is not set: {}, {} rises as times do; allowed is --map axis=COLUMN, also this one",
                        table.path, described(chosen)));
    if (chosen.number == number) number = 0;  // whoever asks for it knows that it holds something else
    TextTable read = table.read({chosen.number}, number);
    (void)settle_times(read);
    const RowClock clock = row_clock(read, table.path, mapping, std::nullopt);
    if (clock.times) {
        const std::string unit = presumed_unit(*read.times, *clock.times, 1.0 / clock.step_s);
        if (!unit.empty())
            throw MappingError(
                fmt::format("{}, {}: read as {}, which its name does not say; allowed are seconds, or --map time=none",
                            table.path, described(*read.times), unit));
        if (clock.times->n_missing > 0)
            throw FormatError(fmt::format("{}, {}; allowed are rows of which none is missing", table.path,
                                          missing_in_words(*read.times, *clock.times)));
    }
    return std::move(read.columns.front());
}

std::int64_t angle_rows(const ImportedAxis& axis, const std::function<void(const core::AngleRow&)>& take) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const LongColumn& angle = axis.phase_arcsec;
    const std::size_t n = axis.rates_arcsec_s.size();
    for (std::size_t from = 0, to = 0; from < n; from = to) {
        // Between two angles that are known the turn is known, and not where it happened.
        for (++to; to < angle.size() && std::isnan(angle[to]);) ++to;
        const bool is_spread = to > from + 1 && to < angle.size() && !std::isnan(angle[from]);
        for (std::size_t k = from; k < std::min(to, n); ++k) {
            const double rate = axis.rates_arcsec_s[k];
            core::AngleRow row{.tick = static_cast<std::int64_t>(k), .sigma_arcsec = unknown};
            if (!std::isnan(rate))
                row.dtheta_arcsec = rate / axis.rate_hz;
            else if (is_spread)
                row.dtheta_arcsec = (angle[to] - angle[from]) / static_cast<double>(to - from);
            row.dtheta_final_arcsec = row.dtheta_arcsec;
            if (std::isnan(rate))
                row.flags = core::flag_invalid | (is_spread ? core::flag_interpolated : core::flag_unrepaired);
            if (!axis.mode.empty()) row.mode = axis.mode[k];
            take(row);
        }
    }
    return static_cast<std::int64_t>(n);
}

}  // namespace zlg::logs
