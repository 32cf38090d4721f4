#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/study/design_study.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/fields_json.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

struct DesignOptions : Options {
    std::optional<std::string> run_lengths;
};

json interval_json(const study::IntervalLine& l) {
    json j = fields_json(l.optimum);
    j["run_s"] = l.run_s;
    j["method"] = design::name(l.method);
    j["status"] = design::sentence(l.optimum.status);
    j["rise_at_0_7_arcsec_s"] = l.sensitivity.shorter_arcsec_s;
    j["rise_at_1_3_arcsec_s"] = l.sensitivity.longer_arcsec_s ? json(*l.sensitivity.longer_arcsec_s) : json(nullptr);
    return j;
}

json roots_json(const design::Roots& roots) {
    return {{"status", design::sentence(roots.status)},
            {"interval_s", roots.status == design::RootStatus::found ? json(roots.smaller_s) : json(nullptr)}};
}

json run_json(const study::RunLine& r) {
    json j = fields_json(r.terms);
    j["run_s"] = r.run_s;
    j["best"] = fields_json(r.best);
    j["corrected_9"] = roots_json(r.corrected_roots);
    j["printed_9"] = roots_json(r.roots_as_printed);
    j["half_first_segment"] = fields_json(r.half_first_segment);
    return j;
}

json loop_json(const study::LoopLine& l) {
    json j =
        fields_json(l, {{"stability_limit", "tick_over_tau_limit"}, {"stability_note", "tick_over_tau_limit_for"}});
    j.update(fields_json(l.margins));
    j.update(fields_json(
        l.miss, {{"root_sum_square_lambda", "miss_root_sum_square_lambda"}, {"worst_lambda", "miss_worst_lambda"}}));
    for (const design::MissPart& part : l.miss.part) j["miss_lambda"][std::string{part.name}] = part.lambda;
    return j;
}

json result_json(const study::DesignResult& result) {
    json j{{"switch_error_arcsec", result.switch_error_arcsec},
           {"switch_error_is_given", result.switch_error_is_given},
           {"optimum", json::array()},
           {"runs", json::array()},
           {"substitution", fields_json(result.substitution)},
           {"loop", loop_json(result.loop)}};
    for (const auto& l : result.intervals) j["optimum"].push_back(interval_json(l));
    for (const auto& r : result.runs) j["runs"].push_back(run_json(r));
    return j;
}

void design_gyro(const DesignOptions& options) {
    config::Config config = load_config(options);
    if (options.run_lengths) {
        // Only what a list of numbers is made of: nothing else may reach the configuration by this way.
        if (options.run_lengths->find_first_not_of("0123456789.,eE+- ") != std::string::npos)
            throw UsageError{fmt::format("--run-lengths {}: allowed are numbers of seconds, separated by commas",
                                         *options.run_lengths)};
        config::apply_pair(config, "design.run_lengths_s", "[" + *options.run_lengths + "]", "--run-lengths");
        config::check(config);
    }
    // The interval is what is asked for here.
    config.switching.interval_optimal = false;
    config = resolve(config).config;
    const study::DesignResult result = study::design_gyro(config);
    const report::Page page = study::design_page(config, result);
    if (!options.out.empty()) {
        require_suffix(options.out, ".html");
        write_file(options.out, report::html(page), options.force);
    }
    print(options.json ? pretty(result_json(result)) : report::text(page));
}

}  // namespace

void add_design(CLI::App& program) {
    const auto options = std::make_shared<DesignOptions>();
    CLI::App* verb = program.add_subcommand("design", "drift budget, best interval, substitution errors, loop margins");
    add_config_argument(*verb, *options);
    verb->add_option("--run-lengths", options->run_lengths, "lengths of run, with commas between");
    add_output_options(*verb, *options);
    verb->callback([options] { design_gyro(*options); });
}

}  // namespace zlg::cli
