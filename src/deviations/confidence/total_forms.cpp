#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

#include <Eigen/Core>

#include "difference_covariance.hpp"
#include "variance_parts.hpp"

namespace zlg::deviations {
namespace {

constexpr std::int64_t max_steps = 64;       // into which an averaging time is divided
constexpr std::int64_t max_flicker_m = 512;  // flicker of the angle depends on the sampling, up to there
constexpr double max_values = 160.0;         // of the record that is taken apart

// Generalised covariance of n + 1 angles of which `steps` are in an averaging time of m samples.
Eigen::MatrixXd angle_covariance(int noise, std::int64_t m, std::int64_t steps, Eigen::Index n) {
    Eigen::VectorXd of_lag(n + 1);
    if (steps == m || noise == 2) {
        const auto sampled = sampled_covariance(noise, n);
        of_lag = Eigen::Map<const Eigen::VectorXd>(sampled.data(), n + 1);
    } else {
        const double apart =
            std::max(1.0, static_cast<double>(std::min(m, max_flicker_m)) / static_cast<double>(steps));
        for (Eigen::Index k = 0; k <= n; ++k)
            of_lag[k] = noise == 1 ? flicker_covariance(std::llround(static_cast<double>(k) * apart))
                                   : continuous_covariance(static_cast<double>(k), noise + 2);
    }
    return toeplitz(of_lag, n + 1);
}

// The differences about every angle from the first to `last` of a record of n intervals, as weights of the angles.
Eigen::MatrixXd mirrored_terms(std::int64_t s, std::int64_t n, std::int64_t last) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(last, n + 1);
    for (std::int64_t centre = 1; centre <= last; ++centre) {
        auto row = rows.row(centre - 1);
        const auto add = [&](std::int64_t k, double weight) {
            const std::int64_t end = k < 0 ? 0 : n;
            if (k < 0 || k > n) {
                row[end] += 2.0 * weight;
                row[2 * end - k] -= weight;
            } else {
                row[k] += weight;
            }
        };
        add(centre - s, 1.0);
        add(centre, -2.0);
        add(centre + s, 1.0);
    }
    return rows;
}

// White angle noise of an end of the record is in all that is mirrored there; the rest is independent from sample to
// sample, of which thinning left only some.
void undo_thinning(std::int64_t m, std::int64_t steps, Parts& parts) {
    const double more = static_cast<double>(m) / static_cast<double>(steps);
    std::ranges::sort(parts, std::greater{}, &ChiSquarePart::scale);
    for (std::size_t k = 2; k < parts.size(); ++k) {
        parts[k].scale /= more;
        parts[k].dof *= more;
    }
}

// As fine as the work allows, and so that whole steps fit.
std::int64_t steps_for(std::int64_t m, double n_averagings) {
    const auto most = std::min({m, max_steps, static_cast<std::int64_t>(max_values / n_averagings)});
    if (most == m) return m;
    std::int64_t best = most;
    double least = 1.0;
    for (std::int64_t s = most; s >= most * 3 / 4 && s > 0; --s) {
        const double steps = n_averagings * static_cast<double>(s), miss = std::abs(steps - std::round(steps));
        if (miss < least - 1e-9) least = miss, best = s;
    }
    return best;
}

VarianceLaw law_at(int noise, std::int64_t m, double n_averagings) {
    const std::int64_t steps = steps_for(m, n_averagings);
    const auto n = std::max<std::int64_t>(1, std::lround(n_averagings * static_cast<double>(steps)));
    const Eigen::MatrixXd terms = mirrored_terms(steps, n, n - 1);
    Parts parts = parts_of_covariance(terms * angle_covariance(noise, m, steps, n) * terms.transpose());
    if (noise == 2) undo_thinning(m, steps, parts);
    return law_of(condensed(std::move(parts)));
}

}  // namespace

double total_bias(int noise, std::int64_t m, std::int64_t n_intervals) {
    const std::int64_t steps = std::min(m, max_steps), n = 2 * steps;
    // About the first angles up to the one that needs no mirror, and that one.
    const Eigen::MatrixXd terms = mirrored_terms(steps, n, steps);
    const Eigen::VectorXd square = (terms * angle_covariance(noise, m, steps, n)).cwiseProduct(terms).rowwise().sum();
    const double end = square.head(steps - 1).sum() / square[steps - 1];
    // Sums become integrals where thinned.
    const double mirrored = static_cast<double>(m) / static_cast<double>(steps) * (end + 0.5) - 0.5;
    const auto inside = static_cast<double>(n_intervals - 2 * m + 1);
    return (inside + 2.0 * mirrored) / static_cast<double>(n_intervals - 1);
}

VarianceLaw total_law(int noise, std::int64_t m, std::int64_t n_intervals) {
    const double ratio = static_cast<double>(n_intervals) / static_cast<double>(m);
    if (ratio <= max_averagings) return law_at(noise, m, ratio);
    constexpr double nearer = 10.0;
    const VarianceLaw a = law_at(noise, m, nearer), b = law_at(noise, m, max_averagings);
    const double way = (ratio - nearer) / (max_averagings - nearer);
    return {.edf = a.edf + way * (b.edf - a.edf), .skewness_p = a.skewness_p + way * (b.skewness_p - a.skewness_p)};
}

}  // namespace zlg::deviations
