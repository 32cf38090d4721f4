#include <memory>
#include <span>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/core/health.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/run.hpp>
#include <zlg/study/run_page.hpp>
#include <zlg/study/what_happened.hpp>
#include <zlg/twin/motion.hpp>

#include "lab_page.hpp"
#include "src/as_json.hpp"
#include "src/cost.hpp"
#include "src/failure.hpp"
#include "src/fields_json.hpp"
#include "src/interrupt.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/run_files.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

json variant_json(const study::VariantResult& v) {
    json j = fields_json(v);
    j["switches_unrepaired"] = v.unrepaired;
    study::for_each_field<study::SwitchStatistics>([&](const std::string& name, auto get) {
        j["switch_error_" + name] = v.switch_error ? json(get(*v.switch_error)) : json(nullptr);
    });
    return j;
}

json bit_names(std::uint32_t bits) {
    json names = json::array();
    for (std::size_t bit = 0; bit < core::health_bit_names.size(); ++bit)
        if ((bits & (1u << bit)) != 0) names.push_back(core::health_bit_names[bit]);
    return names;
}

json summary_json(const config::Config& config, const study::RunResult& result) {
    json variants = json::array();
    for (const study::VariantResult& v : result.variants) variants.push_back(variant_json(v));
    return {{"duration_s", static_cast<double>(result.ticks) * result.tick_s},
            {"ticks", result.ticks},
            {"fingerprint", result.fingerprint},
            {"switches", result.switches.size()},
            {"switches_failed", result.tally.failed},
            {"switches_withheld", result.tally.withheld},
            {"ticks_as_whole_counts", result.whole_count_ticks},
            {"warnings", result.warnings},
            {"relock_false_drift_deg_h", result.relock_false_drift_deg_h},
            {"what_happened", study::what_happened(config, result)},
            {"health_raised", bit_names(result.health_raised)},
            {"ticks_invalid", result.invalid_ticks},
            {"variants", variants},
            {"magnetic_estimate", variant_json(result.magnetic_estimate)},
            {"config", config_json(config)}};
}

std::string text(const study::Resolved& resolved, const study::RunResult& result, const RunFiles& files) {
    return fmt::format("{}\n\n{}\nfingerprint of the run: {}\nwritten to {}: {}\nopen {} in a browser\n",
                       fmt::join(study::what_happened(resolved.config, result), "\n"),
                       report::text(study::variant_table(resolved.config, result)), result.fingerprint,
                       printable(files.folder()), files.list(), printable(files.page()));
}

struct RunOptions : Options {
    std::string format = "h5";
    std::string logs = "all";
    bool lab = false;
};

logs::LogFormat format_named(const std::string& name) {
    if (name == "csv") return logs::LogFormat::csv;
    if (name == "h5") return logs::LogFormat::hdf5;
    throw UsageError{fmt::format("--format {}: allowed are h5 and csv", name)};
}

KeptLogs kept_logs(const RunOptions& options) {
    const auto kept = options.logs == "all"      ? KeptLogs::all
                      : options.logs == "angles" ? KeptLogs::angles
                      : options.logs == "none"
                          ? KeptLogs::none
                          : throw UsageError{fmt::format("--logs {}: allowed are none, angles and all", options.logs)};
    if (options.light && kept != KeptLogs::all)
        throw UsageError{fmt::format("--light: is for the raw log, which --logs {} leaves out", options.logs)};
    return kept;
}

study::RunResult run_into(RunFiles& files, const study::Resolved& resolved, const RunOptions& options) {
    Progress progress;
    study::RunTask task{.config = resolved.config,
                        .warnings = resolved.warnings,
                        .threads = options.threads,
                        .on_record =
                            [&](const core::HalfRecord& record, const core::LightSamples& light) {
                                check_interrupt();
                                if (logs::RawWriter* raw = files.raw())
                                    raw->write(record, options.light ? light : core::LightSamples{});
                            },
                        .on_row = {},
                        .on_health = [&](std::int64_t half, std::uint32_t bits) { files.write_health(half, bits); },
                        .on_progress = [&](double fraction) { progress.show(fraction); }};
    if (logs::AngleWriter* angles = files.angles())
        task.on_row = [angles](const core::AngleRow& row, double truth) { angles->write(row, truth); };
    return study::run(task);
}

