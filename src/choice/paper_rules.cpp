#include <zlg/choice/paper_rules.hpp>

#include <cmath>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/design/switching_interval.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/study/design_study.hpp>

#include "verdict.hpp"

namespace zlg::choice {
namespace {

using namespace report;

double printed_interval_s(const config::Config& gyro, double run_s) {
    return design::optimum(design::IntervalMethod::as_printed, study::drift_case(gyro, run_s)).interval_s;
}

Figure figure_5(const config::Config& gyro) {
    Figure f = blank_figure("figure-5", "Figure 5: best interval against length of run",
                            "By the least of (7) as printed, with design.switch_error_arcsec a switch.", "run, s",
                            "interval, s");
    f.log_x = f.log_y = true;
    Series s = blank_series("least of (7) as printed");
    for (int k = 0; k <= 100; ++k) {
        const double run_s = 60.0 * std::pow(10.0, 0.03 * k);
        add_point(s, run_s, printed_interval_s(gyro, run_s));
    }
    f.series = {std::move(s)};
    return f;
}

}  // namespace

Answer by_paper_rules(const Requirement& r) {
    const design::DriftCase task = study::drift_case(r.base, r.run_s);
    const double interval_s = printed_interval_s(r.base, r.run_s);
    const design::DriftTerms terms = design::terms_as_printed(task, interval_s);
    Answer a;
    a.proof.candidate = {.method = {.tick_s = r.base.gyro.tick_s}, .interval_s = interval_s};
    a.gyro = with(r.base, a.proof.candidate);
    a.least_arcsec = r.run_s * (terms.total_arcsec_s() - terms.nonmagnetic_arcsec_s);
    a.met = a.least_arcsec <= r.limit_arcsec();
    a.probability = a.met ? 1.0 : 0.0;
    a.parts = {{"quasi-non-magnetic drift", r.run_s * terms.quasi_nonmagnetic_arcsec_s},
               {"sawtooth", r.run_s * terms.sawtooth_arcsec_s},
               {"switch errors", r.run_s * terms.switch_errors_arcsec_s},
               {"all", a.least_arcsec}};
    a.binding = largest(a.parts);
    a.budget = budget_7(task, interval_s, terms);
    a.budget.insert(a.budget.begin(), {"switch_error_arcsec", task.switch_error_arcsec});
    a.reasons = {fmt::format("Interval {:.1f} s: the least of (7) as printed for a run of {} s, a switch leaving {} "
                             "arcsec, all of one sign.",
                             interval_s, short_number(r.run_s), short_number(task.switch_error_arcsec)),
                 "The paper's rules know no tolerances and no chance: the budget keeps what is required, or it does "
                 "not. No gyro was tried."};
    return a;
}

report::Page paper_rules_page(const Requirement& r, const Answer& a) {
    report::Page page{.title = "What the paper's rules choose",
                      .verdict = fmt::format(
                          "By the paper's rules alone: switch every {:.1f} s. Its budget leaves {} arcsec after {} s, "
                          "{} are asked.",
                          a.proof.candidate.interval_s, short_number(a.least_arcsec), short_number(r.run_s),
                          short_number(r.limit_arcsec())),
                      .lead = "Nothing here was tried on a gyro."};
    report::Table budget{.caption = "The budget, with the numbers of the equations in the names.",
                         .header = {"quantity", "value"}};
    for (const auto& [name, value] : a.budget) budget.rows.push_back(row(name, value));
    page.sections.push_back(
        {.heading = "Choice", .paragraphs = a.reasons, .tables = {std::move(budget)}, .figures = {figure_5(r.base)}});
    return page;
}

}  // namespace zlg::choice
