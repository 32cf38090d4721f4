#pragma once
// Mean squares over records, or pieces of them, that are continued by mirroring.

#include <cstdint>

#include "difference_sums.hpp"

namespace zlg::deviations {

// Second differences about every border but the first and the last; the angle is doubly reflected: the rate goes on
// backwards at both ends.
[[nodiscard]] TermSum total_sum(const RecordView& view, std::int64_t m);

// Pieces of 3m values, freed of the line through the means of their halves and mirrored at both ends: mean over the 6m
// starts of the squared second difference of means over m. Values are the angle (mtotdev; results of a rate, so divided
// by m^2) or the rate (htotdev). Pieces with a missing value are left out.
enum class PieceOf { angle, rate };
[[nodiscard]] TermSum mirrored_pieces_sum(const RecordView& view, PieceOf what, std::int64_t m, int threads);

}  // namespace zlg::deviations
