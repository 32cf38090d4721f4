
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>

#include "as_json.hpp"
#include "failure.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output.hpp"
#include "verbs.hpp"

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

std::int64_t convert_raw(const ConvertOptions& options, logs::LogFormat format) {
    const Interruptible interruptible;
    logs::RawReader raw{options.file};
    const logs::RawHeader& header = raw.header();
    warn(options, header.warnings, header.complete);
    const logs::RawWriterOptions copied = copied_light(header, options.file, format);
    logs::RawWriter copy{options.out, header.settings, options.force, header, copied};
    Progress progress;
    core::HalfRecord record;
    std::int64_t rows = 0;
    while (raw.next(record)) {
        copy.write(record, raw.light());
        if (++rows % 100'000 == 0) {
            interruptible.check();
            progress.show(raw.fraction_read());
        }
    }
    if (!raw.line_is_ended())
        complain(fmt::format("warning: {}: the last line has no end; the file may have been cut off", options.file));
    copy.close();
    return rows;
}

double logged_tick_s(const logs::AngleHeader& header, const ConvertOptions& options) {
    return load_log_config(options, header.settings, options.file).gyro.tick_s;
}

std::int64_t convert_angles(const ConvertOptions& options, logs::LogFormat format) {
    const Interruptible interruptible;
    logs::AngleReader angles{options.file};
    const logs::AngleHeader& header = angles.header();
    warn(options, header.warnings, header.complete);
    const bool with_truth = header.has_truth && format == logs::LogFormat::hdf5;
    if (header.has_truth && !with_truth)
        complain(fmt::format("warning: {}: /truth stays behind, a CSV log holds none", options.file));
    logs::AngleWriter copy{
        options.out, logged_tick_s(header, options), header.settings, options.force, {.has_truth = with_truth}};
    Progress progress;
    logs::TimedAngle angle;
    std::int64_t rows = 0;
    while (angles.next(angle)) {
        copy.write_timed(angle);
        if (++rows % 100'000 == 0) {
            interruptible.check();
            progress.show(angles.fraction_read());
        }
    }
    copy.close();
    return rows;
}

std::int64_t convert_rows(const ConvertOptions& options, logs::LogFormat format) {
    switch (logs::recognise(options.file)) {
        case logs::LogKind::raw_csv:
        case logs::LogKind::raw_hdf5:
            return convert_raw(options, format);
        case logs::LogKind::angle_csv:
        case logs::LogKind::angle_hdf5:
            return convert_angles(options, format);
        case logs::LogKind::unknown:
            break;
    }
    throw logs::FormatError{fmt::format("{}: neither a raw log nor an angle log", options.file)};
}

void convert(const ConvertOptions& options) {
    const logs::LogFormat format = log_format(options.out);
    refuse_own_input(options.file, options.out);
    const std::int64_t rows = convert_rows(options, format);
    if (options.json)
        print(pretty(nlohmann::json{{"file", options.file}, {"out", options.out}, {"rows", rows}}));
    else
        print(fmt::format("{}: {} rows\n", options.out, rows));
}

}  // namespace

void add_convert(CLI::App& program) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App* verb = program.add_subcommand("convert", "a raw or angle log in the other format, every value the same");
    verb->add_option("FILE", options->file, "raw or angle log, CSV or HDF5")->required();
    add_output_options(*verb, *options);
    verb->callback([options] { convert(*options); });
}

}  // namespace zlg::cli
