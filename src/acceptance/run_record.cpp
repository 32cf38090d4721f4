#include "run_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/content_hash.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/imported.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/recorded/log_compensation.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/axis_records.hpp>
#include <zlg/text/escape.hpp>

#include "switch_reader.hpp"

namespace zlg::acceptance {
namespace {

namespace fs = std::filesystem;
using logs::LogKind;

std::string file_name(const std::string& path) { return fs::path{path}.filename().string(); }

bool is_raw(LogKind kind) { return kind == LogKind::raw_csv || kind == LogKind::raw_hdf5; }
bool is_angles(LogKind kind) { return kind == LogKind::angle_csv || kind == LogKind::angle_hdf5; }

bool is_mapped(const Run& run) {
    const auto keys = run.mapping.keys_set();
    return std::ranges::any_of(keys, [](const std::string& key) { return key != "axis"; });
}

// Beside the plan, unless the name says where.
std::string path_of(const Plan& plan, const std::string& file) {
    return (fs::path{plan.path}.parent_path() / file).lexically_normal().string();
}

std::string bare(const std::string& serial) {
    std::string text;
    for (const char c : serial)
        if (c != '"' && c != '\'' && c != ' ') text += c;
    return text;
}

void require_serial(const Plan& plan, const std::string& found, const std::string& where) {
    if (bare(found) == bare(plan.unit.serial)) return;
    throw config::ConfigError(fmt::format("{}: is of the gyro with serial '{}', the plan is of '{}'", where,
                                          text::excerpt(found, 60, ' '), text::excerpt(plan.unit.serial, 60, ' ')));
}

// A gyro is no more than that off its nominal scale: else one of the two is of another.
void require_scale(const Plan& plan, double found_arcsec, const std::string& where) {
    constexpr double apart = 0.01;
    const auto& nominal = plan.unit.scale_arcsec;
    if (!nominal || std::abs(found_arcsec / *nominal - 1.0) <= apart) return;
    throw config::ConfigError(
        fmt::format("{}: a count is {:g} arcsec there, and {:g} by scale_arcsec of [unit]; "
                    "allowed is one scale, to 1 %",
                    where, found_arcsec, *nominal));
}

void check_serial(const Plan& plan, const logs::Settings& settings, const std::string& path) {
    for (const auto& [key, value] : settings) {
        const std::string last = key.substr(key.find_last_of('.') + 1);
        if (last == "serial" || last == "serial_number") require_serial(plan, value, path);
    }
}

// "Serial number: 17", "S/N;17", "Scale factor: 3.26 arcsec/count" above the columns.
void check_head(const Plan& plan, const std::vector<std::string>& head, const std::string& path) {
    static const std::regex serial{
        R"((?:^|[^a-z])(?:serial(?:[ _]?(?:number|no\.?|nr\.?))?|s/n)\s*[:=;,\t]\s*"?([^\s;,"]+))", std::regex::icase};
    static const std::regex scale{
        R"((?:scale|lsb|count|pulse)[^0-9]{0,40}([0-9]+(?:[.,][0-9]+)?(?:e[+-]?[0-9]+)?)\s*(?:arc[ -]?sec|"|''))",
        std::regex::icase};
    for (const std::string& line : head) {
        std::smatch found;
        const std::string start = line.substr(0, 400);
        if (std::regex_search(start, found, serial)) require_serial(plan, found[1], path);
        if (!std::regex_search(start, found, scale)) continue;
        std::string number = found[1];
        std::ranges::replace(number, ',', '.');
        require_scale(plan, std::strtod(number.c_str(), nullptr),
                      fmt::format("{}, '{}'", path, text::excerpt(line, 60, ' ')));
    }
}

void add(std::vector<std::string>& to, const std::string& path, const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
        to.push_back(line.starts_with(path) ? file_name(path) + line.substr(path.size())
                                            : fmt::format("{}: {}", file_name(path), line));
}

config::Config log_config(const Plan& plan, const config::Config& said, const logs::Settings& settings,
                          const std::string& path, bool scale_is_used) {
    check_serial(plan, settings, path);
    config::Config over = said;
    const bool says_scale = std::ranges::any_of(
        settings, [](const auto& pair) { return pair.first == "scale_arcsec" || pair.first == "gyro.scale_arcsec"; });
    if (plan.unit.scale_arcsec && !says_scale && !config::is_given(over, "gyro.scale_arcsec"))
        config::apply_pair(over, "gyro.scale_arcsec", fmt::format("{}", *plan.unit.scale_arcsec), plan.path);
    config::Config config = recorded::config_of_log(over, settings, path, scale_is_used);
    if (says_scale) require_scale(plan, config.gyro.scale_arcsec, path);
    return config;
}

// Values that may be no measurements, and holes, stop the verdicts. The gap of a switch is none.
void look_at(const study::AxisRecord& axis, const std::string& path, RunRecord& record) {
    add(record.stops, path, axis.warnings);
    const std::size_t of_switch = axis.mode.empty() ? 0 : core::max_estimated_gap;
    std::size_t missing = 0, gap = 0;
    for (const double rate : axis.rates_arcsec_s) {
        gap = std::isfinite(rate) ? 0 : gap + 1;
        if (gap > of_switch) missing += gap == of_switch + 1 ? gap : 1;
    }
    if (missing * 100 > axis.rates_arcsec_s.size())
        add(record.stops, path,
            {fmt::format("{} of {} samples are missing; allowed is one in 100", missing, axis.rates_arcsec_s.size())});
}

void finish(study::TickRates& ticks, const std::string& path, RunRecord& record) {
    const std::size_t first = record.axes.size();
    ticks.finish(record.axes);
    look_at(record.axes[first], path, record);
}

void read_angles(const Plan& plan, const config::Config& said, const std::string& path, RunRecord& record) {
    logs::AngleReader reader{path};
    add(record.notes, path, reader.header().warnings);
    const config::Config config = log_config(plan, said, reader.header().settings, path, false);
    study::TickRates ticks{path, config.gyro.tick_s};
    logs::TimedAngle angle;
    double first_s = 0.0;
    for (bool is_first = true; reader.next(angle); is_first = false) {
        if (is_first) first_s = angle.t_s;
        ticks.take(angle.row);
    }
    if (ticks.empty()) throw logs::FormatError{fmt::format("{}: holds no tick", path)};
    study::check_tick(path, config.gyro.tick_s, first_s, angle);
    if (!reader.header().complete) add(record.stops, path, {"was not closed by its writer"});
    finish(ticks, path, record);
    record.configs.push_back(config);
}

// One a tick; NaN where the log lacks it.
void keep_temperature(const core::HalfRecord& half, std::vector<double>& temperature_c,
                      std::optional<std::int64_t>& first_tick) {
    const std::int64_t tick = half.half / 2;
    if (!first_tick) first_tick = tick;
    temperature_c.resize(static_cast<std::size_t>(tick - *first_tick + 1), std::numeric_limits<double>::quiet_NaN());
    temperature_c.back() = half.temperature_c;
}

void read_raw(const Plan& plan, const config::Config& said, const std::string& path, RunRecord& record) {
    logs::RawReader raw = open_raw(*record.run, path, record.notes);
    add(record.notes, path, raw.header().warnings);
    const config::Config config = log_config(plan, said, raw.header().settings, path, true);
    const recorded::LogCompensation asked = recorded::log_compensation(config, raw.header(), path);
    for (const auto* lines : {&asked.notes, &asked.warnings}) add(record.notes, path, *lines);
    if (!asked.presumed.empty()) add(record.notes, path, {asked.presumed});
    study::TickRates ticks{path, config.gyro.tick_s};
    rig::Replay replay{asked.compensation};
    SwitchReader switches{asked.config};
    const auto on_row = [&](const core::AngleRow& row) {
        ticks.take(row);
        switches.take(row);
    };
    const auto on_gap = [&](const core::GapReport& gap) { switches.take(gap); };
    const bool warms = record.run->kind == RunKind::temperature && raw.header().has_temperature;
    std::vector<double> temperature_c;
    std::optional<std::int64_t> first_tick;
    core::HalfRecord half;
    while (raw.next(half)) {
        switches.take(half);
        if (warms) keep_temperature(half, temperature_c, first_tick);
        replay.take(half, raw.light(), on_row, on_gap);
    }
    replay.end(on_row, on_gap);
    recorded::require_a_tick(replay, path);
    add(record.stops, path, replay.contradictions(path));
    if (!raw.header().complete) add(record.stops, path, {"was not closed by its writer"});
    const std::size_t axis = record.axes.size();
    finish(ticks, path, record);
    record.axes[axis].temperature_c = std::move(temperature_c);
    record.switches.push_back(switches.finish());
    record.raw_logs.push_back(path);
    record.configs.push_back(asked.config);
}

void read_axes(const Plan& plan, const logs::ForeignLook& look, RunRecord& record) {
    const std::string& path = look.table.path;
    check_head(plan, look.table.head, path);
    if (const auto scale = look.mapping.real("scale_arcsec")) require_scale(plan, *scale, record.run->place);
    for (const auto* lines : {&look.table.notes, &look.said}) add(record.notes, path, *lines);
    logs::ImportedAxes imported = logs::imported_axes(look);
    add(record.notes, path, imported.notes);
    if (imported.axes.size() != 1)
        throw config::ConfigError(
            fmt::format("{}: {} axes; a unit has one: axis = COLUMN", record.run->place, imported.axes.size()));
    study::AxisRecord axis = study::axis_of(path, std::move(imported.axes.front()));
    look_at(axis, path, record);
    axis.temperature_c = std::move(imported.temperature_c);
    record.axes.push_back(std::move(axis));
    record.table_rates_arcsec_s = std::move(imported.table_rates_arcsec_s);
}

}  // namespace

logs::RawReader open_raw(const Run& run, const std::string& path, std::vector<std::string>& notes) {
    if (!is_mapped(run) && logs::recognise(path) != LogKind::unknown) return logs::RawReader{path};
    logs::ImportedRaw made = logs::imported_raw(logs::look_at_foreign(path, run.mapping));
    for (const auto* lines : {&made.notes, &made.warnings}) add(notes, path, *lines);
    return {path, std::move(made.header), std::move(made.rows)};
}

RunRecord read_run(const Plan& plan, const Run& run, const config::Config& said) {
    RunRecord record{.run = &run};
    if (!run.serial.empty()) require_serial(plan, run.serial, run.place);
    std::vector<std::string> foreign;
    for (const std::string& file : run.files) {
        const std::string path = path_of(plan, file);
        const LogKind kind = is_mapped(run) ? LogKind::unknown : logs::recognise(path);
        record.logs.push_back({.file = file, .checksum = logs::hash_of_file(path)});
        if (is_angles(kind))
            read_angles(plan, said, path, record);
        else if (is_raw(kind))
            read_raw(plan, said, path, record);
        else
            foreign.push_back(path);
    }
    if (foreign.empty()) return record;
    if (foreign.size() != run.files.size())
        throw config::ConfigError(
            fmt::format("{}: files of other programs and logs of zlg together; allowed is one kind a run", run.place));
    const logs::ForeignLook look = logs::look_at_foreign(foreign, run.mapping);
    if (look.makes == logs::Makes::axes) {
        read_axes(plan, look, record);
    } else {
        for (const std::string& path : foreign) read_raw(plan, said, path, record);
    }
    return record;
}

}  // namespace zlg::acceptance
