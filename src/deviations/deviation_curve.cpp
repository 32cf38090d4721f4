#include <zlg/deviations/deviation_curve.hpp>

#include <fmt/format.h>
#include <zlg/deviations/deviation_confidence.hpp>
#include <zlg/deviations/series.hpp>

namespace zlg::deviations {

void check(const DeviationOptions& options) {
    check_confidence(options.confidence);
    if (!(options.least_known_ratio > 0.0 && options.least_known_ratio <= 1.0))
        throw SeriesError(
            fmt::format("least known ratio: {}, allowed is more than 0 and at most 1", options.least_known_ratio));
    if (options.noise && (*options.noise < -4 || *options.noise > 2))
        throw SeriesError(fmt::format("noise: exponent {}, allowed is -4 to 2", *options.noise));
    if (options.threads < 1) throw SeriesError(fmt::format("threads: {}, allowed is 1 or more", options.threads));
}

}  // namespace zlg::deviations
