#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/noise/imu_yaml.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/study/how_made.hpp>

#include "src/analysis_input.hpp"
#include "src/analysis_json.hpp"
#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/mapping_input.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct AnalyzeOptions : Options {
    std::vector<std::string> files;
    std::string imu_yaml;
};

void check_output(const AnalyzeOptions& options, const std::string& output, const char* option) {
    if (output.empty()) return;
    for (const std::string& file : options.files) refuse_own_input(file, output, option);
}

void check_usage(const AnalyzeOptions& options) {
    check_output(options, options.imu_yaml, "--imu-yaml");
    if (options.out.empty()) return;
    const std::string suffix = std::filesystem::path{options.out}.extension();
    if (suffix != ".html")
        throw UsageError{fmt::format("{}: the suffix '{}' names no report; allowed is .html", options.out, suffix)};
    check_output(options, options.out, "--out");
    if (!options.imu_yaml.empty()) refuse_same_output(options.imu_yaml, options.out, "--imu-yaml");
}

void analyze(const AnalyzeOptions& options) {
    check_usage(options);
    AnalysisInput input = read_analysis_input(options, options.files);
    const study::AnalysisTask task{.config = input.config.analysis,
                                   .settling_samples = input.config.compensation.relock_ticks,
                                   .threads = options.threads,
                                   .with_page = !options.out.empty(),
                                   .with_mode_curves = options.json || !options.out.empty()};
    study::AnalysisResult result{.axes = {}, .earth = {}, .tables = std::move(input.tables)};
    Progress progress;
    const auto n = static_cast<double>(input.axes.size());
    for (study::AxisRecord& axis : input.axes) {
        progress.show(static_cast<double>(result.axes.size()) / n);
        result.axes.push_back(study::analyze_axis(task, std::move(axis)));
    }
    result.earth = study::earth_lines(result.axes);
    if (!options.out.empty()) {
        std::vector<std::string> files;
        for (const std::string& file : options.files) files.push_back(file_facts(file));
        for (const std::string& other : {options.mapping_path, options.config_path})
            if (!other.empty()) files.push_back(file_facts(other));
        result.made = study::how_made(typed_command(), files, mapping_of(options).toml(), input.config);
    }
    // All that may refuse comes before the first file.
    std::vector<Output> outputs;
    const report::Page page = study::analysis_page(task.config, result);
    if (!options.out.empty()) outputs.push_back({options.out, report::html(page)});
    if (!options.imu_yaml.empty())
        outputs.push_back({options.imu_yaml, noise::imu_yaml(study::kalibr_gyro(result.axes))});
    write_all(outputs, options.force);
    print(options.json ? pretty(analysis_json(result)) : report::text(page));
    std::size_t n_warnings = 0;
    for (const study::AxisResult& axis : result.axes) n_warnings += axis.warnings.size();
    for (const study::TableResult& test : result.tables) n_warnings += test.warnings.size();
    refuse_warnings(options, n_warnings);
}

}  // namespace

void add_analyze(CLI::App& program) {
    const auto options = std::make_shared<AnalyzeOptions>();
    CLI::App* verb = program.add_subcommand(
        "analyze", "Allan deviations, noise terms, drift by mode and errors of switches of recorded gyros");
    verb->add_option("FILE", options->files,
                     "angle logs, raw logs, or files of other programs (zlg import says what one of those is)")
        ->required();
    verb->add_option("--threads", options->threads, "1..64 (2)")->check(CLI::Range(1, 64).description(""));
    verb->add_option("--imu-yaml", options->imu_yaml, "write the noise as Kalibr's imu.yaml");
    add_mapping_options(*verb, *options);
    add_strict_option(*verb, *options);
    add_config_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { analyze(*options); });
}

}  // namespace zlg::cli
