#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/logs/error.hpp>
#include <zlg/logs/table_file.hpp>
#include <zlg/paper/paper.hpp>
#include <zlg/report/export.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/own_folder.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

// Outside of this the points measured on the twin and their theory do not belong together.
constexpr double min_chi2_per_dof = 0.7;
constexpr double max_chi2_per_dof = 1.4;

constexpr const char* page_name = "paper.html";
constexpr const char* claims_name = "claims.csv";

bool agrees(const paper::Paper& paper) {
    return paper.chi2_per_dof >= min_chi2_per_dof && paper.chi2_per_dof <= max_chi2_per_dof;
}

std::string claims_table(const std::vector<paper::Claim>& claims) {
    std::string text = "where,claim,verdict,finding\n";
    for (const paper::Claim& c : claims)
        text += fmt::format("{},{},{},{}\n", report::csv_quoted(c.where), report::csv_quoted(c.claim),
                            paper::verdict_name(c.verdict), report::csv_quoted(c.finding));
    return text;
}

std::vector<Output> files_of(const paper::Paper& paper, const OwnFolder& folder) {
    std::vector<Output> files{{folder.path(claims_name), claims_table(paper.claims)}};
    const auto add = [&](const std::string& name, std::string text) {
        files.push_back({folder.path(name), std::move(text)});
    };
    for (const paper::PaperItem& item : paper.items) {
        for (const report::Diagram& d : item.section.diagrams) add(d.id + ".svg", report::svg_file(d));
        for (const report::Figure& f : item.section.figures) {
            add(f.id + ".svg", report::svg_file(f));
            add(f.id + ".csv", report::csv(f));
        }
    }
    files.push_back({folder.path(page_name), report::html(paper::paper_page(paper))});
    return files;
}

json result_json(const paper::Paper& paper) {
    json items = json::array();
    for (const paper::PaperItem& item : paper.items) {
        json figures = json::array();
        for (const report::Diagram& d : item.section.diagrams) figures.push_back(d.id);
        for (const report::Figure& f : item.section.figures) figures.push_back(f.id);
        items.push_back({{"number", item.number}, {"title", item.section.heading}, {"figures", figures}});
    }
    json claims = json::array();
    for (const paper::Claim& c : paper.claims)
        claims.push_back({{"where", c.where},
                          {"claim", c.claim},
                          {"verdict", paper::verdict_name(c.verdict)},
                          {"finding", c.finding}});
    return {{"items", items},
            {"chi2_per_dof", paper.chi2_per_dof},
            {"degrees_of_freedom", paper.degrees_of_freedom},
            {"claims", claims}};
}

std::string text(const paper::Paper& paper, const std::string& folder, std::size_t n_files) {
    std::string lines;
    for (const paper::PaperItem& item : paper.items) lines += item.section.heading + "\n";
    return fmt::format(
        "{}\ntwin against theory: chi-square {:.3f} per point, {} points (those of one experiment share its noise), "
        "allowed {} to {}\n{} claims: {}\nwritten to {}: {} and {} more files\n",
        lines, paper.chi2_per_dof, paper.degrees_of_freedom, min_chi2_per_dof, max_chi2_per_dof, paper.claims.size(),
        paper::verdict_counts(paper.claims), printable(folder), page_name, n_files);
}

void run(const Options& options) {
    if (options.out.empty()) throw UsageError{"--out is missing: name the folder to write into"};
    paper::PaperTask task{.config = load_config(options), .threads = options.threads};
    const OwnFolder folder{options.out};
    // Which files there will be shows only at the end, so all that is there counts.
    if (!folder.is_new() && !options.force && !std::filesystem::is_empty(options.out))
        throw logs::IoError{fmt::format("{}: exists and is not empty; --force overwrites what is in it", options.out)};
    std::optional<logs::TableFile> writable{std::in_place, folder.path(page_name), options.force};
    Progress progress;
    task.on_progress = [&](double fraction) { progress.show(fraction); };
    const paper::Paper paper = paper::recompute_paper(task);
    const std::vector<Output> files = files_of(paper, folder);
    writable.reset();
    write_all(files, options.force);
    print(options.json ? pretty(result_json(paper)) : text(paper, options.out, files.size() - 1));
    if (agrees(paper)) return;
    explain_exit(
        fmt::format("the twin does not agree with theory: chi-square {:.3f} per degree of freedom, allowed is {} to {}",
                    paper.chi2_per_dof, min_chi2_per_dof, max_chi2_per_dof));
    throw CLI::RuntimeError{result_says_no};
}

}  // namespace

void add_paper(CLI::App& program) {
    const auto options = std::make_shared<Options>();
    CLI::App* verb =
        program.add_subcommand("paper", "every figure and table of the paper, recomputed, beside the printed values");
    add_config_options(*verb, *options);
    add_run_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { run(*options); });
}

}  // namespace zlg::cli
