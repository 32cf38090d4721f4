#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/sweep/description.hpp>
#include <zlg/sweep/gyros.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/statistics.hpp>
#include <zlg/sweep/sweep.hpp>
#include <zlg/sweep/sweep_page.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/interrupt.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

constexpr std::size_t n_shown = 5;  // of the gyros to look at, in JSON
constexpr std::array status_names{"good", "refused", "lost", "no_switch", "not_finite"};

const char* name_of(sweep::Status status) { return status_names.at(static_cast<std::size_t>(status)); }

json number_json(const std::optional<double>& number) { return number ? json(*number) : json(nullptr); }

json yield_json(const std::optional<sweep::Yield>& yield) { return yield ? json(yield->value) : json(nullptr); }

json interval_json(const std::optional<sweep::Yield>& yield) {
    return yield ? json{yield->low, yield->high} : json(nullptr);
}

json metric_json(const sweep::MetricSummary& m) {
    return {{"unit", sweep::unit_of(m.metric.name)},
            {"mean", number_json(m.mean)},
            {"sd", number_json(m.sd)},
            {"p05", number_json(m.p05)},
            {"p50", number_json(m.p50)},
            {"p95", number_json(m.p95)},
            {"yield", yield_json(m.yield)},
            {"yield_interval", interval_json(m.yield)}};
}

json gyro_json(const sweep::Gyros& gyros, const sweep::Row& row) {
    return {{"gyro", row.gyro},
            {"status", name_of(row.status)},
            {"reason", row.reason},
            {"fingerprint", row.fingerprint},
            {"command", gyros.command(row.gyro)}};
}

nlohmann::json sweep_json(const sweep::Gyros& gyros, const sweep::Rows& rows) {
    const sweep::Summary summary = summary_of(gyros.description(), rows);
    json metrics = json::object();
    for (const sweep::MetricSummary& m : summary.metrics) metrics[m.metric.name] = metric_json(m);
    json shown = json::array();
    for (const sweep::Row* row : worst(gyros.description(), rows, n_shown)) shown.push_back(gyro_json(gyros, *row));
    return {{"gyros", summary.gyros},
            {"failed", summary.failed},
            {"metrics", std::move(metrics)},
            {"yield", yield_json(summary.yield)},
            {"yield_interval", interval_json(summary.yield)},
            {"worst", std::move(shown)}};
}

struct SweepOptions : Options {
    std::string description;
    std::vector<std::string> merged;
    std::string part;
    std::string page;
};

constexpr std::int64_t max_parts = 1'000'000;

// errors  UsageError.
sweep::Part part_of(const std::string& text) {
    sweep::Part part;
    const char* const end = text.data() + text.size();
    const auto [slash, k_error] = std::from_chars(text.data(), end, part.k);
    const bool has_slash = k_error == std::errc{} && slash != end && *slash == '/';
    const auto [last, n_error] =
        has_slash ? std::from_chars(slash + 1, end, part.n) : std::from_chars_result{end, k_error};
    if (!has_slash || n_error != std::errc{} || last != end ||
        !(part.k >= 1 && part.k <= part.n && part.n <= max_parts))
        throw UsageError{fmt::format("--part {}: allowed is k/n with 1 <= k <= n <= {}", text, max_parts)};
    return part;
}

void check_options(const SweepOptions& options) {
    if (options.out.empty())
        throw UsageError{"--out is missing: name the file of results, with the suffix .h5 or .hdf5"};
    if (!options.out.ends_with(".h5") && !options.out.ends_with(".hdf5"))
        throw UsageError{
            fmt::format("{}: the suffix names no format of results; allowed are .h5 and .hdf5", options.out)};
    if (options.merged.empty() == options.description.empty())
        throw UsageError{"either SWEEP.toml is wanted, or --merge with the files to put together"};
    if (!options.merged.empty() && !options.part.empty())
        throw UsageError{"--part: is for a sweep that runs, not for --merge"};
    if (!options.page.empty()) require_suffix(options.page, ".html");
    // Said before the gyros run, which may take hours.
    if (!options.page.empty() && !options.force && std::filesystem::exists(options.page))
        throw logs::IoError{
            fmt::format("{} exists; remove it or name another, for --force begins the sweep anew", options.page)};
    const std::filesystem::path page_folder = std::filesystem::path{options.page}.parent_path();
    if (!page_folder.empty() && !std::filesystem::is_directory(page_folder))
        throw logs::IoError{fmt::format("cannot create {}: there is no folder {}", options.page, page_folder.string())};
    for (const std::string& path : options.merged) refuse_own_input(path, options.out);
    if (!options.page.empty() && !options.description.empty())
        refuse_own_input(options.description, options.page, "--page");
}

