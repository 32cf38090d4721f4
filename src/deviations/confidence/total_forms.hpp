#pragma once
// The total variances as quadratic forms of the record's second differences, and what follows: bias and law.

#include <cstdint>

#include <zlg/deviations/deviation_kind.hpp>
#include <zlg/deviations/variance_law.hpp>

namespace zlg::deviations {

// Expectation of the total variance over that of the variance without mirroring, for rate noise f^noise.
[[nodiscard]] double exact_total_bias(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals);

// Of a record of which m is at most a half (totdev) or a third. Up to 14 averaging times of starts with parts; beyond,
// degrees of freedom and skewness, which grow evenly with the length.
[[nodiscard]] VarianceLaw total_law(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals);

}  // namespace zlg::deviations
