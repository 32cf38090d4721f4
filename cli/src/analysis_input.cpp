#include "analysis_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/recorded/log_compensation.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/axis_records.hpp>

#include "failure.hpp"
#include "mapping_input.hpp"
#include "output.hpp"

namespace zlg::cli {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// The angle, and its error where the truth is known; what may be no measurement is said.
void finish(study::TickRates& ticks, std::vector<study::AxisRecord>& axes) {
    const std::size_t first = axes.size();
    ticks.finish(axes);
    note_all(axes[first].group, axes[first].warnings);
}

config::Config read_angles(const Options& options, const std::string& path, std::vector<study::AxisRecord>& axes) {
    logs::AngleReader reader{path};
    for (const std::string& warning : reader.header().warnings) complain("warning: " + warning);
    const config::Config config = load_log_config(options, reader.header().settings, path, LogFacts::tick);
    note_former_keys(reader.header().settings, path);
    study::TickRates ticks(path, config.gyro.tick_s);
    logs::TimedAngle angle;
    Progress progress;
    double first_s = missing;
    for (std::int64_t n = 1; reader.next(angle); ++n) {
        if (n == 1) first_s = angle.t_s;
        ticks.take(angle.row, angle.truth_dtheta_arcsec);
        if (n % 100'000 == 0) progress.show(reader.fraction_read());
    }
    if (!reader.header().complete)
        complain(fmt::format("warning: {}: was not closed by its writer; its whole rows are taken", path));
    if (ticks.empty()) throw logs::FormatError{fmt::format("{}: holds no tick", path)};
    study::check_tick(path, config.gyro.tick_s, first_s, angle);
    finish(ticks, axes);
    return config;
}

config::Config read_raw(const Options& options, const std::string& path, std::vector<study::AxisRecord>& axes) {
    logs::RawReader raw = open_raw(options, path);
    for (const std::string& warning : raw.header().warnings) complain("warning: " + warning);
    const recorded::LogCompensation asked = log_compensation(options, raw.header(), path);
    study::TickRates ticks(path, asked.config.gyro.tick_s);
    rig::Replay replay{asked.compensation};
    const auto take = [&](const core::AngleRow& row) { ticks.take(row); };
    core::HalfRecord record;
    Progress progress;
    while (raw.next(record)) {
        replay.take(record, raw.light(), take);
        if (replay.halves() % 100'000 == 0) progress.show(raw.fraction_read());
    }
    replay.end(take);
    recorded::require_a_tick(replay, path);
    if (asked.lacks_detuning) warn_uncorrected(replay, path);
    for (const std::string& wrong : replay.contradictions(path)) complain("warning: " + wrong);
    finish(ticks, axes);
    return asked.config;
}

study::TableResult table_test(const config::Analysis& a, const study::AxisRecord& axis,
                              const std::vector<double>& table_rates) {
    if (table_rates.size() != axis.rates_arcsec_s.size())
        throw UsageError{"--map holds=angle: a rate-table test takes increments or rates"};
    const auto options = study::table_options(a, axis.rate_hz, table_rates.size());
    try {
        study::TableResult result{.name = axis.name,
                                  .holds = axis.holds,
                                  .table = calibration::rate_table(table_rates, axis.rates_arcsec_s, options)};
        if (!axis.temperature_c.empty())
            result.temperature = noise::bias_temperature({.rates_arcsec_s = axis.rates_arcsec_s,
                                                          .temperature_c = axis.temperature_c,
                                                          .input_arcsec_s = table_rates});
        result.warnings = axis.warnings;
        for (const std::size_t k : result.table.far)
            result.warnings.push_back(
                fmt::format("{}: stage {} of {}, at {:.6g} arcsec/s, is far off the line through the others", axis.name,
                            k + 1, result.table.stages.size(), result.table.stages[k].input_arcsec_s));
        return result;
    } catch (const deviations::SeriesError& error) {
        throw deviations::SeriesError{fmt::format("{}: {}", axis.name, error.what())};
    }
}

// Axes of another program's file.
config::Config read_mapped(const Options& options, const std::string& path, const logs::ForeignLook& look,
                           AnalysisInput& input) {
    const config::Config config = load_config(options);
    logs::ImportedAxes imported = logs::imported_axes(look);
    note_all(path, look.table.notes);
    note_all(path, look.said);
    note_all(path, imported.notes);
    for (logs::ImportedAxis& from : imported.axes) {
        study::AxisRecord axis = study::axis_of(path, std::move(from));
        axis.temperature_c = imported.temperature_c;
        const bool is_turned = !imported.table_rates_arcsec_s.empty();
        if (is_turned) input.tables.push_back(table_test(config.analysis, axis, imported.table_rates_arcsec_s));
        note_all(path, is_turned ? input.tables.back().warnings : axis.warnings);
        if (!is_turned) input.axes.push_back(std::move(axis));
    }
    return config;
}

config::Config read_one(const Options& options, const std::string& path, AnalysisInput& input) {
    if (!is_mapped(options)) {
        const logs::LogKind kind = logs::recognise(path);
        if (is_raw(kind)) return read_raw(options, path, input.axes);
        if (is_angles(kind)) return read_angles(options, path, input.axes);
    }
    const logs::ForeignLook look = look_at(options, {path});
    if (look.makes == logs::Makes::axes) return read_mapped(options, path, look, input);
    return read_raw(options, path, input.axes);
}

// Deviations are sums of squares, and their fit squares them again: a double must hold the fourth power.
void check_sizes(const study::AxisRecord& axis) {
    constexpr double most = 1e30, least = 1e-30;               // arcsec/s
    constexpr double fewest_per_s = 1e-12, most_per_s = 1e12;  // samples
    const std::string name =
        axis.name.starts_with(axis.group) ? axis.name : fmt::format("{}: {}", axis.group, axis.name);
    if (!(axis.rate_hz >= fewest_per_s && axis.rate_hz <= most_per_s))
        throw logs::FormatError{fmt::format("{}: {:g} samples a second; allowed is {:g}..{:g}", name, axis.rate_hz,
                                            fewest_per_s, most_per_s)};
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (std::size_t k = 0; k < axis.rates_arcsec_s.size(); ++k) {
        const double rate = axis.rates_arcsec_s[k];
        if (std::isnan(rate)) continue;
        if (!(std::fabs(rate) <= most))
            throw logs::FormatError{
                fmt::format("{}: sample {} is {:g} arcsec/s; allowed is -1e30..1e30, or sums of its squares overflow",
                            name, k + 1, rate)};
        lowest = std::min(lowest, rate);
        highest = std::max(highest, rate);
    }
    if (lowest < highest && highest - lowest < least)
        throw logs::FormatError{
            fmt::format("{}: samples differ by {:g} arcsec/s at most; allowed is 1e-30 or more, or their squares "
                        "are too small for a number",
                        name, highest - lowest)};
}

// Of different files, that is.
bool one_axis_each(const std::vector<study::AxisRecord>& axes) {
    std::vector<std::string> groups;
    for (const study::AxisRecord& axis : axes)
        if (!axis.is_error) groups.push_back(axis.group);
    std::ranges::sort(groups);
    return std::ranges::adjacent_find(groups) == groups.end();
}

}  // namespace

AnalysisInput read_analysis_input(const Options& options, const std::vector<std::string>& paths) {
    AnalysisInput input;
    for (std::size_t k = 0; k < paths.size(); ++k) {
        config::Config config = read_one(options, paths[k], input);
        if (k == 0) input.config = std::move(config);
    }
    for (const study::AxisRecord& axis : input.axes) check_sizes(axis);
    // Three files of one axis each, whose errors are no axes, are those of one unit.
    const auto n = std::ranges::count(input.axes, false, &study::AxisRecord::is_error);
    if (paths.size() == 3 && n == 3 && one_axis_each(input.axes))
        for (study::AxisRecord& axis : input.axes)
            if (!axis.is_error) axis.group = "the three files";
    return input;
}

}  // namespace zlg::cli
