#include <zlg/deviations/deviation.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <zlg/deviations/noise_identification.hpp>
#include <zlg/numeric/parallel.hpp>

#include "deviation_points.hpp"
#include "sums/difference_sums.hpp"

namespace zlg::deviations {
namespace {

TermSum single_sum(const RecordView& view, DeviationKind kind, std::int64_t m, int threads) {
    if (2 * m > view.n_intervals && kind == DeviationKind::totdev) return {};
    switch (kind) {
        case DeviationKind::totdev:
            return total_sum(view, m);
        case DeviationKind::mtotdev:
            return mirrored_pieces_sum(view, PieceOf::angle, m, threads);
        // A piece of three values that has lost its line has one degree of freedom left, and mirroring adds none.
        case DeviationKind::htotdev:
            return m == 1 ? difference_sum(view, 3, 1, 0, view.n_intervals)
                          : mirrored_pieces_sum(view, PieceOf::rate, m, threads);
        default:
            return side_by_side_sum(view, difference_order(kind), m);
    }
}

std::vector<TermSum> all_sums(const RecordView& view, DeviationKind kind, std::span<const std::int64_t> factors,
                              int threads) {
    if (kind == DeviationKind::oadev || kind == DeviationKind::ohdev)
        return difference_sums(view, difference_order(kind), factors, threads);
    if (kind == DeviationKind::mdev || kind == DeviationKind::tdev) return averaged_sums(view, factors, threads);
    // Pieces that are mirrored have threads of their own.
    const bool is_of_pieces = kind == DeviationKind::mtotdev || kind == DeviationKind::htotdev;
    std::vector<TermSum> sums(factors.size());
    numeric::in_parallel(sums.size(), is_of_pieces ? 1 : threads,
                         [&](std::size_t k) { sums[k] = single_sum(view, kind, factors[k], threads); });
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
