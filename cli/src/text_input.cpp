#include "text_input.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/logs/row_times.hpp>
#include <zlg/logs/text_columns.hpp>
#include <zlg/logs/time_check.hpp>
#include <zlg/recorded/text_layout.hpp>

#include "failure.hpp"
#include "output.hpp"

namespace zlg::cli {
namespace {

struct TextAxes {
    logs::TextLayout layout;
    config::TextHolds holds;
    double scale_arcsec;
    std::optional<double> rate_hz;
    bool column_is_said = false;
};

// [motion] describes a file of motion in the same words; where it says anything of one, it may stand in.
bool motion_describes_a_file(const config::Motion& m) {
    const config::Motion unset;
    return m.column != unset.column || m.column_holds != unset.column_holds || m.scale_arcsec != unset.scale_arcsec ||
           m.rate_hz != unset.rate_hz || m.comment != unset.comment || m.skip_lines != unset.skip_lines ||
           m.separator != unset.separator || m.decimal != unset.decimal || m.time_column != unset.time_column;
}

TextAxes text_axes(const config::Config& config, const std::string& path) {
    const config::Analysis& a = config.analysis;
    TextAxes axes;
    if (a.column_holds) {
        axes.layout = recorded::text_layout(a);
        axes.layout.columns = a.column;
        axes.holds = *a.column_holds;
        axes.scale_arcsec = a.scale_arcsec;
        axes.rate_hz = a.rate_hz;
    } else if (motion_describes_a_file(config.motion)) {
        const config::Motion& m = config.motion;
        axes.layout = recorded::text_layout(m);
        axes.layout.columns = a.column;
        if (a.column.empty() && !m.column.empty()) axes.layout.columns = {m.column};
        axes.holds =
            m.column_holds == config::ColumnHolds::rate ? config::TextHolds::rate : config::TextHolds::increment;
        axes.scale_arcsec = m.scale_arcsec;
        axes.rate_hz = m.rate_hz;
    } else {
        throw config::ConfigError{
            fmt::format("analysis.column_holds is not set: {} is no log of zlg; say what its columns hold, "
                        "\"increment\", \"rate\" or \"phase\", with analysis.scale_arcsec and analysis.rate_hz",
                        path)};
    }
    axes.column_is_said = !axes.layout.columns.empty();
    if (!axes.column_is_said) axes.layout.columns = {"1"};
    return axes;
}

// The rows per second, which the times of the rows must bear out; rows that are missing by their times become so.
double checked_rate_hz(const TextAxes& what, logs::TextTable& table, const std::string& path) {
    const bool holds_angle = what.holds == config::TextHolds::phase;
    const std::string mistaken = logs::mistaken_times(table, path, what.layout,
                                                      {.column_is_said = what.column_is_said,
                                                       .may_rise = holds_angle,
                                                       .noun = holds_angle ? "angle" : "rate",
                                                       .rate_hz = what.rate_hz});
    if (!mistaken.empty()) throw config::ConfigError{mistaken};
    const logs::TimeCheck check = logs::check_times(table, path, what.layout, what.rate_hz);
    if (!what.rate_hz)
        throw config::ConfigError{fmt::format(
            "analysis.rate_hz is not set: say how many rows of {} make a second{}", path,
            check.times ? fmt::format("; {}", logs::rate_in_words(*table.times, *check.times)) : std::string{})};
    if (!check.contradiction.empty()) throw config::ConfigError{check.contradiction};
    if (!check.presumption.empty()) complain("warning: " + check.presumption);
    if (!check.times || check.times->n_missing == 0) return *what.rate_hz;
    const std::string missing = logs::missing_in_words(table, path, *check.times);
    logs::refuse_many_missing(path, logs::described(*table.times), table.times->values, *check.times,
                              fmt::format("; {}.time_column = 0 if none are missing", what.layout.section));
    complain(fmt::format("warning: {}; they count as missing samples", missing));
    for (logs::TextColumn& column : table.columns) logs::fill_holes(column.values, *check.times);
    return *what.rate_hz;
}

std::string holds_text(const TextAxes& axes) {
    switch (axes.holds) {
        case config::TextHolds::increment:
            return fmt::format("increments, {} arcsec a unit", axes.scale_arcsec);
        case config::TextHolds::phase:
            return fmt::format("angles, {} arcsec a unit", axes.scale_arcsec);
        case config::TextHolds::rate:
            break;
    }
    return fmt::format("rates, {} arcsec/s a unit", axes.scale_arcsec);
}

// Neither too large to be squared: a rate from angles may be the sum of two.
void scale(const std::string& path, const std::string& axis, double scale_arcsec, std::vector<double>& values) {
    constexpr double most = 1e90;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double value = values[k];
        values[k] *= scale_arcsec;
        if (!std::isfinite(value) || std::fabs(values[k]) <= most) continue;
        throw logs::FormatError{fmt::format(
            "{}: {}, sample {}: {:g} times {:g} arcsec; allowed is -1e90..1e90, or sums of its squares overflow", path,
            axis, k + 1, value, scale_arcsec)};
    }
}

study::TableResult table_test(const config::Analysis& a, const study::AxisRecord& axis,
                              const std::vector<double>& table_rates) {
    if (table_rates.size() != axis.rates_arcsec_s.size())
        throw config::ConfigError{"analysis.column_holds = \"phase\": a rate-table test takes increments or rates"};
    const double settling =
        std::min(std::ceil(a.table_settling_s * axis.rate_hz), static_cast<double>(table_rates.size()));
    const calibration::RateTableOptions options{.settling_samples = static_cast<std::int64_t>(settling),
                                                .earth_arcsec_s = a.table_earth_arcsec_s};
    try {
        return {.name = axis.name,
                .holds = axis.holds,
                .table = calibration::rate_table(table_rates, axis.rates_arcsec_s, options)};
    } catch (const deviations::SeriesError& error) {
        throw deviations::SeriesError{fmt::format("{}: {}", axis.name, error.what())};
    }
}

}  // namespace

