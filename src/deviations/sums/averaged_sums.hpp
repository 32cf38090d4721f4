#pragma once
// Mean squares of second differences of the averaged angle: the modified Allan variance.

#include <cstdint>
#include <span>
#include <vector>

#include "difference_sums.hpp"

namespace zlg::deviations {

// Of differences of rates, as TermSum says; terms begin at every border.
//
//   D_i = 1/m sum_{j<m} d_{i+j},  d_j = (x_{j+2m} - 2 x_{j+m} + x_j)/m
//
// Increments and rates with gaps: each half of D_i is a mean of the known samples under the triangular weights that it
// has without gaps; it counts where least_known_ratio of the weights is known. Phase: D_i is the mean of the d_j that
// are known, where least_known_ratio of them is.
[[nodiscard]] std::vector<TermSum> averaged_sums(const RecordView& view, std::span<const std::int64_t> factors,
                                                 int threads);

// Terms begin .. end-1 of one averaging time.
[[nodiscard]] TermSum averaged_sum(const RecordView& view, std::int64_t m, std::int64_t begin, std::int64_t end);

}  // namespace zlg::deviations
