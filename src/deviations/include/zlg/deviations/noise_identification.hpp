#pragma once
// Which power law f^noise the rate's spectrum follows around an averaging time.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <zlg/deviations/angle_record.hpp>

namespace zlg::deviations {

// The exponent found from means over m intervals.
struct NoiseStep {
    std::int64_t m = 1;
    std::int64_t means = 0;
    double noise = 0.0;  // 2 ... -4, between whole numbers where laws mix
};

// At m = 1, 2, 4, ... as long as there are 30 means.
//
// The lag-1 exponent of the mean rates is not the spectrum's own: averaging over m leaves -1.45 for -1, -2.40 for -2,
// -3.93 for -3, -4.57 for -4, and in these numbers the scale is bent straight. White and flicker angle noise are
// distinguished from the angle averaged over m, for which sampling at distance m would make them alike; with gaps from
// the rates as well as may be.
[[nodiscard]] std::vector<NoiseStep> noise_steps(const AngleRecord& record, double least_known_ratio);

// At any m: the mean of the three steps up to m, each with the weight of its number of means, so that chance in the few
// means of a long averaging does not decide; beyond the last step, there. absent  no step.
[[nodiscard]] std::optional<double> noise_exponent(std::span<const NoiseStep> steps, std::int64_t m);

}  // namespace zlg::deviations
