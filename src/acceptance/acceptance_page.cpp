// The page of an acceptance test: the verdict first, then what it rests on.

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <zlg/acceptance/report.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/study/term_text.hpp>

#include "record.hpp"
#include "trend.hpp"

namespace zlg::acceptance {
namespace {

using namespace report;

std::string unit_of(const Judged& judged) { return std::string{find_quantity(judged.value.name)->unit}; }

std::string value_cell(const Judged& judged) {
    const Value& v = judged.value;
    if (!v.determined) return "not determined";
    const std::string text =
        v.uncertainty == 0.0 ? fmt::format("{:.6g}", v.value) : study::with_error(v.value, v.uncertainty);
    return fmt::format("{} {}", text, unit_of(judged));
}

std::string limit_cell(const std::optional<Limit>& limit) {
    if (!limit) return "-";
    if (limit->min && limit->max) return fmt::format("{:g} .. {:g}", *limit->min, *limit->max);
    return limit->max ? fmt::format("at most {:g}", *limit->max) : fmt::format("at least {:g}", *limit->min);
}

std::string degrees_cell(const Value& v) {
    if (!v.determined || v.law == Law::without_error) return "-";
    return std::isfinite(v.degrees) && v.degrees < 1e4 ? short_number(v.degrees) : "many";
}

std::string verdict_cell(const Judged& judged) {
    if (!judged.verdict) return "no limit";
    std::string text{name_of(*judged.verdict)};
    if (judged.verdict == Verdict::undecided)
        text += judged.more_hours
                    ? fmt::format(": even chance of a verdict after {} h more", short_number(*judged.more_hours))
                    : ": no longer record is likely to decide";
    if (judged.verdict == Verdict::pass) text += fmt::format(", risk {:.2g}", judged.risk);
    return text;
}

Table quantities_table(const Acceptance& test, bool with_limit) {
    Table t{.caption = with_limit
                           ? "Quantities with a limit: value with one standard uncertainty, degrees of freedom of "
                             "that, verdict, and the risk that the truth is beyond the limit."
                           : "Other quantities.",
            .header = {"quantity", "value", "degrees of freedom", "limit", "verdict", "how it was found"}};
    if (!with_limit) t.header.erase(t.header.begin() + 3, t.header.begin() + 5);
    for (const Judged& judged : test.quantities) {
        if (judged.limit.has_value() != with_limit) continue;
        const Value& v = judged.value;
        std::vector<std::string> cells{v.name, value_cell(judged), degrees_cell(v)};
        if (with_limit) cells.insert(cells.end(), {limit_cell(judged.limit), verdict_cell(judged)});
        cells.push_back(v.reason.empty() ? "-" : v.reason);
        t.rows.push_back(std::move(cells));
    }
    return t;
}

// Where a value stands between its limits: -1 at the lower, 1 at the upper one; of a single limit its share.
Figure limits_figure(const Acceptance& test) {
    Figure f = blank_figure("limits", "Values within their limits",
                            "Each quantity with a limit, in the order of the table. Dashed at 1 and -1: the limits; of "
                            "a single limit the share of it. Bars: twice the standard uncertainty.",
                            "number of the quantity", "place within the limits");
    Series values = blank_series("values", Mark::points), upper = blank_series("limit", Mark::line, true);
    Series lower = blank_series("lower limit", Mark::line, true, 1);
    double number = 0.0;
    for (const Judged& judged : test.quantities) {
        if (!judged.limit) continue;
        number += 1.0;
        const Limit& l = *judged.limit;
        const bool both = l.min && l.max && *l.max > *l.min;
        const double middle = both ? 0.5 * (*l.min + *l.max) : 0.0;
        const double half = both ? 0.5 * (*l.max - *l.min) : std::abs(l.max ? *l.max : *l.min);
        if (!judged.value.determined || !(half > 0.0)) continue;
        add_point(values, number, (judged.value.value - middle) / half);
        values.y_error.push_back(2.0 * judged.value.uncertainty / half);
    }
    for (const double x : {0.5, number + 0.5}) add_point(upper, x, 1.0), add_point(lower, x, -1.0);
    f.series = {std::move(values), std::move(upper), std::move(lower)};
    return f;
}

std::string verdict_sentence(const Acceptance& test) {
    std::vector<std::string> failed, open;
    for (const Judged& judged : test.quantities) {
        if (!judged.limit || judged.verdict == Verdict::pass) continue;
        (judged.verdict == Verdict::fail ? failed : open).push_back(judged.value.name);
    }
    if (test.plan.limits.empty())
        return fmt::format("Serial {}: the plan has no limits, so there is no verdict.", test.plan.unit.serial);
    if (failed.empty() && open.empty())
        return fmt::format(
            "Serial {} passes: {} met.", test.plan.unit.serial,
            test.plan.limits.size() == 1 ? "its limit is" : fmt::format("all {} limits are", test.plan.limits.size()));
    std::string text = fmt::format("Serial {} does not pass:", test.plan.unit.serial);
    if (!failed.empty()) text += fmt::format(" {} fail{}", fmt::join(failed, ", "), failed.size() == 1 ? "s" : "");
    if (!open.empty())
        text += fmt::format("{} {} {} not decided", failed.empty() ? "" : ";", fmt::join(open, ", "),
                            open.size() == 1 ? "is" : "are");
    return text + ".";
}

std::string lead_of(const Acceptance& test) {
    const Unit& u = test.plan.unit;
    std::string text;
    const auto say = [&](std::string_view name, const std::string& value) {
        if (!value.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
    };
    say("Type", u.type);
    say("date", u.date);
    say("operator", u.operator_name);
    say("equipment", u.equipment);
    return text + (text.empty() ? "" : ". ") + fmt::format("Each limit is judged at a risk of {:g}.", test.plan.risk) +
           (test.unit_risk ? fmt::format(" The risk that this unit lies beyond one of them is {:.2g}.", *test.unit_risk)
                           : "");
}

Section runs_section(const Acceptance& test) {
    Section s{.heading = "Runs"};
    Table t{.caption = "What was tested. XXH64 of the bytes of each file, as xxhsum -H64 gives it.",
            .header = {"run", "hours", "file", "XXH64"}};
    for (const TestedRun& run : test.runs) {
        for (const TestedLog& log : run.logs)
            t.rows.push_back({fmt::format("{}: {}", run.number, name_of(run.kind)), short_number(run.hours), log.file,
                              hex(log.checksum)});
        for (const std::string& why : run.stops)
            s.paragraphs.push_back(
                fmt::format("Run {} is no measurement, and no verdict rests on it: {}.", run.number, why));
        for (const std::string& note : run.notes) s.paragraphs.push_back(fmt::format("Run {}: {}.", run.number, note));
    }
    s.tables.push_back(std::move(t));
    return s;
}

Section meaning_section() {
    Section s{.heading = "What the quantities are"};
    Table t{.caption = "Definitions; docs/acceptance.md has the formulas.",
            .header = {"quantity", "definition", "needs"}};
    for (const QuantityInfo& q : quantities())
        t.rows.push_back({std::string{q.name}, std::string{q.words}, std::string{q.needs}});
    s.tables.push_back(std::move(t));
    s.paragraphs.push_back(
        "Pass: the probability that the truth lies beyond the limit is at most the risk, by Student's law, of a "
        "standard deviation by chi-square, of events "
        "by Poisson's, without prior. Fail: the probability that it lies within is. Neither: undecided.");
    return s;
}

}  // namespace

report::Page acceptance_page(const Acceptance& test, const std::string& command,
                             const std::vector<std::string>& earlier) {
    Page page{.title = fmt::format("Acceptance test of {}", test.plan.unit.serial),
              .verdict = verdict_sentence(test),
              .lead = lead_of(test)};
    Section summary{.heading = "Verdicts"};
    if (!test.plan.limits.empty()) {
        summary.tables.push_back(quantities_table(test, true));
        summary.figures.push_back(limits_figure(test));
    }
    summary.tables.push_back(quantities_table(test, false));
    page.sections.push_back(std::move(summary));
    if (!test.figures.empty()) page.sections.push_back({.heading = "What was measured", .figures = test.figures});
    page.data = record_json(test, command);
    if (!earlier.empty()) page.sections.push_back(trend_section(test, page.data, earlier));
    page.sections.push_back(runs_section(test));
    page.sections.push_back(meaning_section());
    Section made{.heading = "How this page was made", .is_of_page = true};
    made.paragraphs.push_back(fmt::format(
        "zlg {}, command \"{}\", plan {} (XXH64 {}). {}", ZLG_VERSION, command, test.plan.path, hex(test.plan_checksum),
        test.settings.empty() ? "All settings are those of the logs and the defaults." : "Over the logs were set:"));
    made.code = test.settings;
    page.sections.push_back(std::move(made));
    return page;
}

}  // namespace zlg::acceptance
