#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/imported.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/logs/table_file.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/interrupt.hpp"
#include "src/mapping_input.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct ImportOptions : Options {
    std::vector<std::string> files;
    std::string write_mapping;

    [[nodiscard]] const std::string& file() const { return files.front(); }
};

std::string text_of(const logs::ForeignLook& look) {
    std::string text = fmt::format("{}: {}\n", printable(look.table.path), printable(look.table.nature));
    if (look.table.n_rows) text += fmt::format("{} rows\n", *look.table.n_rows);
    for (std::size_t c = 0; c < look.table.columns.size(); ++c) {
        const logs::ForeignColumn& column = look.table.columns[c];
        text += fmt::format("  {:<34} first {:<22} {}\n", printable(logs::described(column)), printable(column.first),
                            look.may_be[c]);
    }
    for (const std::string& note : look.table.notes) text += fmt::format("note: {}\n", printable(note));
    for (const std::string& line : look.said) text += fmt::format("{}\n", printable(line));
    for (const std::string& line : look.missing) text += fmt::format("missing: --map {}\n", printable(line));
    if (look.missing.empty())
        text += fmt::format("nothing is missing: --out makes {} of it\n",
                            look.makes == logs::Makes::raw ? "a raw log" : "an angle log");
    return text;
}

nlohmann::json json_of(const logs::ForeignLook& look) {
    nlohmann::json columns = nlohmann::json::array();
    for (std::size_t c = 0; c < look.table.columns.size(); ++c) {
        const logs::ForeignColumn& column = look.table.columns[c];
        columns.push_back(
            {{"number", column.number}, {"name", column.name}, {"first", column.first}, {"may_be", look.may_be[c]}});
    }
    return {{"file", look.table.path},
            {"is", look.table.nature},
            {"columns", columns},
            {"notes", look.table.notes},
            {"said", look.said},
            {"missing", look.missing},
            {"makes", look.makes == logs::Makes::raw ? "raw" : "angles"}};
}

// A log whose tick or scale the readers refuse is none.
void require_readable(const ImportOptions& options, const config::Settings& settings) {
    config::Config config;
    try {
        config::apply_log(config, settings, options.out);
    } catch (const config::ConfigError& error) {
        throw UsageError{fmt::format("{}, by --map rate_hz, tick_s or scale_arcsec, or by the times", error.what())};
    }
}

std::size_t write_raw(const ImportOptions& options, const logs::ForeignLook& look, std::vector<std::string>& warnings) {
    const logs::ImportedRaw made = logs::imported_raw(look);
    note_all(options.file(), made.notes);
    warnings = made.warnings;
    note_all(options.file(), warnings);
    require_readable(options, made.header.settings);
    // Read once through the rules of a raw log, which name what is wrong.
    logs::RawReader rows{options.file(), made.header, made.rows};
    logs::RawWriter log{options.out, made.header.settings, options.force, made.header, {}};
    core::HalfRecord row;
    while (rows.next(row)) {
        if (row.half % 100'000 == 0) check_interrupt();
        log.write(row);
    }
    log.close();
    return made.rows.size();
}

std::size_t write_angles(const ImportOptions& options, const logs::ForeignLook& look,
                         std::vector<std::string>& warnings) {
    const logs::ImportedAxes made = logs::imported_axes(look);
    if (made.axes.size() != 1)
        throw UsageError{
            fmt::format("{}: {} axes; an angle log holds one: --map axis=COLUMN (zlg analyze takes several)",
                        options.file(), made.axes.size())};
    note_all(options.file(), made.notes);
    const logs::ImportedAxis& axis = made.axes.front();
    warnings = axis.warnings;
    note_all(options.file(), warnings);
    if (!made.temperature_c.empty())
        throw UsageError{"--map temperature_c: an angle log holds no temperature; allowed is to leave it out"};
    complain(fmt::format("note: {}: {}, {}", name_of_file(options.file()), axis.name, axis.holds));
    const double tick_s = 1.0 / axis.rate_hz;
    const config::Settings settings{{"gyro.tick_s", fmt::format("{}", tick_s)}};
    require_readable(options, settings);
    logs::AngleWriter log{options.out, tick_s, settings, options.force, {}};
    const std::int64_t n = logs::angle_rows(axis, [&](const core::AngleRow& row) {
        if (row.tick % 100'000 == 0) check_interrupt();
        log.write(row);
    });
    log.close();
    return static_cast<std::size_t>(n);
}

// Without a log that is written.
std::vector<std::string> warnings_of(const ImportOptions& options, const logs::ForeignLook& look) {
    std::vector<std::string> warnings;
    if (look.makes == logs::Makes::raw)
        warnings = logs::imported_raw(look).warnings;
    else
        for (const logs::ImportedAxis& axis : logs::imported_axes(look).axes)
            warnings.insert(warnings.end(), axis.warnings.begin(), axis.warnings.end());
    note_all(options.file(), warnings);
    return warnings;
}

void import(const ImportOptions& options) {
    if (!options.out.empty()) {
        (void)log_format(options.out);
        for (const std::string& file : options.files) refuse_own_input(file, options.out);
    }
    if (!options.write_mapping.empty()) {
        require_suffix(options.write_mapping, ".toml");
        for (const std::string& file : options.files) refuse_own_input(file, options.write_mapping, "--write-mapping");
    }
    const logs::ForeignLook look = look_at(options, options.files);
    std::size_t rows = 0;
    std::vector<std::string> warnings;
    // Values are looked at where all is known that makes rows of them.
    if (!options.out.empty() || options.strict) logs::require_whole(look);
    if (options.out.empty() && options.strict) warnings = warnings_of(options, look);
    if (!options.out.empty()) {
        note_all(options.file(), look.table.notes);
        note_all(options.file(), look.said);
        rows =
            look.makes == logs::Makes::raw ? write_raw(options, look, warnings) : write_angles(options, look, warnings);
    }
    if (!options.write_mapping.empty()) {
        std::string toml = look.mapping.toml();
        for (const std::string& missing : look.missing) toml += fmt::format("# missing: {}\n", printable(missing));
        write_file(options.write_mapping, toml, options.force);
    }
    if (options.json) {
        nlohmann::json json = json_of(look);
        json["out"] = options.out.empty() ? nlohmann::json(nullptr) : nlohmann::json(options.out);
        json["rows"] = rows;
        json["warnings"] = warnings;
        print(pretty(json));
    } else {
        print(options.out.empty() ? text_of(look) : fmt::format("{}: {} rows\n", printable(options.out), rows));
    }
    refuse_warnings(options, warnings.size());
}

void print_mapping_keys() {
    print(logs::mapping_keys_text());
    throw CLI::Success{};
}

}  // namespace

void add_import(CLI::App& program) {
    const auto options = std::make_shared<ImportOptions>();
    CLI::App* verb = program.add_subcommand(
        "import",
        "a file of another program as a log; without --out it only says what it understood, and what is missing");
    verb->add_option("FILE", options->files,
                     "text, HDF5, MATLAB, NumPy, rows of doubles, MCAP, or a ROS 1 bag; several are one record, in "
                     "their order")
        ->required();
    add_mapping_options(*verb, *options);
    add_strict_option(*verb, *options);
    verb->add_option("--write-mapping", options->write_mapping,
                     "write what was said and understood as TOML, for --mapping of process, analyze and calibrate");
    verb->add_flag_callback("--keys", print_mapping_keys, "every key of a mapping")->trigger_on_parse();
    add_output_options(*verb, *options);
    verb->callback([options] { import(*options); });
}

}  // namespace zlg::cli