config::Config read_text(const Options& options, const std::string& path, std::vector<study::AxisRecord>& axes,
                         std::vector<study::TableResult>& tables) {
    logs::refuse_foreign(path);
    const config::Config config = load_config(options);
    TextAxes what = text_axes(config, path);
    const std::string& table_column = config.analysis.table_column;
    const bool on_table = table_column.find_first_not_of('0') != std::string::npos;
    if (on_table) what.layout.columns.push_back(table_column);
    logs::TextTable table = logs::read_text_table(path, what.layout);
    const double rate_hz = checked_rate_hz(what, table, path);
    std::vector<logs::TextColumn>& columns = table.columns;
    std::vector<double> table_rates;
    if (on_table) {
        table_rates = std::move(columns.back().values);
        columns.pop_back();
        for (double& r : table_rates) r *= config.analysis.table_scale_arcsec_s;
    }
    const bool is_rate = what.holds == config::TextHolds::rate;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const deviations::DataKind kind = what.holds == config::TextHolds::phase ? deviations::DataKind::phase
                                          : is_rate                              ? deviations::DataKind::rate
                                                                                 : deviations::DataKind::increments;
        study::AxisRecord axis;
        axis.name = fmt::format("{}, {}", name_of_file(path), logs::described(columns[c]));
        axis.group = path;
        axis.holds = holds_text(what);
        axis.rate_hz = rate_hz;
        std::vector<double>& values = columns[c].values;
        scale(path, axis.name, what.scale_arcsec, values);
        axis.rates_arcsec_s = noise::rates_arcsec_s(
            {.what = {kind, is_rate ? deviations::Unit::arcsec_s : deviations::Unit::arcsec, rate_hz},
             .values = values});
        if (kind == deviations::DataKind::phase) axis.phase_arcsec = std::move(values);
        std::vector<double>{}.swap(values);
        if (on_table)
            tables.push_back(table_test(config.analysis, axis, table_rates));
        else
            axes.push_back(std::move(axis));
    }
    return config;
}

}  // namespace zlg::cli
