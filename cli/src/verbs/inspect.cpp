#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/motion.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/log_settings.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

struct InspectOptions : Options {
    std::string file;
    bool repair = false;
};

struct RawFindings {
    std::int64_t halves = 0;
    std::int64_t open_halves = 0;
    std::int64_t invalid_halves = 0;
    std::int64_t gaps = 0;
    std::int64_t mode_changes = 0;
    std::string damage;  // empty: none

    void take(const core::HalfRecord& r) {
        const bool measured = is_measured(r);
        // A gap is counted by ticks: the second half of a tick belongs to the gap of the first.
        const bool new_tick = r.half % 2 == 0;
        if (new_tick) {
            tick_was_gap_ = tick_is_gap_;
            tick_is_gap_ = false;
        }
        if (!measured && !tick_is_gap_) {
            tick_is_gap_ = true;
            if (!tick_was_gap_) ++gaps;
        }
        if (halves > 0 && r.mode != mode_) ++mode_changes;
        mode_ = r.mode;
        open_halves += r.loop_closed ? 0 : 1;
        invalid_halves += r.valid ? 0 : 1;
        ++halves;
    }

private:
    bool tick_is_gap_ = false;
    bool tick_was_gap_ = false;
    int mode_ = 0;
};

std::vector<std::string> optional_columns(const logs::RawHeader& header) {
    std::vector<std::string> columns;
    logs::for_each_column<logs::RawTable>([&]<class Column>(const Column& column, std::size_t) {
        if (Column::is_optional && column.is_in(header)) columns.emplace_back(column.name);
    });
    return columns;
}

bool next_undamaged(logs::RawReader& reader, core::HalfRecord& record, RawFindings& found) {
    try {
        return reader.next(record);
    } catch (const logs::FormatError& error) {
        found.damage = error.what();
        return false;
    }
}

// Of a log whose rows are all good.
std::string end_damage(const std::string& path, bool complete) {
    if (complete) return "";
    return fmt::format("{}: was not closed by its writer, which still writes or was interrupted", path);
}

// Read to the end or to the first damage; whole rows before it go to `copy`, if there is one.
RawFindings read_raw(logs::RawReader& reader, const std::string& path, logs::RawWriter* copy) {
    RawFindings found;
    core::HalfRecord record;
    while (next_undamaged(reader, record, found)) {
        found.take(record);
        if (copy) copy->write(record, reader.light());
    }
    if (found.damage.empty()) found.damage = end_damage(path, reader.header().complete);
    return found;
}

// Where a repaired log goes when no name is given: x.h5 and x.h5.part become x.repaired.h5.
std::string repaired_path(const InspectOptions& options) {
    if (!options.out.empty()) return options.out;
    std::filesystem::path file{options.file};
    if (file.extension() == ".part") file.replace_extension();
    return std::filesystem::path{file}.replace_extension(fmt::format(".repaired{}", file.extension().string()));
}

// A fact that the log gives; null where it does not.
json fact(const config::Settings& settings, std::string_view name, double value) {
    return says(settings, name) ? json(value) : json(nullptr);
}

// Of the run whose log it is; null where the log does not say it.
json fingerprint_json(const std::string& fingerprint) {
    return fingerprint.empty() ? json(nullptr) : json(fingerprint);
}

// null where the log does not say it.
json optional_json(const std::optional<int>& number) { return number ? json(*number) : json(nullptr); }

json raw_json(const InspectOptions& options, const logs::RawHeader& header, const LogSettings& log,
              const RawFindings& f) {
    const config::Gyro& gyro = log.config.gyro;
    const json tick_s = fact(log.good, "tick_s", gyro.tick_s);
    return {{"file", options.file},
            {"kind", "raw"},
            {"halves", f.halves},
            {"ticks", f.halves / 2},
            {"tick_s", tick_s},
            {"scale_arcsec", fact(log.good, "scale_arcsec", gyro.scale_arcsec)},
            {"duration_s", tick_s.is_null() ? json(nullptr) : json(static_cast<double>(f.halves / 2) * gyro.tick_s)},
            {"optional_columns", optional_columns(header)},
            {"settings", header.settings.size()},
            {"light_samples", header.light_samples},
            {"light_beams", header.light_samples == 0 ? 0
                            : header.has_light_b      ? 2
                                                      : 1},
            {"gaps", f.gaps},
            {"mode_changes", f.mode_changes},
            {"open_halves", f.open_halves},
            {"invalid_halves", f.invalid_halves},
            {"fingerprint", fingerprint_json(header.fingerprint)},
            {"format_version", optional_json(header.format_version)},
            {"damage", f.damage.empty() ? json(nullptr) : json(f.damage)}};
}

struct AngleFindings {
    std::int64_t ticks = 0;
    double end_s = 0.0;
    std::array<std::int64_t, core::angle_flag_names.size()> flagged{};
    std::string damage;
};

json angle_json(const InspectOptions& options, const logs::AngleHeader& header, const LogSettings& log,
                const AngleFindings& f) {
    json flags = json::object();
    for (std::size_t bit = 0; bit < f.flagged.size(); ++bit) flags[core::angle_flag_names[bit]] = f.flagged[bit];
    return {{"file", options.file},
            {"kind", "angles"},
            {"ticks", f.ticks},
            {"duration_s", f.end_s},
            {"final_delay_ticks",
             optional_json(header.format_version == logs::format_version ? final_delay_ticks(log) : std::nullopt)},
            {"flagged_ticks", flags},
            {"fingerprint", fingerprint_json(header.fingerprint)},
            {"format_version", optional_json(header.format_version)},
            {"damage", f.damage.empty() ? json(nullptr) : json(f.damage)}};
}

