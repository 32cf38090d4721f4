#include <zlg/deviations/deviation.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <zlg/deviations/deviation_confidence.hpp>
#include <zlg/deviations/noise_identification.hpp>
#include <zlg/numeric/parallel.hpp>

#include "sums/difference_sums.hpp"

namespace zlg::deviations {
namespace {

std::vector<TermSum> all_sums(const RecordView& view, DeviationKind kind, std::span<const std::int64_t> factors,
                              int threads) {
    if (kind == DeviationKind::oadev || kind == DeviationKind::ohdev)
        return difference_sums(view, difference_order(kind), factors, threads);
    if (is_modified(kind)) return averaged_sums(view, factors, threads);
    std::vector<TermSum> sums(factors.size());
    numeric::in_parallel(sums.size(), threads, [&](std::size_t k) {
        sums[k] = kind == DeviationKind::totdev ? total_sum(view, factors[k])
                                                : side_by_side_sum(view, difference_order(kind), factors[k]);
    });
    return sums;
}

std::vector<std::int64_t> checked_factors(std::span<const std::int64_t> factors, std::int64_t n_intervals) {
    std::vector<std::int64_t> sorted(factors.begin(), factors.end());
    std::ranges::sort(sorted);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.empty()) throw SeriesError("averaging times: 0 are given, allowed is 1 or more");
    if (sorted.front() < 1)
        throw SeriesError(fmt::format("averaging time: {} intervals, allowed is 1 or more", sorted.front()));
    std::erase_if(sorted, [&](std::int64_t m) { return m > n_intervals; });
    return sorted;
}

// --- from sums of squares to points of a curve

struct MeasuredSum {
    std::int64_t m = 1;
    TermSum sum;
    std::int64_t possible_terms = 0;  // without gaps
};

// Terms of a record of n_intervals without gaps.
std::int64_t possible_terms(DeviationKind kind, std::int64_t m, std::int64_t n_intervals) {
    const int order = difference_order(kind);
    std::int64_t terms = n_intervals - order * m + 1;
    if (is_side_by_side(kind)) terms = n_intervals / m - order + 1;
    if (is_modified(kind)) terms = n_intervals - 3 * m + 2;
    if (kind == DeviationKind::totdev) terms = n_intervals - 1;
    return std::max<std::int64_t>(0, terms);
}

// A record without gaps of as many terms: what gaps leave of the terms is as much as that of a shorter record.
std::int64_t shortened(DeviationKind kind, std::int64_t m, std::int64_t n_intervals, double share) {
    const std::int64_t possible = possible_terms(kind, m, n_intervals);
    const auto known = std::clamp<std::int64_t>(std::llround(share * static_cast<double>(possible)), 1, possible);
    const std::int64_t shorter = n_intervals - (possible - known) * (is_side_by_side(kind) ? m : 1);
    return kind == DeviationKind::totdev ? std::max(2 * m, shorter) : shorter;
}

// Squares of differences to variances: white rate noise gives 2 and 6 times its own.
double per_square(DeviationKind kind) { return difference_order(kind) == 3 ? 1.0 / 6.0 : 0.5; }

int noise_at(std::int64_t m, DeviationKind kind, const std::vector<NoiseStep>& steps, const DeviationOptions& options) {
    if (options.noise) return *options.noise;
    const int steepest = difference_order(kind) == 3 ? -4 : -2;
    return std::clamp(static_cast<int>(std::lround(noise_exponent(steps, m).value_or(0.0))), steepest, 2);
}

// steps  what is known of the noise; none where it is given, or too short a record: then white rate noise is taken.
DeviationCurve curve_of(DeviationKind kind, const SeriesKind& what, std::int64_t n_intervals,
                        const std::vector<MeasuredSum>& sums, const std::vector<NoiseStep>& steps,
                        const DeviationOptions& options) {
    DeviationCurve curve{.kind = kind, .confidence = options.confidence, .points = {}};
    for (const auto& [m, sum, possible] : sums) {
        if (sum.terms < 1 || possible < 1) continue;
        const int noise = noise_at(m, kind, steps, options);
        DeviationPoint point{
            .m = m, .tau_s = static_cast<double>(m) / what.rate_hz, .terms = sum.terms, .noise = noise};
        const double variance = per_square(kind) * rate_scale(what) * sum.sum / static_cast<double>(sum.terms);
        point.as_computed = std::sqrt(variance);
        if (kind == DeviationKind::tdev) point.as_computed *= point.tau_s / std::numbers::sqrt3;
        point.deviation = point.as_computed / std::sqrt(total_variance_bias(kind, noise, m, n_intervals));
        const double share = static_cast<double>(sum.terms) / static_cast<double>(possible);
        point.law = variance_law(kind, noise, m, shortened(kind, m, n_intervals, share));
        const auto interval = confidence_interval(point.deviation, point.law, options.confidence);
        point.low = interval.low;
        point.high = interval.high;
        curve.points.push_back(point);
    }
    if (curve.points.empty())
        throw SeriesError(
            fmt::format("{}: a record of {} intervals has no difference that is known at the given averaging times",
                        name_of(kind), n_intervals));
    if (std::ranges::all_of(curve.points, [](const DeviationPoint& point) { return point.deviation == 0.0; }))
        throw SeriesError(fmt::format("{}: the record has no noise, all differences are 0", name_of(kind)));
    return curve;
}

}  // namespace

DeviationCurve deviation(const AngleRecord& record, DeviationKind kind, std::span<const std::int64_t> factors,
                         const DeviationOptions& options) {
    check(options);
    const auto sorted = checked_factors(factors, record.n_intervals());
    const auto view = view_of(record, options.least_known_ratio);
    const auto sums = all_sums(view, kind, sorted, options.threads);
    std::vector<MeasuredSum> measured;
    for (std::size_t k = 0; k < sums.size(); ++k)
        measured.push_back(
            {.m = sorted[k], .sum = sums[k], .possible_terms = possible_terms(kind, sorted[k], record.n_intervals())});
    const auto steps = options.noise ? std::vector<NoiseStep>{} : noise_steps(record, options.least_known_ratio);
    return curve_of(kind, record.what(), record.n_intervals(), measured, steps, options);
}

}  // namespace zlg::deviations
