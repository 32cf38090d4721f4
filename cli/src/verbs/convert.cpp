#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/matlab_copy.hpp>
#include <zlg/logs/raw_log.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/interrupt.hpp"
#include "src/log_settings.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct ConvertOptions : Options {
    std::string file;
};

void warn(const ConvertOptions& options, const std::vector<std::string>& warnings, bool complete) {
    for (const std::string& warning : warnings) complain("warning: " + warning);
    if (!complete)
        complain(fmt::format("warning: {}: was not closed by its writer; its whole rows are taken", options.file));
}

// Nothing is invented: what the log does not say, the copy does not say either.
void warn_of_absent(const ConvertOptions& options, const config::Settings& settings,
                    std::initializer_list<std::string_view> facts) {
    for (const std::string_view fact : facts)
        if (!says(settings, fact))
            complain(fmt::format("warning: {}: does not say {}, nor does the copy", options.file, fact));
}

// Every row, into any copy of it; how many there were.
template <class Row, class Reader, class Write> std::int64_t copy_rows(Reader& log, const Write& write) {
    Progress progress;
    Row row;
    std::int64_t rows = 0;
    while (log.next(row)) {
        write(row);
        if (++rows % 100'000 == 0) {
            check_interrupt();
            progress.show(log.fraction_read());
        }
    }
    return rows;
}

template <class Copy> std::int64_t copy_raw(const ConvertOptions& options, logs::RawReader& raw, Copy& copy) {
    const std::int64_t rows =
        copy_rows<core::HalfRecord>(raw, [&](const core::HalfRecord& record) { copy.write(record, raw.light()); });
    if (!raw.line_is_ended())
        complain(fmt::format("warning: {}: the last line has no end; the file may have been cut off", options.file));
    copy.close();
    return rows;
}

std::int64_t convert_raw(const ConvertOptions& options, std::optional<logs::LogFormat> format) {
    logs::RawReader raw{options.file};
    const logs::RawHeader& header = raw.header();
    warn(options, header.warnings, header.complete);
    warn_of_absent(options, header.settings, {"tick_s", "scale_arcsec"});
    if (!format) {
        logs::MatlabCopy<logs::RawTable> copy{options.out, header, options.force};
        return copy_raw(options, raw, copy);
    }
    logs::RawWriterOptions copied = copied_light(header, options.file, *format);
    copied.has_fingerprint = !header.fingerprint.empty();
    copied.format_version = header.format_version;
    logs::RawWriter copy{options.out, header.settings, options.force, header, copied};
    if (copied.has_fingerprint) copy.set_fingerprint(header.fingerprint);
    return copy_raw(options, raw, copy);
}

double logged_tick_s(const logs::AngleHeader& header, const ConvertOptions& options) {
    if (!says(header.settings, "tick_s")) return std::numeric_limits<double>::quiet_NaN();
    return load_log_config(options, header.settings, options.file, LogFacts::none).gyro.tick_s;
}

std::int64_t convert_angles(const ConvertOptions& options, std::optional<logs::LogFormat> format) {
    logs::AngleReader angles{options.file};
    const logs::AngleHeader& header = angles.header();
    warn(options, header.warnings, header.complete);
    warn_of_absent(options, header.settings, {"tick_s"});
    if (!format) {
        logs::MatlabCopy<logs::AngleTable> copy{options.out, header, options.force};
        const std::int64_t rows =
            copy_rows<logs::TimedAngle>(angles, [&copy](const logs::TimedAngle& angle) { copy.write(angle); });
        copy.close();
        return rows;
    }
    const bool with_truth = header.has_truth && *format == logs::LogFormat::hdf5;
    if (header.has_truth && !with_truth)
        complain(fmt::format("warning: {}: /truth stays behind, a CSV log holds none", options.file));
    const bool with_fingerprint = !header.fingerprint.empty();
    logs::AngleWriter copy{
        options.out,
        logged_tick_s(header, options),
        header.settings,
        options.force,
        {.has_truth = with_truth, .has_fingerprint = with_fingerprint, .format_version = header.format_version}};
    if (with_fingerprint) copy.set_fingerprint(header.fingerprint);
    const std::int64_t rows =
        copy_rows<logs::TimedAngle>(angles, [&copy](const logs::TimedAngle& angle) { copy.write_timed(angle); });
    copy.close();
    return rows;
}

std::int64_t convert_rows(const ConvertOptions& options, std::optional<logs::LogFormat> format) {
    const logs::LogKind kind = logs::recognise(options.file);
    if (is_raw(kind)) return convert_raw(options, format);
    if (is_angles(kind)) return convert_angles(options, format);
    const std::string nature = logs::foreign_nature(options.file);
    throw logs::FormatError{fmt::format("{}: neither a raw log nor an angle log{}", options.file,
                                        nature.empty() ? "" : "; it is " + nature)};
}

// Of the copy; nothing for MATLAB's.
std::optional<logs::LogFormat> format_of_copy(const std::string& out) {
    if (out.empty())
        throw UsageError{"--out is missing: name the file to write, with the suffix .csv, .h5, .hdf5 or .mat"};
    if (out.ends_with(".mat")) return std::nullopt;
    return log_format(out);
}

void convert(const ConvertOptions& options) {
    const std::optional<logs::LogFormat> format = format_of_copy(options.out);
    refuse_own_input(options.file, options.out);
    const std::int64_t rows = convert_rows(options, format);
    if (options.json)
        print(pretty(nlohmann::json{{"file", options.file}, {"out", options.out}, {"rows", rows}}));
    else
        print(fmt::format("{}: {} rows\n", printable(options.out), rows));
}

}  // namespace

void add_convert(CLI::App& program) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App* verb = program.add_subcommand(
        "convert", "a raw or angle log in the other format, or for MATLAB, every value the same");
    verb->add_option("FILE", options->file, "raw or angle log, CSV or HDF5")->required();
    add_output_options(*verb, *options);
    verb->callback([options] { convert(*options); });
}

}  // namespace zlg::cli
