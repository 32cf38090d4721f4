#pragma once
// Averaging times, as whole numbers m of sampling intervals: tau = m/rate.

#include <cstdint>
#include <span>
#include <vector>

#include <zlg/deviations/deviation_kind.hpp>

namespace zlg::deviations {

// 1, 2, 4, 8, ... up to `largest`.
[[nodiscard]] std::vector<std::int64_t> octave_factors(std::int64_t largest);

// 1, 2, 4, 10, 20, 40, 100, ...
[[nodiscard]] std::vector<std::int64_t> decade_factors(std::int64_t largest);

// Evenly spaced in log m, rounded, each once. errors  SeriesError: per_decade not 1..10000.
[[nodiscard]] std::vector<std::int64_t> log_factors(int per_decade, std::int64_t largest);

[[nodiscard]] std::vector<std::int64_t> all_factors(std::int64_t largest);

// The nearest whole number of intervals to each tau, in rising order, each once; what was made of a tau is to be read
// from the result.
//
// errors  SeriesError: a tau that is not a positive number, nearer to 0 than to one interval, or over `largest`
// intervals.
[[nodiscard]] std::vector<std::int64_t> nearest_factors(std::span<const double> taus_s, double rate_hz,
                                                        std::int64_t largest);

// The longest averaging of which a record of n_intervals without gaps has a term: a half or a third of it.
[[nodiscard]] std::int64_t largest_factor(DeviationKind kind, std::int64_t n_intervals);

}  // namespace zlg::deviations
