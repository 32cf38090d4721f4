#include <zlg/sweep/sweep_page.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/statistics.hpp>

#include "page_parts.hpp"

namespace zlg::sweep {
namespace {

using namespace report;

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
        page.sections.front().figures.push_back(yield_figure(d.metrics[k], columns.metrics[k], summary.gyros, k));
    }
    if (!columns.parameters.empty() && summary.failed < summary.gyros)
        page.sections.insert(page.sections.begin() + 1, dependence(d, columns));
    page.sections.push_back({.heading = "How this page was made",
                             .paragraphs = {"Saved as sweep.toml, the lines below make it again: zlg sweep sweep.toml "
                                            "--out results.h5 --page page.html."},
                             .code = to_toml(d)});
    return page;
}

}  // namespace zlg::sweep
