#include "deviation_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <zlg/analysis/deviation_confidence.hpp>

namespace zlg::analysis {
namespace {

// Squares of differences to variances: white rate noise gives 2 and 6 times its own.
double per_square(DeviationKind kind) { return difference_order(kind) == 3 ? 1.0 / 6.0 : 0.5; }

int noise_at(std::int64_t m, DeviationKind kind, const std::vector<NoiseStep>& steps, const DeviationOptions& options) {
    if (options.noise) return *options.noise;
    const int steepest = difference_order(kind) == 3 ? -4 : -2;
    return std::clamp(static_cast<int>(std::lround(noise_exponent(steps, m).value_or(0.0))), steepest, 2);
}

}  // namespace

void check(const DeviationOptions& options) {
    check_confidence(options.confidence);
    if (!(options.least_known_ratio > 0.0 && options.least_known_ratio <= 1.0))
        throw SeriesError(
            fmt::format("least known ratio: {}, allowed is more than 0 and at most 1", options.least_known_ratio));
    if (options.noise && (*options.noise < -4 || *options.noise > 2))
        throw SeriesError(fmt::format("noise: exponent {}, allowed is -4 to 2", *options.noise));
    if (options.threads < 1) throw SeriesError(fmt::format("threads: {}, allowed is 1 or more", options.threads));
}

std::int64_t possible_terms(DeviationKind kind, std::int64_t m, std::int64_t n_intervals) {
    const std::int64_t n = n_intervals;
    std::int64_t terms = 0;
    switch (kind) {
        case DeviationKind::adev:
            terms = n / m - 1;
            break;
        case DeviationKind::hdev:
            terms = n / m - 2;
            break;
        case DeviationKind::oadev:
            terms = n - 2 * m + 1;
            break;
        case DeviationKind::mdev:
        case DeviationKind::tdev:
        case DeviationKind::mtotdev:
            terms = n - 3 * m + 2;
            break;
        case DeviationKind::ohdev:
        case DeviationKind::htotdev:
            terms = n - 3 * m + 1;
            break;
        case DeviationKind::totdev:
            terms = n - 1;
            break;
    }
    return std::max<std::int64_t>(0, terms);
}

DeviationCurve curve_of(DeviationKind kind, const SeriesKind& what, std::int64_t n_intervals,
                        const std::vector<MeasuredSum>& sums, const std::vector<NoiseStep>& steps,
                        const DeviationOptions& options) {
    DeviationCurve curve{.kind = kind, .confidence = options.confidence, .points = {}};
    for (const auto& [m, sum, possible] : sums) {
        if (sum.terms < 1 || possible < 1) continue;
        const int noise = noise_at(m, kind, steps, options);
        DeviationPoint point{
            .m = m, .tau_s = static_cast<double>(m) / what.rate_hz, .terms = sum.terms, .noise = noise};
        double variance = per_square(kind) * rate_scale(what) * sum.sum / static_cast<double>(sum.terms);
        if (options.total_bias == TotalBias::removed) variance /= total_variance_bias(kind, noise, m, n_intervals);
        point.deviation = std::sqrt(variance);
        if (kind == DeviationKind::tdev) point.deviation *= point.tau_s / std::numbers::sqrt3;
        // What gaps take away from the terms they take from what the terms tell.
        const double share = static_cast<double>(sum.terms) / static_cast<double>(possible);
        point.law = variance_law(kind, noise, m, n_intervals);
        point.law = {.edf = std::max(1.0, point.law.edf * share),
                     .skewness_p = std::max(0.5, point.law.skewness_p * share)};
        const auto interval = confidence_interval(point.deviation, point.law, options.confidence);
        point.low = interval.low;
        point.high = interval.high;
        curve.points.push_back(point);
    }
    if (curve.points.empty())
        throw SeriesError(
            fmt::format("{}: a record of {} intervals has no difference that is known at the given averaging "
                        "times",
                        name_of(kind), n_intervals));
    if (std::ranges::all_of(curve.points, [](const DeviationPoint& point) { return point.deviation == 0.0; }))
        throw SeriesError(fmt::format("{}: the record has no noise, all differences are 0", name_of(kind)));
    return curve;
}

}  // namespace zlg::analysis