AngleFindings read_angles(logs::AngleReader& reader, const std::string& path) {
    AngleFindings found;
    logs::TimedAngle angle;
    try {
        while (reader.next(angle)) {
            ++found.ticks;
            found.end_s = angle.t_s;
            for (std::size_t bit = 0; bit < found.flagged.size(); ++bit)
                if (angle.row.flags & (1u << bit)) ++found.flagged[bit];
        }
    } catch (const logs::FormatError& error) {
        found.damage = error.what();
    }
    if (found.damage.empty()) found.damage = end_damage(path, reader.header().complete);
    return found;
}

// Nested values one per line, in the order of the names.
std::string as_text(const json& findings) {
    std::string text;
    for (const auto& [key, value] : findings.items()) {
        const bool is_fact = key == "tick_s" || key == "scale_arcsec";
        if (value.is_null() && !is_fact) continue;
        if (value.is_null()) {
            text += fmt::format("{:<18} not given\n", key);
        } else if (value.is_object()) {
            for (const auto& [name, n] : value.items())
                if (n != 0) text += fmt::format("{:<18} {}: {}\n", key, name, n.dump());
        } else {
            text +=
                fmt::format("{:<18} {}\n", key, value.is_string() ? printable(value.get<std::string>()) : value.dump());
        }
    }
    return text;
}

// A file that was cut at the end of a row looks whole, and says what the whole run was.
void warn_of_missing(const LogSettings& log, std::int64_t ticks, const std::string& path) {
    const std::optional<double>& duration_s = log.config.run.duration_s;
    if (!duration_s || fact(log.good, "tick_s", 0.0).is_null() || *duration_s < log.config.gyro.tick_s) return;
    const std::int64_t said = rig::run_ticks(log.config, twin::Motion::rest());
    if (ticks >= said) return;
    complain(
        fmt::format("warning: {}: holds {} ticks, its settings (run.duration_s = {}) say {}; the file may have been "
                    "cut off",
                    path, ticks, *duration_s, said));
}

void repair(const InspectOptions& options, logs::RawReader& reader, const config::Settings& settings,
            RawFindings& found, const std::string& out) {
    logs::RawWriterOptions copied = copied_light(reader.header(), options.file, log_format(out));
    copied.format_version = reader.header().format_version;
    refuse_own_input(options.file, out);
    logs::RawWriter copy{out, settings, options.force, reader.header(), copied};
    found = read_raw(reader, options.file, &copy);
    if (found.halves == 0) throw logs::FormatError{fmt::format("nothing to repair: {}", found.damage)};
    copy.close();
}

json inspect_raw(const InspectOptions& options) {
    logs::RawReader reader{options.file};
    for (const std::string& warning : reader.header().warnings) complain("warning: " + warning);
    const LogSettings log = understood(options, reader.header().settings, options.file);
    note_former_keys(log.good, options.file);
    const std::string out = options.repair ? repaired_path(options) : "";
    RawFindings found;
    if (options.repair)
        repair(options, reader, log.good, found, out);
    else
        found = read_raw(reader, options.file, nullptr);
    if (found.damage.empty() && !reader.line_is_ended())
        complain(fmt::format("warning: {}: the last line has no end; the file may have been cut off", options.file));
    if (found.damage.empty()) found.damage = log.damage;
    if (found.damage.empty()) warn_of_missing(log, found.halves / 2, options.file);
    json findings = raw_json(options, reader.header(), log, found);
    if (options.repair) findings["repaired"] = out;
    return findings;
}

json inspect_angles(const InspectOptions& options) {
    if (options.repair)
        throw UsageError{fmt::format(
            "--repair {}: is an angle log; allowed is a raw log. zlg convert copies the whole rows of an angle log",
            options.file)};
    logs::AngleReader reader{options.file};
    const AngleFindings found = read_angles(reader, options.file);
    note_former_keys(reader.header().settings, options.file);
    LogSettings log;
    if (found.damage.empty()) log = understood(options, reader.header().settings, options.file);
    warn_of_missing(log, found.ticks, options.file);
    return angle_json(options, reader.header(), log, found);
}

json inspect_log(const InspectOptions& options) {
    const logs::LogKind kind = logs::recognise(options.file);
    if (is_raw(kind)) return inspect_raw(options);
    if (is_angles(kind)) return inspect_angles(options);
    const std::string nature = logs::foreign_nature(options.file);
    throw logs::FormatError{fmt::format("{}: neither a raw log nor an angle log{}; zlg import says what is in it",
                                        options.file, nature.empty() ? "" : ", but " + nature)};
}

void inspect(const InspectOptions& options) {
    const json findings = inspect_log(options);
    print(options.json ? pretty(findings) : as_text(findings));
    if (!findings["damage"].is_null() && !options.repair) throw CLI::RuntimeError{result_says_no};
}

}  // namespace

void add_inspect(CLI::App& program) {
    const auto options = std::make_shared<InspectOptions>();
    CLI::App* verb = program.add_subcommand("inspect", "what is in a log: columns, time span, flags, damage");
    verb->add_option("FILE", options->file, "raw or angle log")->required();
    verb->add_flag("--repair", options->repair,
                   "write the whole rows before the first damage to --out, or beside it as NAME.repaired");
    add_output_options(*verb, *options);
    verb->callback([options] { inspect(*options); });
}

}  // namespace zlg::cli
