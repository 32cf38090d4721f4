#pragma once
// How certain a deviation is: the law that the estimated variance follows.

#include <cstdint>

#include <zlg/deviations/deviation_kind.hpp>
#include <zlg/deviations/variance_law.hpp>

namespace zlg::deviations {

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

// For rate noise of spectrum f^noise.
//
// noise   2 white angle (quantisation), 1, 0 white rate (angle random walk), -1 (bias instability), -2 rate random
// walk,
//         and for Hadamard deviations -3 and -4 (others: -2 is taken).
// n_intervals  without gaps.
// source  the covariances of all pairs of terms, and for the skewness of all triples, as in C. Greenhall, W. Riley,
//         "Uncertainty of stability variances based on finite differences", PTTI 2003; with parts, and for totdev,
//         the eigenvalues of that covariance.
[[nodiscard]] VarianceLaw variance_law(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals);

// Of intervals: beyond it the quantiles of the laws are no numbers.
inline constexpr double max_confidence = 0.999999;

// errors  SeriesError: a confidence that is not more than 0 and at most max_confidence.
void check_confidence(double confidence);

// Two-sided, equal tails. From a confidence of 0.37 on it holds the deviation itself.
//
// errors  as check_confidence.
[[nodiscard]] Interval confidence_interval(double deviation, const VarianceLaw& law, double confidence);

// Expectation of the total variance over that of the variance without mirroring, from the covariance of what is
// mirrored; 1 for other kinds.
[[nodiscard]] double total_variance_bias(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals);

}  // namespace zlg::deviations