// What the logs take of the disk.
double bytes_a_tick(const RunOptions& options, logs::LogFormat format, int light_samples) {
    const KeptLogs kept = kept_logs(options);
    return (kept == KeptLogs::all ? raw_bytes(format == logs::LogFormat::csv, light_samples) : 0.0) +
           (kept == KeptLogs::none ? 0.0 : angles_bytes);
}

// The page of the lab that goes beside the report; empty: none.
//
// errors  UsageError for a run that the page could not repeat; logs::IoError where there is no page.
std::string asked_lab_page(const RunOptions& options, const config::Config& config) {
    if (!options.lab) return "";
    if (config.temperature.profile.is_file() || config.field.course.is_file())
        throw UsageError{
            "--lab: the page reads no files; leave --lab out, or give temperature.profile and field.course as numbers"};
    if (config.motion.kind == config::MotionKind::file)
        throw UsageError{"--lab: the page reads no motion file; leave --lab out, or choose another motion.kind"};
    return lab_page();
}

report::Page report_page(const RunOptions& options, const config::Config& config, const study::RunResult& result) {
    report::Page page = study::run_page(config, result);
    if (options.lab)
        page.links.push_back({"This run in the lab page: watch it, and change it",
                              "lab.html#" + lab_fragment(config, static_cast<double>(result.ticks) * result.tick_s)});
    return page;
}

// The files are gone when this returns by an exception, but for the logs that grew until then.
void run(const RunOptions& options) {
    const logs::LogFormat format = format_named(options.format);
    const KeptLogs kept = kept_logs(options);
    const study::Resolved resolved = resolve(load_config(options));
    const config::Config& config = resolved.config;
    if (kept != KeptLogs::none)
        rig::require_every_half(config, fmt::format("a log (--logs {})", options.logs),
                                "allowed is --logs none, which leaves switches.csv, or gyro.fidelity = \"averaged\"");
    const std::string lab = asked_lab_page(options, config);
    const int light_samples = logged_light_samples(options, config, format);
    // How long a motion file is shows only when it is read.
    if (config.motion.kind != config::MotionKind::file)
        require_room(rig::run_ticks(config, twin::Motion::rest()), bytes_a_tick(options, format, light_samples),
                     options.out);
    std::string raw_part;
    std::string angles_part;
    rig::SwitchTally tally;
    try {
        RunFiles files{options.out, options.force, config, format, kept, light_samples};
        if (!lab.empty()) files.add_lab(lab, options.force);
        raw_part = files.raw_part();
        angles_part = files.angles_part();
        const study::RunResult result = run_into(files, resolved, options);
        for (const std::string& warning : std::span{result.warnings}.subspan(resolved.warnings.size()))
            complain("warning: " + warning);
        const std::string summary = pretty(summary_json(config, result));
        files.finish(result.switches, summary, report::html(report_page(options, config, result)), result.fingerprint);
        // The page to open is the last line, so what waits goes before.
        print_notes();
        print(options.json ? summary : text(resolved, result, files));
        tally = result.tally;
    } catch (...) {
        rethrow_with({raw_part, angles_part});
    }
    refuse_a_run_that_lacks_switches(tally);
}

}  // namespace

void add_run(CLI::App& program) {
    const auto options = std::make_shared<RunOptions>();
    CLI::App* verb =
        program.add_subcommand("run", "twin and core in closed loop: logs, summary and report into a folder");
    add_config_argument(*verb, *options);
    verb->add_option("--format", options->format, "format of the logs (h5)");
    verb->add_option("--logs", options->logs, "which logs stay (all)");
    verb->add_flag("--lab", options->lab, "also write the lab page, to which the report links with this configuration");
    add_light_option(*verb, *options);
    add_run_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { run(*options); });
}

}  // namespace zlg::cli
