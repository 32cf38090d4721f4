#include "analysis_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/text_columns.hpp>

#include "failure.hpp"
#include "log_compensation.hpp"
#include "output.hpp"

namespace zlg::cli {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// What was not measured: bridged, or not even that.
constexpr std::uint32_t not_measured = core::flag_switching | core::flag_extrapolated | core::flag_interpolated |
                                       core::flag_unrepaired | core::flag_loop_unlocked | core::flag_invalid |
                                       core::flag_mode_mixed;

std::string name_of_file(const std::string& path) { return std::filesystem::path{path}.filename().string(); }

// Ticks as they come, as rates.
class TickRates {
public:
    TickRates(const std::string& path, double tick_s, config::AngleColumn column) : tick_s_(tick_s), column_(column) {
        axis_.name = name_of_file(path);
        axis_.group = path;
        axis_.holds = fmt::format("{} angle of ticks of {} s",
                                  column == config::AngleColumn::final ? "final" : "delivered", tick_s);
        axis_.rate_hz = 1.0 / tick_s;
    }

    void take(const core::AngleRow& row, double truth_arcsec = missing) {
        const double angle = column_ == config::AngleColumn::final ? row.dtheta_final_arcsec : row.dtheta_arcsec;
        const bool known = (row.flags & not_measured) == 0;
        axis_.rates_arcsec_s.push_back(known ? angle / tick_s_ : missing);
        axis_.bridged_arcsec_s.push_back(angle / tick_s_);
        axis_.mode.push_back(row.mode);
        if (std::isfinite(truth_arcsec)) truth_.push_back(truth_arcsec / tick_s_);
    }

    // The angle, and its error where the truth is known.
    void finish(std::vector<study::AxisRecord>& axes) {
        if (truth_.size() == axis_.rates_arcsec_s.size() && !truth_.empty()) {
            study::AxisRecord error = axis_;
            error.name += ", error";
            error.group += " error";
            error.is_error = true;
            error.holds = "error of the " + error.holds;
            for (std::size_t k = 0; k < truth_.size(); ++k) {
                error.rates_arcsec_s[k] -= truth_[k];
                error.bridged_arcsec_s[k] -= truth_[k];
            }
            axes.push_back(std::move(axis_));
            axes.push_back(std::move(error));
            return;
        }
        axes.push_back(std::move(axis_));
    }

    [[nodiscard]] bool empty() const { return axis_.rates_arcsec_s.empty(); }

private:
    study::AxisRecord axis_;
    std::vector<double> truth_;
    double tick_s_;
    config::AngleColumn column_;
};

double tick_of(const logs::AngleHeader& header, const std::string& path) {
    for (const auto& [key, value] : header.settings) {
        if (key != "tick_s" && key != "gyro.tick_s") continue;
        double tick_s = 0.0;
        const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), tick_s);
        if (error == std::errc{} && end == value.data() + value.size() && tick_s > 0.0 && std::isfinite(tick_s))
            return tick_s;
        throw logs::FormatError{fmt::format("{}: {} = {}, allowed is a positive number", path, key, value)};
    }
    throw logs::FormatError{fmt::format("{}: does not say tick_s, the length of its ticks", path)};
}

