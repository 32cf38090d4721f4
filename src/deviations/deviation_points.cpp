#include "deviation_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlg/deviations/deviation_confidence.hpp>

namespace zlg::deviations {
namespace {

constexpr std::array<std::string_view, 3> bias_names{"removed", "published", "as_computed"};

// A record without gaps of as many terms: what gaps leave of the terms is as much as that of a shorter record.
std::int64_t shortened(DeviationKind kind, std::int64_t m, std::int64_t n_intervals, double share) {
    const std::int64_t possible = possible_terms(kind, m, n_intervals);
    const auto known = std::clamp<std::int64_t>(std::llround(share * static_cast<double>(possible)), 1, possible);
    const bool side_by_side = kind == DeviationKind::adev || kind == DeviationKind::hdev;
    const std::int64_t shorter = n_intervals - (possible - known) * (side_by_side ? m : 1);
    return kind == DeviationKind::totdev ? std::max(2 * m, shorter) : shorter;
}

// What the variance as computed is to be divided by.
double total_bias(TotalBias what, DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    switch (what) {
        case TotalBias::removed:
            return total_variance_bias(kind, noise, m, n_intervals);
        case TotalBias::published:
            return published_total_variance_bias(kind, noise, m, n_intervals);
        case TotalBias::as_computed:
            break;
    }
    return 1.0;
}

// Squares of differences to variances: white rate noise gives 2 and 6 times its own.
double per_square(DeviationKind kind) { return difference_order(kind) == 3 ? 1.0 / 6.0 : 0.5; }

int noise_at(std::int64_t m, DeviationKind kind, const std::vector<NoiseStep>& steps, const DeviationOptions& options) {
    if (options.noise) return *options.noise;
    const int steepest = difference_order(kind) == 3 ? -4 : -2;
    return std::clamp(static_cast<int>(std::lround(noise_exponent(steps, m).value_or(0.0))), steepest, 2);
}

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
    DeviationCurve curve{
        .kind = kind, .confidence = options.confidence, .total_bias = options.total_bias, .points = {}};
    for (const auto& [m, sum, possible] : sums) {
        if (sum.terms < 1 || possible < 1) continue;
        const int noise = noise_at(m, kind, steps, options);
        DeviationPoint point{
            .m = m, .tau_s = static_cast<double>(m) / what.rate_hz, .terms = sum.terms, .noise = noise};
        const double variance = per_square(kind) * rate_scale(what) * sum.sum / static_cast<double>(sum.terms);
        point.as_computed = std::sqrt(variance);
        if (kind == DeviationKind::tdev) point.as_computed *= point.tau_s / std::numbers::sqrt3;
        point.deviation = point.as_computed / std::sqrt(total_bias(options.total_bias, kind, noise, m, n_intervals));
        const double share = static_cast<double>(sum.terms) / static_cast<double>(possible);
        point.law = variance_law(kind, noise, m, shortened(kind, m, n_intervals, share));
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

}  // namespace zlg::deviations
