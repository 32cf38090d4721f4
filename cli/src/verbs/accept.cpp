#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/acceptance/report.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/report/page.hpp>

#include "src/failure.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct AcceptOptions : Options {
    std::vector<std::string> files;
    std::string history;
    bool plan = false;
    bool verify = false;
};

void check_usage(const AcceptOptions& options) {
    if (options.plan && options.verify) throw UsageError{"--plan, --verify: allowed is one of them"};
    if (!options.plan && !options.verify && options.files.size() != 1)
        throw UsageError{fmt::format("{} plans; allowed is one (--plan LOG... writes one)", options.files.size())};
    if (options.verify && !options.out.empty()) throw UsageError{"--out: --verify writes no file"};
    if (!options.history.empty() && (options.plan || options.verify))
        throw UsageError{"--history: allowed where a plan is carried out"};
    if (options.out.empty()) return;
    require_suffix(options.out, options.plan ? ".toml" : ".html");
    for (const std::string& file : options.files) refuse_own_input(file, options.out);
}

void write_plan(const AcceptOptions& options) {
    const std::string plan = acceptance::plan_for(options.files);
    if (options.out.empty()) return print(plan);
    write_file(options.out, plan, options.force);
    print(fmt::format("{}: fill in the unit and the limits, then: zlg accept {} --out report.html\n",
                      printable(options.out), printable(options.out)));
}

void verify(const AcceptOptions& options) {
    const auto found = acceptance::verify(options.files.front(), {options.files.begin() + 1, options.files.end()});
    for (const std::string& line : found.lines) print(printable(line) + "\n");
    if (!found.fits) throw CLI::RuntimeError{result_says_no};
}

// As it is repeated: without the name of the output and what changes no number.
std::string command_of(const AcceptOptions& options) {
    std::string command = fmt::format("zlg accept {}", options.files.front());
    if (!options.config_path.empty()) command += " --config " + options.config_path;
    for (const std::string& set : options.sets) command += " --set " + set;
    if (!options.history.empty()) command += " --history " + options.history;
    return command + " --out REPORT.html";
}

void accept(const AcceptOptions& options) {
    check_usage(options);
    if (options.plan) return write_plan(options);
    if (options.verify) return verify(options);
    Progress progress;
    const acceptance::Acceptance test =
        acceptance::accept({.plan = options.files.front(),
                            .said = said_config(options),
                            .threads = options.threads,
                            .on_progress = [&](double fraction) { progress.show(fraction); }});
    const auto earlier =
        options.history.empty() ? std::vector<std::string>{} : acceptance::read_reports(options.history);
    const report::Page page = acceptance::acceptance_page(test, command_of(options), earlier);
    for (const acceptance::TestedRun& run : test.runs)
        for (const std::string& why : run.stops)
            complain(fmt::format("warning: run {} is no measurement: {}", run.number, why));
    if (!options.out.empty()) write_file(options.out, acceptance::report_html(page), options.force);
    print(options.json ? page.data : report::text(page));
    if (test.passed()) return;
    explain_exit(page.verdict);
    throw CLI::RuntimeError{result_says_no};
}

}  // namespace

void add_accept(CLI::App& program) {
    const auto options = std::make_shared<AcceptOptions>();
    CLI::App* verb = program.add_subcommand(
        "accept", "acceptance test of a gyro by a plan: quantities, limits, and verdicts that know chance");
    verb->add_option("FILE", options->files, "the plan; of --plan the logs, of --verify the report and logs")
        ->required();
    verb->add_flag("--plan", options->plan, "write a commented plan for these logs");
    verb->add_flag("--verify", options->verify,
                   "hold a report, and logs, against its record: finds damage, not forgery");
    verb->add_option("--history", options->history, "a folder with earlier reports, drawn as a trend");
    verb->add_option("--threads", options->threads, "1..64 (2)")->check(CLI::Range(1, 64).description(""));
    add_config_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { accept(*options); });
}

}  // namespace zlg::cli
