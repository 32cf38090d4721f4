#include <zlg/sweep/sweep_page.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/statistics.hpp>
#include <zlg/sweep/tolerances.hpp>

#include "page_parts.hpp"

namespace zlg::sweep {
namespace {

using namespace report;

constexpr double wanted_yield = 0.95;
constexpr std::size_t n_worst = 10;

std::string percent(double part) { return fmt::format("{:.1f} %", 100.0 * part); }

std::string interval(const Yield& y) { return fmt::format("{} to {}", percent(y.low), percent(y.high)); }

std::string limits(const Metric& m) {
    if (m.min && m.max) return fmt::format("{} to {}", short_number(*m.min), short_number(*m.max));
    if (m.min) return fmt::format("at least {}", short_number(*m.min));
    return m.max ? fmt::format("at most {}", short_number(*m.max)) : "none";
}

report::Table summary_table(const Summary& summary) {
    report::Table t{.caption = "Of the gyros that did not fail. 5 %, 50 % and 95 % are quantiles.",
                    .header = {"number", "mean", "sd", "5 %", "50 %", "95 %"}};
    for (const MetricSummary& m : summary.metrics)
        t.rows.push_back(row(with_unit(m.metric.name, unit_of(m.metric.name)), m.mean.value_or(NAN), m.sd.value_or(NAN),
                             m.p05.value_or(NAN), m.p50.value_or(NAN), m.p95.value_or(NAN)));
    return t;
}

report::Table yield_table(const Summary& summary) {
    report::Table t{
        .caption =
            "Yield: the part of all gyros, the failed ones among them, that passes. The interval is Wilson's, of 95 %.",
        .header = {"number", "limits", "passed", "gyros", "yield", "interval"}};
    const auto add = [&](const std::string& name, const std::string& allowed, const Yield& y) {
        t.rows.push_back(row(name, allowed, y.passed, y.gyros, percent(y.value), interval(y)));
    };
    for (const MetricSummary& m : summary.metrics)
        if (m.yield) add(m.metric.name, limits(m.metric), *m.yield);
    if (summary.yield) add("all together", "", *summary.yield);
    return t;
}

Figure yield_figure(const Metric& metric, const std::vector<double>& values, std::int64_t n_gyros, std::size_t k) {
    const Limit limit = limit_of(metric);
    Figure f = blank_figure(fmt::format("yield-{}", k), fmt::format("Yield against the limit of {}", metric.name),
                            "The part of all gyros that passes if the limit were there. Dashed: the interval of 95 %.",
                            with_unit(limit.label, unit_of(metric.name)), "yield");
    std::vector<double> sorted;
    for (const double value : values) sorted.push_back(limit.sign * limit.of(value));
    std::ranges::sort(sorted);
    Series yield = blank_series("yield");
    Series low = blank_series("95 % interval", Mark::line, true, 0);
    Series high = blank_series("", Mark::line, true, 0);
    std::int64_t passed = 0;
    for (const double held : sorted) {
        const Yield y = yield_of(++passed, n_gyros);
        add_point(yield, limit.sign * held, y.value);
        add_point(low, limit.sign * held, y.low);
        add_point(high, limit.sign * held, y.high);
    }
    for (const Series* s : {&yield, &low, &high}) f.series.push_back(thin(*s, points_shown));
    return f;
}

Figure distribution_figure(const Metric& metric, const std::vector<double>& values, std::size_t k) {
    Figure f = blank_figure(fmt::format("distribution-{}", k), fmt::format("Distribution of {}", metric.name),
                            fmt::format("Good gyros in equal bins. Limits: {}.", limits(metric)),
                            with_unit(metric.name, unit_of(metric.name)), "gyros");
    const int n_bins = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(values.size()))), 5, 60);
    f.series = {histogram("gyros", values, n_bins)};
    return f;
}

// Yield where one parameter, or all, stay within a part of the way from the nominal value to the ends of the range.
Figure tolerance_figure(const Description& d, const Placement& placement) {
    const std::vector<Range>& all = placement.ranges();
    Figure f = blank_figure(
        "tolerances", "Yield against tolerance",
        "The yield of the gyros whose parameter lies within this part of the way from the value of the base "
        "to the ends of its range; the others have their full ranges, but for \"all\".",
        "part of the way", "yield");
    for (std::size_t p = 0; p <= all.size(); ++p) {
        const bool is_all = p == all.size();
        Series s = blank_series(is_all ? "all" : d.parameters[all[p].parameter].keys.front());
        for (int k = 1; k <= 20; ++k) {
            std::vector<double> ways(all.size(), is_all ? 0.05 * k : 1.0);
            if (!is_all) ways[p] = 0.05 * k;
            const auto y = placement.yield_within(ways);
            if (y && y->gyros >= 10) add_point(s, 0.05 * k, y->value);
        }
        if (!s.x.empty()) f.series.push_back(std::move(s));
    }
    return f;
}

