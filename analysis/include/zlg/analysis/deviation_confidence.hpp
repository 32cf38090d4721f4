#pragma once
// How certain a deviation is: the law that the estimated variance follows.

#include <cstdint>

#include <zlg/analysis/deviation_kind.hpp>

namespace zlg::analysis {

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

// Mean, variance and skewness of an estimated variance are right. Of the chi-square law p = edf; a sum of squares that are
// correlated is more skew, p < edf: with edf alone intervals at long tau would hold the truth too often.
struct VarianceLaw {
    double edf = 1.0;         // equivalent degrees of freedom 2 <V>^2/var V
    double skewness_p = 1.0;  // 8/skewness^2
};

// For rate noise of spectrum f^noise.
//
// noise   2 white angle (quantisation), 1, 0 white rate (angle random walk), -1 (bias instability), -2 rate random walk,
//         and for Hadamard deviations -3 and -4 (others: -2 is taken).
// n_intervals  without gaps.
// source  the sum over the covariances of all pairs of terms, and for the skewness of all triples, as in C. Greenhall, W. Riley,
//         "Uncertainty of stability variances based on finite differences", PTTI 2003; total deviations: tables of NIST Special
//         Publication 1065, chi-square.
[[nodiscard]] VarianceLaw variance_law(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals);

// Of intervals: beyond it the quantiles of the laws are no numbers.
inline constexpr double most_confidence = 0.999999;

// errors  SeriesError: a confidence that is not more than 0 and at most most_confidence.
void check_confidence(double confidence);

// Two-sided, equal tails.
//
// errors  as check_confidence.
[[nodiscard]] Interval confidence_interval(double deviation, const VarianceLaw& law, double confidence);

// Expectation of the total variance over that of the variance without mirroring; 1 for other kinds.
[[nodiscard]] double total_variance_bias(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals);

}  // namespace zlg::analysis
