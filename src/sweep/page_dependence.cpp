// The part of the page of a sweep that says what its numbers depend on.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/sensitivity.hpp>
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

// Of Saltelli's design.
std::size_t n_rows(const Description& d) { return static_cast<std::size_t>(d.n_gyros) / (d.parameters.size() + 2); }

report::Table correlation_table(const Description& d, const Columns& c) {
    const std::size_t n = c.metrics.front().size();
    const std::size_t n_drawn = d.sensitivity ? std::min(n, independent_gyros(n_rows(d), d.parameters.size())) : n;
    report::Table t{.caption = fmt::format("Spearman's rank correlation of {} good gyros; where limits stand on both "
                                           "sides, of the distance from their "
                                           "middle. Between independent numbers {} is passed once in twenty times. A "
                                           "dependence that rises and falls does not show.",
                                           n, short_number(chance_correlation(n_drawn))),
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

SobolDesign design_of(const Description& d, const Rows& rows, std::size_t metric) {
    const std::size_t n_kinds = d.parameters.size() + 2;
    SobolDesign design;
    design.mixed.resize(d.parameters.size());
    for (std::size_t row = 0; row < n_rows(d); ++row)
        for (std::size_t kind = 0; kind < n_kinds; ++kind) {
            const auto found = rows.find(static_cast<std::int64_t>(row * n_kinds + kind));
            const bool is_good = found != rows.end() && found->second.status == Status::good;
            auto& column = kind == 0 ? design.a : kind + 1 == n_kinds ? design.b : design.mixed[kind - 1];
            column.push_back(is_good ? found->second.metrics[metric] : NAN);
        }
    return design;
}

std::string with_interval(double value, double low, double high) {
    return fmt::format("{} ({} to {})", fixed_number(value, 3), fixed_number(low, 3), fixed_number(high, 3));
}

report::Table sobol_table(const Description& d, const Rows& rows, std::size_t metric) {
    const SobolIndices found = sobol_indices(design_of(d, rows, metric));
    report::Table t{.caption = fmt::format("Sobol's indices of {}, with intervals of 95 %, from {} rows of the design; "
                                           "{} rows hold a gyro that failed and are left out. "
                                           "The noise of each run counts as an interaction of all.",
                                           d.metrics[metric].name, found.n_rows, found.n_dropped),
                    .header = {"parameter", "alone", "with interactions", "says the sample"}};
    for (std::size_t k = 0; k < found.inputs.size(); ++k) {
        const SobolIndex& i = found.inputs[k];
        const bool decides = i.total_high - i.total_low < 0.5;
        t.rows.push_back(row(d.parameters[k].keys.front(), with_interval(i.first, i.first_low, i.first_high),
                             with_interval(i.total, i.total_low, i.total_high),
                             !decides            ? "nothing yet: more gyros are needed"
                             : i.first_low > 0.0 ? "it matters"
                                                 : "alone no more than chance"));
    }
    return t;
}

}  // namespace

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() || unit == "1" ? name : fmt::format("{}, {}", name, unit);
}

Columns columns_of(const Gyros& gyros, const Rows& rows) {
    const Description& d = gyros.description();
    std::map<std::string, std::string> units;
    for (const config::KeyInfo& key : config::describe_keys()) units[key.section + "." + key.name] = key.unit;
    Columns c;
    c.metrics.resize(d.metrics.size());
    std::vector<std::vector<double>> drawn(d.parameters.size());
    for (const auto& [gyro, row] : rows) {
        if (row.status != Status::good) continue;
        const std::vector<Value> values = gyros.values(gyro);
        c.gyros.push_back(gyro);
        for (std::size_t k = 0; k < drawn.size(); ++k)
            if (const double* number = std::get_if<double>(&values[k])) drawn[k].push_back(*number);
        for (std::size_t k = 0; k < c.metrics.size(); ++k) c.metrics[k].push_back(row.metrics[k]);
    }
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        if (drawn[k].size() != c.metrics.front().size()) continue;
        c.names.push_back(with_unit(d.parameters[k].keys.front(), units[d.parameters[k].keys.front()]));
        c.parameters.push_back(std::move(drawn[k]));
    }
    return c;
}

Limit limit_of(const Metric& m) {
    if (m.min && m.max) return {"half the width of the limits", 1.0, 0.5 * (*m.min + *m.max), true};
    if (m.min) return {"lower limit", -1.0, 0.0, false};
    return {"upper limit", 1.0, 0.0, false};
}

Section dependence(const Gyros& gyros, const Rows& rows, const Columns& c) {
    const Description& d = gyros.description();
    Section s{.heading = "What the numbers depend on"};
    s.tables.push_back(correlation_table(d, c));
    if (d.sensitivity)
        for (std::size_t m = 0; m < d.metrics.size(); ++m) s.tables.push_back(sobol_table(d, rows, m));
    s.figures = response_figures(d, c);
    return s;
}

}  // namespace zlg::sweep
