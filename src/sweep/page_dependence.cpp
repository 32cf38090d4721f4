// The part of the page of a sweep that says what its numbers depend on.
#include <algorithm>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/statistics.hpp>

#include "page_parts.hpp"

namespace zlg::sweep {

using namespace report;

namespace {

constexpr std::size_t max_figures = 24;  // of the responses

// Median and 5..95 % in bins of equally many gyros.
Series binned(const std::vector<double>& x, const std::vector<double>& y) {
    Series s = blank_series("median, and 5 to 95 %", Mark::line);
    std::vector<std::pair<double, double>> pairs;
    for (std::size_t k = 0; k < x.size(); ++k) pairs.emplace_back(x[k], y[k]);
    std::ranges::sort(pairs);
    const std::size_t n_bins = std::clamp<std::size_t>(pairs.size() / 20, 1, 12);
    for (std::size_t bin = 0; bin < n_bins; ++bin) {
        const std::size_t first = bin * pairs.size() / n_bins;
        const std::size_t end = (bin + 1) * pairs.size() / n_bins;
        std::vector<double> values;
        for (std::size_t k = first; k < end; ++k) values.push_back(pairs[k].second);
        if (values.empty()) continue;
        std::ranges::sort(values);
        const double median = quantile(values, 0.5);
        add_point(s, pairs[(first + end) / 2].first, median);
        s.y_error.push_back(quantile(values, 0.95) - median);
        s.y_error_down.push_back(median - quantile(values, 0.05));
    }
    return s;
}

std::vector<Figure> response_figures(const Description& d, const Columns& c) {
    std::vector<Figure> figures;
    for (std::size_t m = 0; m < c.metrics.size(); ++m)
        for (std::size_t p = 0; p < c.parameters.size() && figures.size() < max_figures; ++p) {
            if (!varies(c.metrics[m]) || !varies(c.parameters[p])) continue;
            Figure f = blank_figure(fmt::format("response-{}-{}", m, p),
                                    fmt::format("{} by {}", d.metrics[m].name, c.names[p]),
                                    "Each point is a gyro; the line is the median of equally many gyros.", c.names[p],
                                    with_unit(d.metrics[m].name, unit_of(d.metrics[m].name)));
            Series points = blank_series("gyros", Mark::points);
            const std::size_t stride = c.parameters[p].size() / points_shown + 1;
            for (std::size_t k = 0; k < c.parameters[p].size(); k += stride)
                add_point(points, c.parameters[p][k], c.metrics[m][k]);
            f.series = {std::move(points), binned(c.parameters[p], c.metrics[m])};
            figures.push_back(std::move(f));
        }
    return figures;
}

report::Table correlation_table(const Description& d, const Columns& c) {
    const std::size_t n = c.metrics.front().size();
    report::Table t{.caption = fmt::format("Spearman's rank correlation of {} good gyros; where limits stand on both "
                                           "sides, of the distance from their "
                                           "middle. Between independent numbers {} is passed once in twenty times. A "
                                           "dependence that rises and falls does not show.",
                                           n, short_number(chance_correlation(n))),
                    .header = {"parameter"}};
    for (const Metric& m : d.metrics) t.header.push_back(m.name);
    for (std::size_t p = 0; p < c.parameters.size(); ++p) {
        std::vector<std::string> line{c.names[p]};
        for (std::size_t m = 0; m < d.metrics.size(); ++m) {
            const Limit limit = limit_of(d.metrics[m]);
            std::vector<double> held;
            for (const double value : c.metrics[m]) held.push_back(limit.of(value));
            line.push_back(fixed_number(rank_correlation(c.parameters[p], held).value_or(NAN), 2));
        }
        t.rows.push_back(std::move(line));
    }
    return t;
}

}  // namespace

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() || unit == "1" ? name : fmt::format("{}, {}", name, unit);
}

Columns columns_of(const Gyros& gyros, const Rows& rows) {
    const Description& d = gyros.description();
    Columns c;
    c.metrics.resize(d.metrics.size());
    std::vector<std::vector<double>> drawn(d.parameters.size());
    for (const auto& [gyro, row] : rows) {
        if (row.status != Status::good) continue;
        const std::vector<Value> values = gyros.values(gyro);
        for (std::size_t k = 0; k < drawn.size(); ++k)
            if (const double* number = std::get_if<double>(&values[k])) drawn[k].push_back(*number);
        for (std::size_t k = 0; k < c.metrics.size(); ++k) c.metrics[k].push_back(row.metrics[k]);
    }
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        if (drawn[k].size() != c.metrics.front().size()) continue;
        c.names.push_back(with_unit(d.parameters[k].keys.front(), config::unit_of(d.parameters[k].keys.front())));
        c.parameters.push_back(std::move(drawn[k]));
    }
    return c;
}

Limit limit_of(const Metric& m) {
    if (m.min && m.max) return {"half the width of the limits", 1.0, 0.5 * (*m.min + *m.max), true};
    if (m.min) return {"lower limit", -1.0, 0.0, false};
    return {"upper limit", 1.0, 0.0, false};
}

Section dependence(const Description& d, const Columns& c) {
    Section s{.heading = "What the numbers depend on"};
    s.tables.push_back(correlation_table(d, c));
    s.figures = response_figures(d, c);
    return s;
}

}  // namespace zlg::sweep