// A gyro that has failed is a result, and says no.
void show(const SweepOptions& options, const sweep::Gyros& gyros, const sweep::Rows& rows) {
    if (!options.page.empty() && !rows.empty())
        write_file(options.page, report::html(sweep::sweep_page(gyros, rows)), options.force);
    print(options.json ? pretty(sweep_json(gyros, rows))
                       : (rows.empty() ? "no gyros\n" : report::text(sweep::sweep_summary(gyros, rows))) +
                             fmt::format("written to {}\n", printable(options.out)));
    const sweep::Summary summary = summary_of(gyros.description(), rows);
    if (summary.failed == 0) return;
    explain_exit(
        fmt::format("{} of {} gyros failed: their rows have a status and a reason", summary.failed, summary.gyros));
    print_notes();
    throw CLI::RuntimeError{result_says_no};
}

void merge(const SweepOptions& options) {
    const sweep::Merged merged = sweep::merge(options.merged, options.out, options.force);
    const auto n = static_cast<std::int64_t>(merged.rows.size());
    if (n < merged.description.n_gyros)
        complain(fmt::format("warning: {} holds {} of {} gyros; merge the other parts with it, or go on by zlg sweep",
                             options.out, n, merged.description.n_gyros));
    show(options, sweep::Gyros{merged.description}, merged.rows);
}

void sweep_gyros(const SweepOptions& options, const sweep::Crew& crew) {
    Progress progress;
    sweep::Task task{.description = sweep::read_description(options.description),
                     .out = options.out,
                     .threads = options.threads,
                     .crew = crew,
                     .force = options.force};
    if (!options.part.empty()) task.part = part_of(options.part);
    task.is_stopped = [&] { return is_interrupted(); };
    task.on_progress = [&](std::int64_t done, std::int64_t asked) {
        progress.show(static_cast<double>(done) / static_cast<double>(asked));
    };
    const sweep::Outcome outcome = sweep::run(task);
    if (outcome.is_stopped)
        throw logs::IoError{fmt::format("interrupted by a signal; {} of {} gyros are in {}, and the same line goes on",
                                        outcome.rows.size(), task.description.n_gyros, outcome.checkpoint)};
    if (outcome.n_run == 0) complain(fmt::format("note: {} held every gyro that is asked for", options.out));
    show(options, sweep::Gyros{task.description}, outcome.rows);
}

}  // namespace

void add_sweep(CLI::App& program, const sweep::Crew& crew) {
    const auto options = std::make_shared<SweepOptions>();
    CLI::App* verb = program.add_subcommand(
        "sweep", "many gyros of drawn parameters, whose results can be interrupted, continued, parted and merged");
    verb->add_option("SWEEP", options->description, "what is drawn and recorded, TOML");
    verb->add_option("--page", options->page, "a page of the results, FILE.html");
    verb->add_option("--part", options->part, "only the k-th of n parts of the gyros");
    verb->add_option("--merge", options->merged, "put files of results together");
    if (!crew) verb->add_option("--threads", options->threads, "1..256 (2)")->check(CLI::Range(1, 256).description(""));
    add_output_options(*verb, *options);
    verb->get_option("--out")->description("the file of results, .h5; FILE.part while it grows");
    verb->get_option("--force")->description("overwrite what exists, and begin anew");
    verb->callback([options, crew] {
        check_options(*options);
        options->merged.empty() ? sweep_gyros(*options, crew) : merge(*options);
    });
}

}  // namespace zlg::cli
