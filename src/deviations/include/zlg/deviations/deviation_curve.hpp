#pragma once
// Points of a deviation with what is known of their uncertainty, and what of it can be asked.

#include <cstdint>
#include <optional>
#include <vector>

#include <zlg/deviations/deviation_kind.hpp>
#include <zlg/deviations/variance_law.hpp>

namespace zlg::deviations {

struct DeviationOptions {
    double confidence = 0.6827;      // of the intervals, 0 < . <= max_confidence
    double least_known_ratio = 0.9;  // of each averaging window, 0 < . <= 1; 1: no gap within a window
    std::optional<int> noise{};  // exponent of the rate's spectrum f^noise, 2 .. -4; absent: identified from the data
    int threads = 1;             // the result has the same bits with any number
};

// errors  SeriesError: an option out of its range.
void check(const DeviationOptions& options);

struct DeviationPoint {
    std::int64_t m = 1;
    double tau_s = 0.0;
    double deviation = 0.0;  // arcsec/s; tdev arcsec; without unit for Unit::one
    double low = 0.0;        // interval of `confidence`
    double high = 0.0;
    std::int64_t terms = 0;    // differences that were known
    VarianceLaw law{};         // for intervals of another confidence
    int noise = 0;             // exponent of the rate's spectrum at this tau
    double as_computed = 0.0;  // of totdev: with the bias of the mirroring, which the noise decides
};

struct DeviationCurve {
    DeviationKind kind = DeviationKind::oadev;
    double confidence = 0.0;
    std::vector<DeviationPoint> points;  // taus at which no term was known are left out
};

}  // namespace zlg::deviations
