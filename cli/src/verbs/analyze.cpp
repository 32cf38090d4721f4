#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/noise/imu_yaml.hpp>
#include <zlg/noise/noise_units.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/study/how_made.hpp>
#include <zlg/study/term_text.hpp>

#include "src/analysis_input.hpp"
#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/fields_json.hpp"
#include "src/mapping_input.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;
using study::AxisResult;

json curve_json(const deviations::DeviationCurve& curve) {
    json points = json::array();
    const bool is_total = deviations::is_total(curve.kind);
    for (const auto& p : curve.points) {
        points.push_back(fields_json(p, {{"terms", "n"}}));
        points.back()["edf"] = p.law.edf;
        if (!is_total) points.back().erase("as_computed");
    }
    json j{{"kind", deviations::name_of(curve.kind)},
           {"unit", curve.kind == deviations::DeviationKind::tdev ? "arcsec" : "arcsec/s"},
           {"confidence", curve.confidence},
           {"points", points}};
    if (is_total) j["total_bias"] = deviations::name_of(curve.total_bias);
    return j;
}

json curves_json(const std::vector<deviations::DeviationCurve>& curves) {
    json all = json::array();
    for (const auto& curve : curves) all.push_back(curve_json(curve));
    return all;
}

json term_json(const noise::FittedTerm& term) {
    const study::ShownTerm in = study::shown_term(term.kind);
    json j = fields_json(term, {{"limit", "limit_95"}});
    j["term"] = noise::name_of(term.kind);
    j["unit"] = noise::unit_of(term.kind);
    j["shown"] = {{"unit", in.unit},
                  {"value", term.value * in.factor},
                  {"sigma", term.sigma * in.factor},
                  {"limit_95", term.limit * in.factor}};
    if (term.kind == noise::NoiseKind::angle_random_walk && std::isfinite(term.second))
        j["bandwidth_hz"] = term.second, j["bandwidth_sigma_hz"] = term.second_sigma;
    if (term.kind == noise::NoiseKind::markov) j["time_s"] = term.second, j["time_sigma_s"] = term.second_sigma;
    if (term.kind == noise::NoiseKind::sine)
        j["frequency_hz"] = term.second, j["frequency_sigma_hz"] = term.second_sigma;
    return j;
}

json fit_json(const AxisResult& axis) {
    if (!axis.fit) return {{"reason", axis.no_fit}};
    json j = fields_json(*axis.fit);
    j["terms"] = json::array();
    for (const auto& term : axis.fit->fitted) j["terms"].push_back(term_json(term));
    j["points"] = fields_json(axis.fit->points, {{"measured", "hadamard_variance"}, {"degrees", "edf"}});
    // Without sinusoids and Markov terms, for which a data sheet has no line.
    j["data_sheet"] = fields_json(noise::data_sheet(axis.fit->terms));
    j["discrete"] = fields_json(noise::discrete_noise(axis.fit->terms, axis.rate_hz));
    j["discrete"]["rate_hz"] = axis.rate_hz;
    return j;
}

json modes_json(const AxisResult& axis) {
    const noise::ModeSplit& m = *axis.modes;
    json j = fields_json(m);
    j["segments"] = fields_json(m.segments);
    j["switches"] = fields_json(m.switches);
    j["switch_statistics"] = fields_json(m.statistics, {{"mean_by_mode_arcsec", "alternating_arcsec"}});
    j["curves"] = curves_json(axis.mode_curves);
    return j;
}

json axis_json(const AxisResult& axis) {
    json j = fields_json(axis, {{"n_samples", "samples"},
                                {"n_known", "known"},
                                {"n_gaps", "gaps"},
                                {"mean_arcsec_s", "mean_rate_arcsec_s"},
                                {"mean_sigma_arcsec_s", "mean_rate_sigma_arcsec_s"}});
    j["warnings"] = axis.warnings;
    j["deviations"] = curves_json(axis.curves);
    j["fit"] = fit_json(axis);
    j["readouts"] = fields_json(axis.readouts, {{"deviation_arcsec_s", "deviation"}});
    for (json& readout : j["readouts"]) {
        readout["kind"] = deviations::name_of(axis.allan.kind);
        readout["unit"] = "arcsec/s";
    }
    if (axis.modes) j["modes"] = modes_json(axis);
    if (axis.temperature) j["temperature"] = fields_json(*axis.temperature);
    return j;
}

