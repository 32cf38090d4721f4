#pragma once
// From sums of squares to points of a curve.

#include <cstdint>
#include <vector>

#include <zlg/deviations/deviation_curve.hpp>
#include <zlg/deviations/noise_identification.hpp>

#include "sums/difference_sums.hpp"

namespace zlg::deviations {

struct MeasuredSum {
    std::int64_t m = 1;
    TermSum sum;
    std::int64_t possible_terms = 0;  // without gaps
};

// steps  what is known of the noise; none where it is given, or too short a record: then white rate noise is taken.
[[nodiscard]] DeviationCurve curve_of(DeviationKind kind, const SeriesKind& what, std::int64_t n_intervals,
                                      const std::vector<MeasuredSum>& sums, const std::vector<NoiseStep>& steps,
                                      const DeviationOptions& options);

// Terms of a record of n_intervals without gaps.
[[nodiscard]] std::int64_t possible_terms(DeviationKind kind, std::int64_t m, std::int64_t n_intervals);

}  // namespace zlg::deviations
