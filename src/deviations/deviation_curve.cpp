#include <zlg/deviations/deviation_curve.hpp>

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlg/deviations/deviation_confidence.hpp>
#include <zlg/deviations/series.hpp>

namespace zlg::deviations {
namespace {

constexpr std::array<std::string_view, 3> bias_names{"removed", "published", "as_computed"};

}  // namespace

std::string_view name_of(TotalBias bias) { return bias_names.at(static_cast<std::size_t>(bias)); }

TotalBias total_bias_of(std::string_view name) {
    for (std::size_t k = 0; k < bias_names.size(); ++k)
        if (bias_names[k] == name) return static_cast<TotalBias>(k);
    throw SeriesError(fmt::format("bias: '{}' is unknown, allowed: {}", name, fmt::join(bias_names, ", ")));
}

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
