#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/choice/choice_page.hpp>
#include <zlg/choice/paper_rules.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/study/design_study.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/fields_json.hpp"
#include "src/interrupt.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

struct DesignOptions : Options {
    std::string require;
    std::string rules;
};

json interval_json(const study::IntervalLine& l) {
    json j = fields_json(l.optimum);
    j["run_s"] = l.run_s;
    j["method"] = design::name(l.method);
    j["status"] = design::sentence(l.optimum.status);
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

// What the options exclude, said before gyros run.
void check_required(const DesignOptions& options) {
    if (!options.rules.empty() && options.rules != "paper")
        throw UsageError{fmt::format("--rules {}: allowed is paper", printable(options.rules))};
    if (!options.rules.empty() && options.require.empty())
        throw UsageError{"--rules paper: is for --require REQUIRE.toml"};
    if (options.require.empty()) return;
    if (!options.config_path.empty())
        throw UsageError{"--require: the requirement holds the gyro and the length of its run; leave out CONFIG"};
    if (options.out.empty()) return;
    if (!options.out.ends_with(".html") && !options.out.ends_with(".toml"))
        throw UsageError{fmt::format(
            "{}: the suffix names no format; allowed are .html, a page, and .toml, what zlg run takes", options.out)};
    refuse_own_input(options.require, options.out);
    if (!options.force && std::filesystem::exists(options.out))
        throw logs::IoError{fmt::format("{} exists; use --force to overwrite", options.out)};
}

choice::Answer chosen(const DesignOptions& options, const choice::Requirement& requirement) {
    if (!options.rules.empty()) return choice::by_paper_rules(requirement);
    will_finish();
    Progress progress;
    return choice::choose({.requirement = requirement,
                           .threads = options.threads,
                           .on_progress = [&](double fraction) { progress.show(fraction); },
                           .is_stopped = [&] { return is_interrupted(); }});
}

void design_required(const DesignOptions& options) {
    std::vector<std::string> sets = options.sets;
    if (options.seed) sets.push_back("run.seed=" + *options.seed);
    const choice::Requirement requirement = choice::read_requirement(options.require, sets);
    const choice::Answer answer = chosen(options, requirement);
    const report::Page page = options.rules.empty() ? choice::choice_page(requirement, answer)
                                                    : choice::paper_rules_page(requirement, answer);
    if (!options.out.empty())
        write_file(options.out,
                   options.out.ends_with(".toml") ? choice::toml_text(requirement, answer) : report::html(page),
                   options.force);
    print(options.json ? choice::json_text(requirement, answer) : report::text(page));
    if (answer.is_interrupted)
        throw logs::IoError{fmt::format("interrupted by a signal; what is known until then is marked: {} gyros tried",
                                        answer.proof.trials.size())};
    if (answer.met) return;
    explain_exit(
        fmt::format("the requirement cannot be met: the least error that {} of the gyros keep is {:.4g} "
                    "arcsec, {:.4g} are asked; what binds: {}",
                    requirement.confidence, answer.least_arcsec, requirement.limit_arcsec(), answer.binding));
    print_notes();
    throw CLI::RuntimeError{result_says_no};
}

}  // namespace

void add_design(CLI::App& program) {
    const auto options = std::make_shared<DesignOptions>();
    CLI::App* verb = program.add_subcommand("design", "drift budget, best interval, substitution errors, loop margins");
    add_config_argument(*verb, *options);
    verb->add_option("--require", options->require,
                     "what the gyro must keep, TOML: the simplest choice that does, proved on many gyros")
        ->check(is_a_name());
    verb->add_option("--rules", options->rules, "paper: by the paper's rules alone")->check(is_a_name());
    verb->add_option("--seed", options->seed, "seed of all noise (1)");
    verb->add_option("--threads", options->threads, "1..64 (2)")->check(CLI::Range(1, 64).description(""));
    add_output_options(*verb, *options);
    verb->callback([options] {
        check_required(*options);
        options->require.empty() ? design_gyro(*options) : design_required(*options);
    });
}

}  // namespace zlg::cli