config::Config read_angles(const Options& options, const std::string& path, std::vector<study::AxisRecord>& axes) {
    logs::AngleReader reader{path};
    for (const std::string& warning : reader.header().warnings) complain("warning: " + warning);
    const config::Config config = load_log_config(options, reader.header().settings, path);
    TickRates ticks(path, tick_of(reader.header(), path), config.analysis.angles);
    logs::TimedAngle angle;
    Progress progress;
    for (std::int64_t n = 1; reader.next(angle); ++n) {
        ticks.take(angle.row, angle.truth_dtheta_arcsec);
        if (n % 100'000 == 0) progress.show(reader.fraction_read());
    }
    if (!reader.header().complete)
        complain(fmt::format("warning: {}: was not closed by its writer; its whole rows are taken", path));
    if (ticks.empty()) throw logs::FormatError{fmt::format("{}: holds no tick", path)};
    ticks.finish(axes);
    return config;
}

config::Config read_raw(const Options& options, const std::string& path, std::vector<study::AxisRecord>& axes) {
    logs::RawReader raw{path};
    for (const std::string& warning : raw.header().warnings) complain("warning: " + warning);
    const config::Config config = load_log_config(options, raw.header().settings, path);
    const auto compensation = compensation_of(config, choose_relock(config, raw.header(), path), raw.header(), path);
    TickRates ticks(path, config.gyro.tick_s, config.analysis.angles);
    core::GyroCompensationState state;
    core::HalfRecord record;
    Progress progress;
    for (std::int64_t n = 1; raw.next(record); ++n) {
        const core::CompensationOutput out = step(compensation, state, record, raw.light());
        if (out.has_sample && out.sample.has_final) ticks.take(out.sample.final_row);
        if (n % 100'000 == 0) progress.show(raw.fraction_read());
    }
    for (auto out = drain(compensation, state); out.has_row || out.has_gap; out = drain(compensation, state))
        if (out.has_row) ticks.take(out.row);
    if (ticks.empty()) throw logs::FormatError{fmt::format("{}: holds no whole tick, which is two half-periods", path)};
    ticks.finish(axes);
    return config;
}

struct TextAxes {
    logs::TextLayout layout;
    config::TextHolds holds;
    double scale_arcsec;
    double rate_hz;
};

// [motion] describes a file of motion in the same words; where it says anything of one, it may stand in.
bool motion_describes_a_file(const config::Motion& m) {
    const config::Motion unset;
    return m.column != unset.column || m.column_holds != unset.column_holds || m.scale_arcsec != unset.scale_arcsec ||
           m.rate_hz != unset.rate_hz || m.comment != unset.comment || m.skip_lines != unset.skip_lines;
}

TextAxes text_axes(const config::Config& config, const std::string& path) {
    const config::Analysis& a = config.analysis;
    TextAxes axes;
    for (const double column : a.column) axes.layout.columns.push_back(static_cast<std::int64_t>(column));
    if (a.column_holds) {
        if (!a.rate_hz)
            throw config::ConfigError{
                fmt::format("analysis.rate_hz is not set: say how many rows of {} make a second", path)};
        axes.layout.comment = a.comment;
        axes.layout.skip_lines = a.skip_lines;
        axes.holds = *a.column_holds;
        axes.scale_arcsec = a.scale_arcsec;
        axes.rate_hz = *a.rate_hz;
    } else if (motion_describes_a_file(config.motion)) {
        const config::Motion& m = config.motion;
        axes.layout.comment = m.comment;
        axes.layout.skip_lines = m.skip_lines;
        if (axes.layout.columns.empty()) axes.layout.columns = {m.column};
        axes.holds =
            m.column_holds == config::ColumnHolds::rate ? config::TextHolds::rate : config::TextHolds::increment;
        axes.scale_arcsec = m.scale_arcsec;
        axes.rate_hz = m.rate_hz;
    } else {
        throw config::ConfigError{
            fmt::format("analysis.column_holds is not set: {} is no log of zlg; say what its columns hold, "
                        "\"increment\", \"rate\" or "
                        "\"phase\", with analysis.scale_arcsec and analysis.rate_hz",
                        path)};
    }
    if (axes.layout.columns.empty()) axes.layout.columns = {1};
    return axes;
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

study::TableResult table_test(const config::Analysis& a, const study::AxisRecord& axis,
                              const std::vector<double>& table_rates) {
    if (table_rates.size() != axis.rates_arcsec_s.size())
        throw config::ConfigError{"analysis.column_holds = \"phase\": a rate-table test takes increments or rates"};
    const double settling =
        std::min(std::ceil(a.table_settling_s * axis.rate_hz), static_cast<double>(table_rates.size()));
    const analysis::RateTableOptions options{.same_rate_ratio = a.table_same_rate_ratio,
                                             .settling_samples = static_cast<std::int64_t>(settling),
                                             .earth_arcsec_s = a.table_earth_arcsec_s};
    try {
        return {.name = axis.name,
                .holds = axis.holds,
                .table = analysis::rate_table(table_rates, axis.rates_arcsec_s, options)};
    } catch (const analysis::SeriesError& error) {
        throw analysis::SeriesError{fmt::format("{}: {}", axis.name, error.what())};
    }
}

config::Config read_text(const Options& options, const std::string& path, AnalysisInput& input) {
    const config::Config config = load_config(options);
    TextAxes what = text_axes(config, path);
    const bool on_table = config.analysis.table_column > 0;
    if (on_table) what.layout.columns.push_back(config.analysis.table_column);
    auto columns = logs::read_text_columns(path, what.layout);
    std::vector<double> table_rates;
    if (on_table) {
        table_rates = std::move(columns.back());
        columns.pop_back();
        for (double& r : table_rates) r *= config.analysis.table_scale_arcsec_s;
    }
    const bool is_rate = what.holds == config::TextHolds::rate;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const analysis::DataKind kind = what.holds == config::TextHolds::phase ? analysis::DataKind::phase
                                        : is_rate                              ? analysis::DataKind::rate
                                                                               : analysis::DataKind::increments;
        study::AxisRecord axis;
        axis.name = fmt::format("{}, column {}", name_of_file(path), what.layout.columns[c]);
        axis.group = path;
        axis.holds = holds_text(what);
        axis.rate_hz = what.rate_hz;
        for (double& v : columns[c]) v *= what.scale_arcsec;
        axis.rates_arcsec_s = analysis::rates_arcsec_s(
            {.what = {kind, is_rate ? analysis::Unit::arcsec_s : analysis::Unit::arcsec, what.rate_hz},
             .values = columns[c]});
        if (kind == analysis::DataKind::phase) axis.phase_arcsec = std::move(columns[c]);
        std::vector<double>{}.swap(columns[c]);
        if (on_table)
            input.tables.push_back(table_test(config.analysis, axis, table_rates));
        else
            input.axes.push_back(std::move(axis));
    }
    return config;
}

config::Config read_one(const Options& options, const std::string& path, AnalysisInput& input) {
    switch (logs::recognise(path)) {
        case logs::LogKind::raw_csv:
        case logs::LogKind::raw_hdf5:
            return read_raw(options, path, input.axes);
        case logs::LogKind::angle_csv:
        case logs::LogKind::angle_hdf5:
            return read_angles(options, path, input.axes);
        case logs::LogKind::unknown:
            break;
    }
    return read_text(options, path, input);
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
    // Three files of one axis each, whose errors are no axes, are those of one unit.
    const auto n = std::ranges::count(input.axes, false, &study::AxisRecord::is_error);
    if (paths.size() == 3 && n == 3 && one_axis_each(input.axes))
        for (study::AxisRecord& axis : input.axes)
            if (!axis.is_error) axis.group = "the three files";
    return input;
}

}  // namespace zlg::cli