json table_json(const study::TableResult& test) {
    json j = fields_json(test.table, {{"scale_factor", "scale_factor_units_arcsec"}});
    j["name"] = test.name;
    j["holds"] = test.holds;
    j["warnings"] = test.warnings;
    if (test.temperature) j["temperature"] = fields_json(*test.temperature);
    j["stages"] = fields_json(test.table.stages, {{"output", "output_units_s"}, {"n_samples", "samples"}});
    return j;
}

// Rates in arcsec/s throughout; what does not exist is null.
json analysis_json(const study::AnalysisResult& result) {
    json j{{"axes", json::array()}};
    for (const AxisResult& axis : result.axes) j["axes"].push_back(axis_json(axis));
    j["earth"] = fields_json(result.earth, {{"n_axes", "axes"}});
    for (json& line : j["earth"]) line["earth_arcsec_s"] = study::earth_rate_arcsec_s;
    if (result.presumed)
        j["presumed"] = {{"name", result.presumed->name},
                         {"angle_random_walk_arcsec_sqrt_s", result.presumed->terms.angle_random_walk_arcsec_sqrt_s},
                         {"rate_random_walk_arcsec_s_sqrt_s", result.presumed->terms.rate_random_walk_arcsec_s_sqrt_s},
                         {"data_sheet", fields_json(noise::data_sheet(result.presumed->terms))}};
    for (const auto& test : result.tables) j["rate_tables"].push_back(table_json(test));
    return j;
}

struct AnalyzeOptions : Options {
    std::vector<std::string> files;
    std::string imu_yaml;
    std::string compare;
};

bool same_name(const std::string& a, const std::string& b) {
    namespace fs = std::filesystem;
    const auto whole = [](const std::string& path) {
        std::error_code failed;
        const fs::path followed = fs::weakly_canonical(path, failed);
        return failed ? fs::absolute(path).lexically_normal() : followed;
    };
    std::error_code ignored;
    return whole(a) == whole(b) || fs::equivalent(a, b, ignored);
}

void check_output(const AnalyzeOptions& options, const std::string& output, const char* option) {
    if (output.empty()) return;
    for (const std::string& file : options.files) refuse_own_input(file, output, option);
    if (!options.compare.empty()) refuse_own_input(options.compare, output, option);
}

void check_usage(const AnalyzeOptions& options) {
    check_output(options, options.imu_yaml, "--imu-yaml");
    if (options.out.empty()) return;
    const std::string suffix = std::filesystem::path{options.out}.extension();
    if (suffix != ".html")
        throw UsageError{fmt::format("{}: the suffix '{}' names no report; allowed is .html", options.out, suffix)};
    check_output(options, options.out, "--out");
    if (options.imu_yaml.empty()) return;
    for (const std::string& name : {options.out, options.out + ".part"})
        if (same_name(options.imu_yaml, name) || same_name(options.imu_yaml + ".part", name))
            throw UsageError{fmt::format("--imu-yaml {}: is what --out writes; name another file", options.imu_yaml)};
}

std::optional<study::PresumedNoise> presumed(const AnalyzeOptions& options) {
    if (options.compare.empty()) return std::nullopt;
    return study::PresumedNoise{.name = name_of_file(options.compare),
                                .terms = noise::terms_of(noise::read_imu_yaml(options.compare))};
}

void analyze(const AnalyzeOptions& options) {
    check_usage(options);
    AnalysisInput input = read_analysis_input(options, options.files);
    const study::AnalysisTask task{.config = input.config.analysis,
                                   .settling_samples = input.config.compensation.relock_ticks,
                                   .threads = options.threads,
                                   .with_page = !options.out.empty(),
                                   .with_mode_curves = options.json || !options.out.empty()};
    study::AnalysisResult result{
        .axes = {}, .earth = {}, .presumed = presumed(options), .tables = std::move(input.tables)};
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
        for (const std::string& other : {options.mapping_path, options.config_path, options.compare})
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
    verb->add_option("--compare", options->compare,
                     "an imu.yaml whose noise is printed, and drawn by --out, beside the measured one");
    add_mapping_options(*verb, *options);
    add_strict_option(*verb, *options);
    add_config_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { analyze(*options); });
}

}  // namespace zlg::cli
