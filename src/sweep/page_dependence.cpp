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
    return {.heading = "What the numbers depend on", .tables = {correlation_table(d, c)}};
}

}  // namespace zlg::sweep
