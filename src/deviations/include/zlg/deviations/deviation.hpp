#pragma once
// Deviations of a record, with what is known of their uncertainty.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <zlg/deviations/angle_record.hpp>
#include <zlg/deviations/deviation_confidence.hpp>
#include <zlg/deviations/deviation_kind.hpp>

namespace zlg::deviations {

// The total deviations are biased by the mirroring, by a factor that the noise decides.
//
// removed      divided by the factor as it is, so that the interval is that of the deviation without mirroring
// published    divided by that of NIST Special Publication 1065, whose tables have it; of mtotdev it is 3 % off and more
// as_computed  neither, as Stable32 and AllanTools print them
enum class TotalBias { removed, published, as_computed };

[[nodiscard]] std::string_view name_of(TotalBias bias);

// errors  SeriesError: another name.
[[nodiscard]] TotalBias total_bias_of(std::string_view name);

struct DeviationOptions {
    double confidence = 0.6827;      // of the intervals, 0 < . <= max_confidence
    double least_known_ratio = 0.9;  // of each averaging window, 0 < . <= 1; 1: no gap within a window
    std::optional<int> noise{};  // exponent of the rate's spectrum f^noise, 2 .. -4; absent: identified from the data
    TotalBias total_bias = TotalBias::removed;
    int threads = 1;  // the result has the same bits with any number
};

struct DeviationPoint {
    std::int64_t m = 1;
    double tau_s = 0.0;
    double deviation = 0.0;  // arcsec/s; tdev arcsec; without unit for Unit::one
    double low = 0.0;        // interval of `confidence`
    double high = 0.0;
    std::int64_t terms = 0;  // differences that were known
    VarianceLaw law{};       // for intervals of another confidence
    int noise = 0;           // exponent of the rate's spectrum at this tau
    double as_computed =
        0.0;  // of the total deviations: the deviation with the bias of the mirroring, or what removed it
};

struct DeviationCurve {
    DeviationKind kind = DeviationKind::oadev;
    double confidence = 0.0;
    TotalBias total_bias = TotalBias::removed;  // of the total deviations
    std::vector<DeviationPoint> points;         // taus at which no term was known are left out
};

// Deviation of the record at averaging factors m.
//
//   increments and rate with gaps: a window counts where least_known_ratio of it is known; its rate is the mean of the known
//   ones. Each difference is scaled by what fewer samples add: white noise of the rate keeps its expectation, in adev, oadev,
//   hdev and ohdev exactly, in mdev, tdev and at the mirrored ends of totdev, where the known samples weigh differently, to a few
//   percent at a ratio of 0.9; other noise is changed by less than the missing share. mdev: means weighted as without gaps.
//   phase: only known angles are used.
//   mtotdev, htotdev: only pieces without a gap.
//
// accuracy  1e-12 of the definition, relative, also of a rate that walks at random
// cost      10^7 samples, 93 taus: see docs/performance.md
// errors    SeriesError: an option out of its range, a factor below 1, no tau with a term.
[[nodiscard]] DeviationCurve deviation(const AngleRecord& record, DeviationKind kind,
                                       std::span<const std::int64_t> factors, const DeviationOptions& options = {});

}  // namespace zlg::deviations
