#include <zlg/sweep/statistics.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace zlg::sweep {
namespace {

constexpr double sigmas_of_95_percent = 1.959963984540054;  // the 97.5 % quantile of the normal law

bool is_good(const Row& row) { return row.status == Status::good; }

bool has_limit(const Metric& metric) { return metric.min || metric.max; }

std::vector<double> good_values(const Rows& rows, std::size_t metric) {
    std::vector<double> values;
    for (const auto& [gyro, row] : rows)
        if (is_good(row)) values.push_back(row.metrics[metric]);
    return values;
}

// In two passes, so that nothing is lost where the spread is small beside the mean.
void add_moments(MetricSummary& summary, const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double sum = 0.0;
    for (const double value : values) sum += value;
    const double mean = sum / n;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    summary.mean = mean;
    if (values.size() > 1) summary.sd = std::sqrt(squares / (n - 1.0));
}

template <class Passes> Yield yield_where(const Rows& rows, const Passes& is_passed) {
    return yield_of(std::ranges::count_if(rows, [&](const auto& row) { return is_passed(row.second); }),
                    std::ssize(rows));
}

MetricSummary summary_of(const Description& d, const Rows& rows, std::size_t k) {
    const Metric& metric = d.metrics[k];
    MetricSummary summary{.metric = metric};
    std::vector<double> values = good_values(rows, k);
    if (has_limit(metric) && !rows.empty())
        summary.yield = yield_where(rows, [&](const Row& r) { return is_good(r) && passes(metric, r.metrics[k]); });
    if (values.empty()) return summary;
    add_moments(summary, values);
    std::ranges::sort(values);
    summary.p05 = quantile(values, 0.05);
    summary.p50 = quantile(values, 0.50);
    summary.p95 = quantile(values, 0.95);
    return summary;
}

// From 1; equal values share the mean of their ranks.
std::vector<double> ranks(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return values[k]; });
    std::vector<double> rank(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        for (std::size_t k = first; k < end; ++k) rank[order[k]] = 0.5 * static_cast<double>(first + 1 + end);
        first = end;
    }
    return rank;
}

}  // namespace

Yield yield_of(std::int64_t passed, std::int64_t gyros) {
    if (gyros == 0) return {};
    const auto n = static_cast<double>(gyros);
    const double p = static_cast<double>(passed) / n;
    const double z = sigmas_of_95_percent;
    const double centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)) / (1.0 + z * z / n);
    // At the ends the limit is exact, and is not left to rounding.
    return {passed, gyros, p, passed == 0 ? 0.0 : centre - half, passed == gyros ? 1.0 : centre + half};
}

double quantile(std::span<const double> sorted, double p) {
    const double place = p * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

bool passes(const Metric& metric, double value) {
    return (!metric.min || value >= *metric.min) && (!metric.max || value <= *metric.max);
}

bool passes_all(const Description& description, const Row& row) {
    if (!is_good(row)) return false;
    for (std::size_t k = 0; k < row.metrics.size(); ++k)
        if (!passes(description.metrics[k], row.metrics[k])) return false;
    return true;
}

Summary summary_of(const Description& description, const Rows& rows) {
    Summary summary{.gyros = static_cast<std::int64_t>(rows.size())};
    for (const auto& [gyro, row] : rows)
        if (!is_good(row)) ++summary.failed;
    for (std::size_t k = 0; k < description.metrics.size(); ++k)
        summary.metrics.push_back(summary_of(description, rows, k));
    if (!rows.empty() && std::ranges::any_of(description.metrics, has_limit))
        summary.yield = yield_where(rows, [&](const Row& row) { return passes_all(description, row); });
    return summary;
}

std::vector<const Row*> worst(const Description& description, const Rows& rows, std::size_t n) {
    const Summary summary = summary_of(description, rows);
    const double middle = summary.metrics.front().p50.value_or(0.0);
    std::vector<const Row*> order;
    for (const auto& [gyro, row] : rows) order.push_back(&row);
    std::ranges::stable_sort(order, [&](const Row* a, const Row* b) {
        if (is_good(*a) != is_good(*b)) return !is_good(*a);
        return is_good(*a) && std::abs(a->metrics.front() - middle) > std::abs(b->metrics.front() - middle);
    });
    order.resize(std::min(n, order.size()));
    return order;
}

std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.size() < 3) return std::nullopt;
    const std::vector<double> a = ranks(x);
    const std::vector<double> b = ranks(y);
    const double middle = 0.5 * static_cast<double>(x.size() + 1);
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        ab += (a[k] - middle) * (b[k] - middle);
        aa += (a[k] - middle) * (a[k] - middle);
        bb += (b[k] - middle) * (b[k] - middle);
    }
    if (!(aa > 0.0 && bb > 0.0)) return std::nullopt;
    return ab / std::sqrt(aa * bb);
}

double chance_correlation(std::size_t n) { return 1.96 / std::sqrt(static_cast<double>(n) - 1.0); }

}  // namespace zlg::sweep
