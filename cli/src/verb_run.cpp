#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/study/design_study.hpp>
#include <zlg/study/run.hpp>
#include <zlg/study/run_page.hpp>

#include "as_json.hpp"
#include "failure.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output.hpp"
#include "processor_option.hpp"
#include "run_files.hpp"
#include "verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

json variant_json(const study::VariantResult& v) {
    json j{{"name", v.name}, {"drift_arcsec_s", v.drift_arcsec_s}, {"angle_error_arcsec", v.angle_error_arcsec}};
    const auto add = [&](const char* key, double study::SwitchStatistics::*member) {
        j[key] = v.switch_error ? json((*v.switch_error).*member) : json(nullptr);
    };
    add("switch_error_mean_arcsec", &study::SwitchStatistics::mean_arcsec);
    add("switch_error_rms_arcsec", &study::SwitchStatistics::rms_arcsec);
    add("switch_error_max_arcsec", &study::SwitchStatistics::max_arcsec);
    return j;
}

json summary_json(const config::Config& config, const study::RunResult& result) {
    json variants = json::array();
    for (const study::VariantResult& v : result.variants) variants.push_back(variant_json(v));
    return {{"duration_s", static_cast<double>(result.ticks) * result.tick_s},
            {"ticks", result.ticks},
            {"switches", result.switches.size()},
            {"relock_false_drift_deg_h", result.relock_false_drift_deg_h},
            {"variants", variants},
            {"config", config_json(config)}};
}

std::string cell(const std::optional<study::SwitchStatistics>& s, double study::SwitchStatistics::*member) {
    return s ? fmt::format("{:.3f}", (*s).*member) : "-";
}

std::string table(const study::RunResult& result) {
    std::string text =
        fmt::format("{:<20}{:>12}{:>14}   error per switch, arcsec\n{:<20}{:>12}{:>14}{:>10}{:>10}{:>10}\n", "",
                    "drift", "angle error", "variant", "arcsec/s", "arcsec", "mean", "rms", "max");
    for (const study::VariantResult& v : result.variants)
        text += fmt::format("{:<20}{:>12.5f}{:>14.2f}{:>10}{:>10}{:>10}\n", v.name, v.drift_arcsec_s,
                            v.angle_error_arcsec, cell(v.switch_error, &study::SwitchStatistics::mean_arcsec),
                            cell(v.switch_error, &study::SwitchStatistics::rms_arcsec),
                            cell(v.switch_error, &study::SwitchStatistics::max_arcsec));
    return text;
}

std::string text(const study::RunResult& result, const RunFiles& files) {
    return fmt::format(
        "{} s, {} switches, all compensations of one run's records (one_mode: a run without switching)\n\n{}\n"
        "drift: slope of the angle error (final minus true); 1 arcsec/s is 1 deg/h\nwritten to {}: {}\n",
        static_cast<double>(result.ticks) * result.tick_s, result.switches.size(), table(result), files.folder(),
        files.list());
}

struct RunOptions : Options {
    ProcessorOptions processor;
    std::string format = "h5";
};

logs::LogFormat format_named(const std::string& name) {
    if (name == "csv") return logs::LogFormat::csv;
    if (name == "h5") return logs::LogFormat::hdf5;
    throw UsageError{fmt::format("--format {}: allowed are h5 and csv", name)};
}

study::RunResult run_into(RunFiles& files, const config::Config& config, const RunOptions& options,
                          rig::Processor* processor, const Interruptible& interruptible) {
    Progress progress;
    study::RunTask task{.config = config,
                        .threads = options.threads,
                        .processor = processor,
                        .on_record =
                            [&](const core::HalfRecord& record, const core::LightSamples& light) {
                                interruptible.check();
                                files.raw().write(record, options.light ? light : core::LightSamples{});
                            },
                        .on_row = [&](const core::AngleRow& row, double truth) { files.angles().write(row, truth); },
                        .on_health = [&](std::int64_t half, std::uint32_t bits) { files.write_health(half, bits); },
                        .on_progress = [&](double fraction) { progress.show(fraction); }};
    return study::run(task);
}

// The files are gone when this returns by an exception, but for the logs that grew until then.
void run(const RunOptions& options) {
    const logs::LogFormat format = format_named(options.format);
    const config::Config config = with_laser_curve(with_interval(load_config(options)));
    const Interruptible interruptible;
    const std::unique_ptr<rig::Processor> processor = make_processor(options.processor);
    std::string raw_part;
    std::string angles_part;
    try {
        RunFiles files{options.out, options.force, config, format, logged_light_samples(options, config, format)};
        raw_part = files.raw_part();
        angles_part = files.angles_part();
        const study::RunResult result = run_into(files, config, options, processor.get(), interruptible);
        const std::string summary = pretty(summary_json(config, result));
        files.finish(result.switches, summary, report::html(study::run_page(config, result)));
        print(options.json ? summary : text(result, files));
    } catch (...) {
        rethrow_with({raw_part, angles_part});
    }
}

}  // namespace

void add_run(CLI::App& program) {
    const auto options = std::make_shared<RunOptions>();
    CLI::App* verb =
        program.add_subcommand("run", "twin and core in closed loop: logs, summary and report into a folder");
    add_config_argument(*verb, *options);
    verb->add_option("--format", options->format, "of the logs: h5 (default) or csv");
    add_light_option(*verb, *options);
    add_processor_options(*verb, options->processor);
    add_run_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { run(*options); });
}

}  // namespace zlg::cli