std::string tolerance_sentence(const Tolerances& t) {
    if (!t.yield) return "No gyro lies within the ranges.";
    const std::string what = fmt::format("{} of {} gyros within these tolerances pass: {} (interval {})",
                                         t.yield->passed, t.yield->gyros, percent(t.yield->value), interval(*t.yield));
    if (!t.is_reached)
        return what + fmt::format(
                          "; a yield of {} is not reached with the gyros that are left: the sample decides nothing, "
                          "draw from narrower ranges or run more",
                          percent(wanted_yield));
    return what +
           ". Chosen from the same gyros the yield is a little too good: verify it by a sweep over these tolerances.";
}

Section tolerance_section(const Description& d, const Placement& placement) {
    const Tolerances t = tolerances(placement, wanted_yield);
    Section s{.heading = "Tolerances to be held"};
    report::Table table{
        .caption = fmt::format(
            "For a yield of {} within all limits; the ranges were drawn in one after the other. The range of a normal "
            "law goes from the least to the greatest value of these gyros.",
            percent(wanted_yield)),
        .header = {"parameter", "from", "to", "drawn from", "drawn to", "part of the range"}};
    for (std::size_t k = 0; k < t.ways.size(); ++k) {
        const Range& r = placement.ranges()[k];
        table.rows.push_back(row(d.parameters[r.parameter].keys.front(), r.below(t.ways[k]), r.above(t.ways[k]), r.min,
                                 r.max, percent(t.ways[k])));
    }
    s.paragraphs = {tolerance_sentence(t)};
    s.tables = {std::move(table)};
    s.figures = {tolerance_figure(d, placement)};
    return s;
}

Section worst_section(const Gyros& gyros, const Rows& rows) {
    Section s{.heading = "Gyros to look at",
              .paragraphs = {"Those that failed, then those farthest from the middle of the first number. Each line "
                             "runs one alone, with the same fingerprint."}};
    report::Table t{.caption = "In the order of the lines below.", .header = {"gyro", "fingerprint", "why"}};
    const Metric& first = gyros.description().metrics.front();
    for (const Row* r : worst(gyros.description(), rows, n_worst)) {
        t.rows.push_back(row(r->gyro, r->fingerprint,
                             r->status == Status::good
                                 ? fmt::format("{} = {}", first.name, short_number(r->metrics.front()))
                                 : r->reason));
        s.code += fmt::format("{}\n", gyros.command(r->gyro));
    }
    s.tables = {std::move(t)};
    return s;
}

std::string verdict(const Summary& summary) {
    const std::string failed = summary.failed == 0 ? "none failed" : fmt::format("{} failed", summary.failed);
    if (summary.yield)
        return fmt::format("{} of {} gyros pass: a yield of {}, with an interval of {}; {}.", summary.yield->passed,
                           summary.gyros, percent(summary.yield->value), interval(*summary.yield), failed);
    const MetricSummary& m = summary.metrics.front();
    return fmt::format("{} gyros, {}; {} is {} in the middle and lies between {} and {} in nine of ten.", summary.gyros,
                       failed, m.metric.name, short_number(m.p50.value_or(NAN)), short_number(m.p05.value_or(NAN)),
                       short_number(m.p95.value_or(NAN)));
}

}  // namespace

report::Page sweep_summary(const Gyros& gyros, const Rows& rows) {
    const Description& d = gyros.description();
    const Summary summary = summary_of(d, rows);
    Section numbers{.heading = "What came out", .tables = {summary_table(summary)}};
    if (summary.yield) numbers.tables.push_back(yield_table(summary));
    return {.title = "Many Zeeman laser gyros",
            .verdict = verdict(summary),
            .lead = fmt::format("{} of {} gyros of one description, each with its own values and its own noise.",
                                summary.gyros, d.n_gyros),
            .sections = {std::move(numbers), worst_section(gyros, rows)}};
}

report::Page sweep_page(const Gyros& gyros, const Rows& rows) {
    const Description& d = gyros.description();
    const Summary summary = summary_of(d, rows);
    const Columns columns = columns_of(gyros, rows);
    report::Page page = sweep_summary(gyros, rows);
    for (std::size_t k = 0; k < d.metrics.size() && summary.failed < summary.gyros; ++k) {
        if (!varies(columns.metrics[k])) continue;
        std::vector<Figure>& figures = page.sections.front().figures;
        figures.push_back(distribution_figure(d.metrics[k], columns.metrics[k], k));
        figures.push_back(yield_figure(d.metrics[k], columns.metrics[k], summary.gyros, k));
    }
    std::vector<Section> causes;
    if (summary.yield) {
        const Placement placement{gyros, rows};
        if (!placement.ranges().empty()) causes.push_back(tolerance_section(d, placement));
    }
    if (!columns.parameters.empty() && summary.failed < summary.gyros) causes.push_back(dependence(d, columns));
    page.sections.insert(page.sections.begin() + 1, causes.begin(), causes.end());
    page.sections.push_back({.heading = "How this page was made",
                             .paragraphs = {"Saved as sweep.toml, the lines below make it again: zlg sweep sweep.toml "
                                            "--out results.h5 --page page.html."},
                             .code = to_toml(d)});
    return page;
}

}  // namespace zlg::sweep
