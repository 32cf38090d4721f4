#include <zlg/paper/paper.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <zlg/config/schema.hpp>
#include <zlg/study/how_made.hpp>
#include <zlg/study/run.hpp>

#include "paper_parts.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

// Share of the run of the twin in the time; the rest are the experiments.
constexpr double share_of_run = 0.4;

study::RunResult run_of(const PaperTask& task) {
    study::RunTask run_task{.config = task.config, .threads = task.threads};
    if (task.on_progress) run_task.on_progress = [&](double part) { task.on_progress(share_of_run * part); };
    return run(run_task);
}

SubstitutionFigures substitution_of(const PaperTask& task) {
    PaperTask rest = task;
    if (task.on_progress)
        rest.on_progress = [&](double part) { task.on_progress(share_of_run + (1.0 - share_of_run) * part); };
    return paper_figures_8_to_11(rest);
}

constexpr std::array verdicts{Verdict::agrees, Verdict::misprint, Verdict::wrong, Verdict::not_supported};

auto number_of(const std::vector<Claim>& claims, Verdict v) { return std::ranges::count(claims, v, &Claim::verdict); }

report::Section claims_section(const std::vector<Claim>& claims) {
    std::vector<std::vector<std::string>> rows;
    for (const Claim& c : claims) rows.push_back({c.where, c.claim, verdict_name(c.verdict), c.finding});
    return item_of("claims", {claims.size(), verdict_counts(claims)}, {table_of("claims.table", std::move(rows))}, {})
        .section;
}

// The paper's photodiodes are equal, unless asked otherwise.
config::Config with_equal_light(config::Config config) {
    const auto set = [&](const char* key, double& value, double equal) {
        if (!config::is_given(config, key)) value = equal;
    };
    set("light.gain_b", config.light.gain_b, twin::equal_light.gain_b);
    set("light.gain_drift_per_h", config.light.gain_drift_per_h, twin::equal_light.gain_drift_per_h);
    set("light.power_decay_per_h", config.light.power_decay_per_h, twin::equal_light.power_decay_per_h);
    return config;
}

}  // namespace

const char* verdict_name(Verdict verdict) {
    constexpr std::array names{"agrees", "misprint", "wrong", "not supported"};  // in the order of the enumerators
    return names.at(static_cast<std::size_t>(verdict));
}

std::string verdict_counts(const std::vector<Claim>& claims) {
    std::string text;
    for (const Verdict v : verdicts)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", verdict_name(v), number_of(claims, v));
    return text;
}

Paper recompute_paper(const PaperTask& asked) {
    PaperTask task = asked;
    task.config = with_equal_light(asked.config);
    const study::RunResult run = run_of(task);
    SubstitutionFigures substitution = substitution_of(task);
    Paper paper{.config = task.config,
                .items = {paper_figure_1(task), paper_figure_2(), paper_figure_3(task, run), paper_figure_4(task),
                          paper_figure_5(task), paper_table_1(task, run), paper_table_2(task, run), paper_figure_6(run),
                          paper_figure_7(task)},
                .claims = paper_claims(task),
                .chi2_per_dof = substitution.chi2_per_dof,
                .degrees_of_freedom = substitution.degrees_of_freedom};
    paper.items.insert(paper.items.end(), std::make_move_iterator(substitution.items.begin()),
                       std::make_move_iterator(substitution.items.end()));
    return paper;
}

report::Page paper_page(const Paper& paper) {
    Values numbers{paper.claims.size()};
    for (const Verdict v : verdicts) numbers.emplace_back(number_of(paper.claims, v));
    numbers.insert(numbers.end(), {paper.degrees_of_freedom, paper.chi2_per_dof});
    const std::vector<std::string> text = words("page", numbers);
    report::Page page{.title = text.at(0), .verdict = text.at(1), .lead = text.at(2), .numbered = false};
    page.sections.push_back(claims_section(paper.claims));
    for (const PaperItem& item : paper.items) page.sections.push_back(item.section);
    page.sections.push_back(study::how_made("paper", paper.config));
    return page;
}

}  // namespace zlg::paper
