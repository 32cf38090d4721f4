#include "variance_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include "difference_covariance.hpp"

namespace zlg::deviations {
namespace {

constexpr std::int64_t max_steps = 64;                            // into which an averaging time is divided
constexpr double max_values = 160.0, max_flicker_values = 272.0;  // of the record that is taken apart

// Mean square of what is not mirrored.
double plain_variance(const Thinned& thin) {
    Eigen::MatrixXd row = plain_difference(thin.steps);
    if (!thin.is_piecewise()) {
        row = Eigen::MatrixXd::Zero(1, 2 * thin.steps + 1);
        row(0, 0) = row(0, 2 * thin.steps) = 1.0;
        row(0, thin.steps) = -2.0;
    }
    const Eigen::RowVectorXd weight = of_second_differences(row).row(0);
    return weight * toeplitz(second_difference_covariance(thin, weight.size()), weight.size()) * weight.transpose();
}

double mean_square(const Thinned& thin, const Eigen::MatrixXd& rows) {
    const Eigen::MatrixXd covariance = toeplitz(second_difference_covariance(thin, rows.cols()), rows.cols());
    return (rows * covariance).cwiseProduct(rows).sum();
}

// Of every piece alike.
double piecewise_bias(const Thinned& thin) { return mean_square(thin, piece_terms(thin.steps)) / plain_variance(thin); }

// Differences about the first angles up to the one that needs no mirror, over one that is not mirrored.
double mirrored_end(const Thinned& thin) {
    if (thin.steps < 2) return 0.0;
    return mean_square(thin, of_second_differences(mirrored_terms(thin.steps, 2 * thin.steps, 1, thin.steps - 1))) /
           plain_variance(thin);
}

// The part of the bias that does not depend on the record's length, which takes some milliseconds.
double remembered(const Thinned& thin) {
    thread_local std::map<Thinned, double> known;
    if (const auto found = known.find(thin); found != known.end()) return found->second;
    if (known.size() >= 4096) known.clear();
    return known[thin] = thin.is_piecewise() ? piecewise_bias(thin) : mirrored_end(thin);
}

// What thinned terms are, averaged over the samples between them, and what averaging takes away: so many degrees of
// freedom that it is next to constant.
Parts with_rest(Parts parts, double whole, double dof) {
    double mean = 0.0;
    for (const auto& part : parts) mean += part.scale;
    const double rest = whole - mean;
    if (rest > 1e-6 * whole) parts.push_back({.scale = rest / dof, .dof = dof});
    return parts;
}

Parts mirrored_parts(const Thinned& thin, std::int64_t n_thinned) {
    const Eigen::MatrixXd of_values = mirrored_terms(thin.steps, n_thinned, 1, n_thinned - 1);
    const Eigen::MatrixXd rows = of_second_differences(of_values);
    const Eigen::MatrixXd covariance =
        rows * toeplitz(second_difference_covariance(thin, rows.cols()), rows.cols()) * rows.transpose();
    if (thin.noise != 1 || thin.steps == thin.m) return parts_of_covariance(covariance);
    // The noise of either end is in all that is mirrored there; that of the others is averaged.
    const double between = static_cast<double>(std::min(thin.m, max_flicker_m)) / static_cast<double>(thin.steps);
    const auto averaged = flicker_means_covariance(thin, n_thinned, between, between),
               of_end = flicker_means_covariance(thin, n_thinned, 1.0, between),
               of_ends = flicker_means_covariance(thin, n_thinned, 1.0, 1.0);
    Eigen::MatrixXd g(n_thinned + 1, n_thinned + 1);
    for (Eigen::Index i = 0; i <= n_thinned; ++i)
        for (Eigen::Index j = 0; j <= n_thinned; ++j) {
            const int ends = (i == 0 || i == n_thinned ? 1 : 0) + (j == 0 || j == n_thinned ? 1 : 0);
            const auto& law = ends == 0 ? averaged : ends == 1 ? of_end : of_ends;
            g(i, j) = law[static_cast<std::size_t>(std::abs(i - j))];
        }
    return with_rest(parts_of_covariance(of_values * g * of_values.transpose()), covariance.trace(),
                     between * static_cast<double>(n_thinned));
}

Parts piecewise_parts(const Thinned& thin, double starts, std::int64_t n_thinned) {
    const Eigen::MatrixXd piece = piece_terms(thin.steps), square = piece.transpose() * piece;
    const Eigen::Index width = square.rows(), n = width + n_thinned - 1;
    Eigen::MatrixXd form = Eigen::MatrixXd::Zero(n, n);
    for (std::int64_t k = 0; k < n_thinned; ++k) form.block(k, k, width, width) += square;
    const auto parts_with = [&](const Eigen::VectorXd& of_lag) {
        Eigen::MatrixXd covariance = toeplitz(of_lag, n);
        covariance.diagonal() *= 1.0 + 1e-11;  // of steep noise rounding may leave it a little negative
        const Eigen::MatrixXd root = covariance.llt().matrixL();
        return parts_of_covariance(root.transpose() * form * root);
    };
    const Eigen::VectorXd thinned = second_difference_covariance(thin, n);
    if (!thin.of_rates() || thin.noise != 1 || thin.steps == thin.m) return parts_with(thinned);
    const double between =
        std::min(static_cast<double>(std::min(thin.m, max_flicker_m)) / static_cast<double>(thin.steps),
                 starts / static_cast<double>(n_thinned));
    const auto averaged = flicker_means_covariance(thin, n + 4, between, between);
    return with_rest(parts_with(second_difference_covariance(thin, n, averaged)),
                     form.cwiseProduct(toeplitz(thinned, n)).sum(), between * static_cast<double>(n));
}

// Of so many differences, or pieces, thinned.
Parts parts_of_total(const Thinned& thin, double starts, std::int64_t n_thinned) {
    return thin.is_piecewise() ? piecewise_parts(thin, starts, n_thinned) : mirrored_parts(thin, n_thinned);
}

// White angle noise of an end of the record, or of the pieces, is in all that is mirrored there; the rest is
// independent from sample to sample, of which thinning left only some.
void undo_thinning(const Thinned& thin, double starts, std::int64_t n_thinned, Parts& parts) {
    if (thin.kind == DeviationKind::mtotdev || thin.noise != 2) return;
    const double more = static_cast<double>(thin.m) / static_cast<double>(thin.steps);
    const double more_ends = thin.is_piecewise() ? starts / static_cast<double>(n_thinned) : 1.0;
    const auto ends = static_cast<std::size_t>(thin.is_piecewise() ? 2 * n_thinned : 2);
    std::ranges::sort(parts, std::greater{}, &ChiSquarePart::scale);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const double times = k < ends ? more_ends : more;
        parts[k].scale /= times;
        parts[k].dof *= times;
    }
}

// Averaging times in the starts, or between the ends.
double averagings(DeviationKind kind, std::int64_t m, std::int64_t n_intervals) {
    const std::int64_t starts = kind == DeviationKind::totdev    ? n_intervals
                                : kind == DeviationKind::mtotdev ? n_intervals - 3 * m + 2
                                                                 : n_intervals - 3 * m + 1;
    return static_cast<double>(starts) / static_cast<double>(m);
}

// As fine as the work allows, and so that whole steps fit.
std::int64_t steps_for(DeviationKind kind, int noise, std::int64_t m, double n_averagings) {
    const double whole = n_averagings + (kind == DeviationKind::totdev ? 0.0 : 3.0);
    const auto most =
        std::min({m, max_steps, static_cast<std::int64_t>((noise == 1 ? max_flicker_values : max_values) / whole)});
    if (most == m) return m;
    std::int64_t best = most;
    double least = 1.0;
    for (std::int64_t s = most; s >= most * 3 / 4 && s > 0; --s) {
        const double steps = n_averagings * static_cast<double>(s), miss = std::abs(steps - std::round(steps));
        if (miss < least - 1e-9) least = miss, best = s;
    }
    return best;
}

VarianceLaw law_at(DeviationKind kind, int noise, std::int64_t m, double n_averagings) {
    const Thinned thin{.kind = kind, .noise = noise, .m = m, .steps = steps_for(kind, noise, m, n_averagings)};
    const auto n_thinned = std::max<std::int64_t>(1, std::lround(n_averagings * static_cast<double>(thin.steps)));
    const double starts = n_averagings * static_cast<double>(m);
    Parts parts = parts_of_total(thin, starts, n_thinned);
    undo_thinning(thin, starts, n_thinned, parts);
    return law_of(condensed(std::move(parts)));
}

}  // namespace

