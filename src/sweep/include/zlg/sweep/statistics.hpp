#pragma once
// What the gyros of a sweep say together. Those that failed are counted, and are in no mean.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
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
    double worth = 0.0;  // as many independent gyros would say as much
};

// Counts a yield, with the interval of E. B. Wilson (J. Am. Stat. Assoc. 22, 1927, 209).
//
// With sensitivity, the gyros of one row of Saltelli's design share nearly all of their values: the rows are clusters
// of a sample, and the ratio estimate for clusters (W. G. Cochran, Sampling Techniques, 3rd edition, 1977,
// section 3.12) says how much a gyro is worth. With r rows, of which row i has m_i gyros and a_i that pass,
//
//   p = sum a_i/sum m_i,   v = r/(r - 1) sum (a_i - p m_i)^2/(sum m_i)^2                                  (1)
//
// Were all gyros of a row to do the same, it would be v1 = p (1 - p)/r', r' = (sum m_i)^2/sum m_i^2. What v says rests
// on the rows in which a gyro does what most do not: with k of them, 8 more are presumed whose gyros pass or fail
// together,
//
//   var p = (k v + 8 v1)/(k + 8)                                                                         (2)
//
// and the interval is Wilson's of p (1 - p)/var p independent gyros, r' at least and all at most; r' where all or none
// pass.
class YieldCount {
public:
    explicit YieldCount(const Description& description);

    // Counts a gyro, as one that does not pass.
    void add(std::int64_t gyro);
    // A gyro that was added passes after all.
    void pass(std::int64_t gyro);

    // gyros is 0 where none was added.
    [[nodiscard]] Yield yield() const;

private:
    struct DesignRow {
        std::int64_t gyros = 0;
        std::int64_t passed = 0;
    };

    [[nodiscard]] DesignRow& row_of(std::int64_t gyro);
    [[nodiscard]] double worth() const;

    std::int64_t gyros_a_row_;  // 1: each is for itself, and no rows are kept
    std::vector<DesignRow> rows_;
    std::int64_t n_rows_ = 0, n_rows_with_passed_ = 0, n_rows_with_failed_ = 0;
    std::int64_t gyros_ = 0, passed_ = 0;
    std::int64_t gyros_sq_ = 0, gyros_passed_ = 0, passed_sq_ = 0;  // sums over rows of m^2, m a, a^2
};

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

}  // namespace zlg::sweep
