#include "noise_selection.hpp"

#include <algorithm>
#include <cmath>

#include "hadamard_scatter.hpp"
#include "term_sets.hpp"

namespace zlg::noise {
namespace {

// The scatter of the variances depends on the terms and the terms on the scatter: the first round starts from a fit of
// all basic terms, the second from the terms found.
constexpr int rounds = 2;

// Relative covariance of the variances.
Eigen::MatrixXd scatter(const HadamardPoints& points, const NoiseTerms& terms, double model_error) {
    const Eigen::MatrixXd whole = hadamard_scatter(terms, points.tau_0_s, points.m, points.n_intervals);
    const Eigen::VectorXd root = points.scarcity.cwiseSqrt();
    Eigen::MatrixXd relative = root.asDiagonal() * whole * root.asDiagonal();
    relative.diagonal().array() += model_error * model_error;
    return relative;
}

// How well a set does by the Bayesian information criterion, against the best.
double weight_of(const TermSet& c, const TermSet& best, double log_points) {
    const double more = static_cast<double>(c.n_free()) - static_cast<double>(best.n_free());
    return std::exp(-0.5 * (c.objective - best.objective + log_points * more));
}

// Another set of terms may be the true one, and gives a term that was found another size: the scatter between the sets
// is part of its standard error.
void take_uncertainty(const std::vector<TermSet>& all, double log_points, SmoothFit& result) {
    const TermSet& best = all.front();
    const bool has_time = best.shows(markov_index);
    std::array<double, n_smooth + 1> weights{}, variance{};
    double every = 0.0;
    for (const TermSet& c : all) {
        const double likely = weight_of(c, best, log_points), weight = std::exp(-0.5 * (c.price - best.price));
        every += likely;
        const auto add = [&](std::size_t kind, double of_its_own, double apart) {
            weights[kind] += weight;
            variance[kind] += weight * (of_its_own + apart * apart);
        };
        for (std::size_t kind = 0; kind < n_smooth; ++kind) {
            result.mean_square[kind] += likely * c.square[kind];
            if (best.shows(kind) && c.shows(kind)) add(kind, c.variance[kind], c.square[kind] - best.square[kind]);
        }
        if (has_time && c.shows(markov_index)) add(n_smooth, c.log_time_variance(), c.fit.log_time - best.fit.log_time);
    }
    for (std::size_t kind = 0; kind < n_smooth; ++kind) {
        result.mean_square[kind] /= every;
        if (best.shows(kind)) result.square_sigma[kind] = std::sqrt(variance[kind] / weights[kind]);
    }
    // Every set has a time of its own, so that a mean deviation without one of the times means nothing.
    if (!has_time) result.mean_square[markov_index] = 0.0;
    if (has_time) result.markov_time_sigma_s = best.time_s * std::sqrt(variance[n_smooth] / weights[n_smooth]);
}

// What an absent term would be beside those found.
void take_absent(const std::vector<TermSet>& all, SmoothFit& result) {
    const TermSet& best = all.front();
    for (std::size_t kind = 0; kind < markov_index; ++kind)
        for (const TermSet& c : all) {
            if (best.shows(kind) || c.mask != (best.mask | 1u << kind) || c.skipped != best.skipped) continue;
            result.square_freed[kind] = c.square[kind];
            result.square_sigma[kind] = std::sqrt(c.variance[kind]);
            // What is seen of it, and of what may remain below its error as much again, the mean of a half-normal
            // variable, sqrt(2/pi) standard deviations, at the most.
            constexpr double half_normal_mean = 0.8;
            const double seen = c.square[kind], hidden = half_normal_mean * result.square_sigma[kind];
            result.mean_square[kind] = std::max(result.mean_square[kind], seen + std::min(seen, hidden));
        }
}

}  // namespace

NoiseTerms terms_of(const std::array<double, n_smooth>& squares, double markov_time_s, double filter_time_s) {
    NoiseTerms terms{.quantisation_arcsec = std::sqrt(squares[0]),
                     .angle_random_walk_arcsec_sqrt_s = std::sqrt(squares[1]),
                     .filter_time_s = filter_time_s,
                     .bias_instability_arcsec_s = std::sqrt(squares[2]),
                     .rate_random_walk_arcsec_s_sqrt_s = std::sqrt(squares[3]),
                     .markov = {},
                     .sines = {}};
    if (squares[markov_index] > 0.0)
        terms.markov.push_back({.deviation_arcsec_s = std::sqrt(squares[markov_index]), .time_s = markov_time_s});
    return terms;
}

SmoothFit select_terms(const HadamardPoints& points, bool with_markov, double model_error) {
    // How the variances scatter depends on the terms, which are not known yet: white noise is a start.
    Eigen::MatrixXd relative = scatter(points, {.angle_random_walk_arcsec_sqrt_s = 1.0}, model_error);
    NoiseTerms terms = all_basic_terms(points, relative).seen_terms(points);
    std::vector<TermSet> sets;
    for (int round = 0; round < rounds; ++round) {
        relative = scatter(points, terms, model_error);
        sets = all_sets(points, relative, with_markov);
        terms = sets.front().seen_terms(points);
    }
    const TermSet& best = sets.front();
    SmoothFit result;
    result.square = best.square;
    for (std::size_t kind = 0; kind < n_smooth; ++kind) {
        result.found[kind] = best.shows(kind);
        if (!result.found[kind]) result.square[kind] = 0.0;
    }
    (best.filtered ? result.filter_time_s : result.markov_time_s) = best.has(markov_index) ? best.time_s : 0.0;
    result.skipped = best.skipped;
    take_uncertainty(sets, std::log(static_cast<double>(points.value.size())), result);
    take_absent(sets, result);
    result.fitted = best.expected(points);
    result.degrees = 2.0 * relative.diagonal().cwiseInverse();
    result.chi2 = best.fit.chi2;
    result.dof = points.tau_s.size() - static_cast<Eigen::Index>(best.n_free());
    return result;
}

}  // namespace zlg::noise