double exact_total_bias(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    const bool depends_on_sampling = kind == DeviationKind::totdev && noise > 0;
    const std::int64_t steps = std::min(m, max_steps);
    const double end = remembered(
        {.kind = kind, .noise = noise, .m = depends_on_sampling ? std::min(m, max_flicker_m) : steps, .steps = steps});
    if (kind != DeviationKind::totdev) return end;
    // Sums become integrals where thinned.
    const double mirrored = static_cast<double>(m) / static_cast<double>(steps) * (end + 0.5) - 0.5;
    const auto inside = static_cast<double>(n_intervals - 2 * m + 1);
    return (inside + 2.0 * mirrored) / static_cast<double>(n_intervals - 1);
}

VarianceLaw total_law(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    const double ratio = averagings(kind, m, n_intervals);
    if (ratio <= max_averagings) return law_at(kind, noise, m, ratio);
    constexpr double nearer = 10.0;
    const VarianceLaw a = law_at(kind, noise, m, nearer), b = law_at(kind, noise, m, max_averagings);
    const double way = (ratio - nearer) / (max_averagings - nearer);
    return {.edf = a.edf + way * (b.edf - a.edf), .skewness_p = a.skewness_p + way * (b.skewness_p - a.skewness_p)};
}

}  // namespace zlg::deviations
