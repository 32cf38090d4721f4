#pragma once
// Deviations of a record, with what is known of their uncertainty.

#include <cstdint>
#include <span>

#include <zlg/deviations/angle_record.hpp>
#include <zlg/deviations/deviation_curve.hpp>
#include <zlg/deviations/deviation_kind.hpp>

namespace zlg::deviations {

// Deviation of the record at averaging factors m.
//
//   increments and rate with gaps: a window counts where least_known_ratio of it is known; its rate is the mean of the
//   known ones. Each difference is scaled by what fewer samples add: white noise of the rate keeps its expectation, in
//   adev, oadev, hdev and ohdev exactly, in mdev, tdev and at the mirrored ends of totdev, where the known samples
//   weigh differently, to a few percent at a ratio of 0.9; other noise is changed by less than the missing share. mdev:
//   means weighted as without gaps. phase: only known angles are used.
//
// accuracy  1e-12 of the definition, relative, also of a rate that walks at random
// cost      10^7 samples, 93 taus: see docs/reliability.md
// errors    SeriesError: an option out of its range, a factor below 1, no tau with a term.
[[nodiscard]] DeviationCurve deviation(const AngleRecord& record, DeviationKind kind,
                                       std::span<const std::int64_t> factors, const DeviationOptions& options = {});

}  // namespace zlg::deviations
