#pragma once
// What the gyros of a sweep say together. Those that failed are counted, and are in no mean.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <zlg/sweep/results.hpp>

namespace zlg::sweep {

// Part of all gyros, the failed ones among them, that passes, with an interval of 95 %.
struct Yield {
    std::int64_t passed = 0;
    std::int64_t gyros = 0;
    double value = 0.0;
    double low = 0.0;
    double high = 1.0;
};

// With the interval of E. B. Wilson (J. Am. Stat. Assoc. 22, 1927, 209); gyros 0: nothing is known.
[[nodiscard]] Yield yield_of(std::int64_t passed, std::int64_t gyros);

// The quantile p of sorted numbers, with straight lines between them: number (n - 1) p, from 0.
//
// sorted  one at least.
[[nodiscard]] double quantile(std::span<const double> sorted, double p);

// Of the good gyros; nothing where there are none, no sd of one.
struct MetricSummary {
    Metric metric;
    std::optional<double> mean;
    std::optional<double> sd;  // with n - 1
    std::optional<double> p05, p50, p95;
    std::optional<Yield> yield;  // where the metric has a limit
};

struct Summary {
    std::int64_t gyros = 0;  // that are there
    std::int64_t failed = 0;
    std::vector<MetricSummary> metrics;
    std::optional<Yield> yield;  // of all limits together, where there are any
};

// Whether a number lies within the limits of its metric.
[[nodiscard]] bool passes(const Metric& metric, double value);

// Whether a gyro is good and within all limits.
[[nodiscard]] bool passes_all(const Description& description, const Row& row);

[[nodiscard]] Summary summary_of(const Description& description, const Rows& rows);

// The gyros to look at first: those that failed, then those farthest beyond the middle of the first metric. At most n.
[[nodiscard]] std::vector<const Row*> worst(const Description& description, const Rows& rows, std::size_t n);

// Spearman's rank correlation of two columns; equal values share the mean of their ranks. Nothing with fewer than three
// rows, or where a column does not vary.
[[nodiscard]] std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y);

// |rank correlation| beyond which two independent columns of n rows lie with a probability of 5 %, by the normal
// law: 1.96/sqrt(n - 1).
[[nodiscard]] double chance_correlation(std::size_t n);

}  // namespace zlg::sweep
