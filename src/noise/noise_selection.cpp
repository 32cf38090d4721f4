#include "noise_selection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "hadamard_scatter.hpp"
#include "noise_likelihood.hpp"

namespace zlg::noise {
namespace {

// Costs in -2 log likelihood. Of one coefficient that may not be negative: half of chi-square beyond 6.63 is 0.5 %.
constexpr double cost = 6.6;
// Of a Markov term, whose time is free too: of 654 records without one 10 showed one (zlg_trials noise,
// docs/noise.md).
constexpr double markov_cost = 12.0;
// The scatter of the variances depends on the terms and the terms on the scatter: the first round starts from a fit of
// all basic terms, the second from the terms found.
constexpr int rounds = 2;

constexpr unsigned basic_mask = 15;
constexpr unsigned markov_bit = 16;

NoiseTerms unit_term(std::size_t kind, double time_s) {
    std::array<double, n_smooth> squares{};
    squares[kind] = 1.0;
    return terms_of(squares, time_s);
}

Eigen::VectorXd column(const HadamardPoints& points, std::size_t kind, double time_s) {
    const NoiseTerms unit = unit_term(kind, time_s);
    Eigen::VectorXd c(points.tau_s.size());
    for (Eigen::Index i = 0; i < c.size(); ++i) c[i] = hadamard_variance(unit, points.tau_s[i]);
    return c;
}

struct Candidate {
    unsigned mask = 0;
    double time_s = 0.0;
    TermFit fit;
    double price = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool has(std::size_t kind) const { return (mask >> kind & 1u) != 0; }
};

class Search {
public:
    Search(const HadamardPoints& points, MeasuredVariances variances)
        : points_(points), variances_(std::move(variances)) {
        for (std::size_t kind = 0; kind < markov_index; ++kind) basic_.push_back(column(points, kind, 1.0));
    }

    // time_s  with which the search for that of the Markov term begins.
    [[nodiscard]] Candidate fit(unsigned mask, double time_s) const {
        Candidate c{.mask = mask};
        TimedColumn timed;
        if ((mask & markov_bit) != 0) {
            timed.at = [this](double log_time) { return column(points_, markov_index, std::exp(log_time)); };
            timed.log_time = std::log(time_s);
            timed.low = std::log(points_.tau_0_s);
            timed.high = std::log(points_.tau_s[points_.tau_s.size() - 1]);
        }
        c.fit = fit_terms(variances_, basic_columns(mask), timed);
        c.time_s = std::exp(c.fit.log_time);
        c.price = c.fit.objective;
        for (std::size_t kind = 0; kind < n_smooth; ++kind)
            if (c.has(kind)) c.price += kind == markov_index ? markov_cost : cost;
        return c;
    }

    // Every set of terms, that of the least price first.
    [[nodiscard]] std::vector<Candidate> all_sets(bool with_markov) const {
        std::vector<Candidate> all;
        for (unsigned mask = 1; mask <= basic_mask; ++mask) all.push_back(fit(mask, 0.0));
        if (with_markov) {
            const double time_s = likely_time();
            for (unsigned mask = 0; mask <= basic_mask; ++mask) all.push_back(fit(mask | markov_bit, time_s));
        }
        std::ranges::stable_sort(all, {}, &Candidate::price);
        return all;
    }

private:
    [[nodiscard]] Eigen::MatrixXd basic_columns(unsigned mask) const {
        Eigen::MatrixXd m(points_.tau_s.size(), std::popcount(mask & basic_mask));
        Eigen::Index k = 0;
        for (std::size_t kind = 0; kind < markov_index; ++kind)
            if ((mask >> kind & 1u) != 0) m.col(k++) = basic_[kind];
        return m;
    }

    // Of those reached from every fourth octave beside all other terms, that of the best.
    [[nodiscard]] double likely_time() const {
        Candidate best;
        for (double t = 2.0 * points_.tau_0_s; t <= points_.tau_s[points_.tau_s.size() - 1]; t *= 4.0) {
            Candidate c = fit(basic_mask | markov_bit, t);
            if (c.price < best.price) best = std::move(c);
        }
        return best.time_s;
    }

    const HadamardPoints& points_;
    MeasuredVariances variances_;
    std::vector<Eigen::VectorXd> basic_;
};

std::array<double, n_smooth> squares_of(const Candidate& c) {
    std::array<double, n_smooth> squares{};
    Eigen::Index k = 0;
    for (std::size_t kind = 0; kind < n_smooth; ++kind)
        if (c.has(kind)) squares[kind] = c.fit.coefficient[k++];
    return squares;
}

MeasuredVariances measured(const HadamardPoints& points, const NoiseTerms& terms, double model_error) {
    MeasuredVariances v{.value = points.value, .freedom = {}, .whitening = {}};
    const Eigen::MatrixXd whole = hadamard_scatter(terms, points.tau_0_s, points.m, points.n_intervals);
    const Eigen::VectorXd root = points.scarcity.cwiseSqrt();
    Eigen::MatrixXd relative = root.asDiagonal() * whole * root.asDiagonal();
    relative.diagonal().array() += model_error * model_error;
    set_scatter(relative, v);
    return v;
}

std::size_t place_of(const Candidate& c, std::size_t kind) {
    return static_cast<std::size_t>(std::popcount(c.mask & ((1u << kind) - 1u)));
}

double variance_of(const Candidate& c, std::size_t place) {
    const auto k = static_cast<Eigen::Index>(place);
    return c.fit.covariance(k, k);
}

// How well a set does by the Bayesian information criterion, against the best.
double weight_of(const Candidate& c, const Candidate& best) {
    const double one_more = std::log(static_cast<double>(best.fit.expected.size()));
    const auto more = static_cast<double>(c.fit.covariance.rows() - best.fit.covariance.rows());
    return std::exp(-0.5 * (c.fit.objective - best.fit.objective + one_more * more));
}

// Another set of terms may be the true one, and gives a term that was found another size: the scatter between the sets
// is part of its standard error.
void take_uncertainty(const std::vector<Candidate>& all, SmoothFit& result) {
    const Candidate& best = all.front();
    std::array<double, n_smooth + 1> weights{}, variance{};
    double every = 0.0;
    for (const Candidate& c : all) {
        const double likely = weight_of(c, best), weight = std::exp(-0.5 * (c.price - best.price));
        every += likely;
        const auto squares = squares_of(c);
        for (std::size_t kind = 0; kind < n_smooth; ++kind) {
            result.mean_square[kind] += likely * squares[kind];
            if (!best.has(kind) || !c.has(kind)) continue;
            const double apart = squares[kind] - result.square[kind];
            weights[kind] += weight;
            variance[kind] += weight * (variance_of(c, place_of(c, kind)) + apart * apart);
        }
        if (!best.has(markov_index) || !c.has(markov_index)) continue;
        const double apart = c.fit.log_time - best.fit.log_time;
        weights[n_smooth] += weight;
        variance[n_smooth] += weight * (variance_of(c, place_of(c, n_smooth)) + apart * apart);
    }
    for (std::size_t kind = 0; kind < n_smooth; ++kind) {
        result.mean_square[kind] /= every;
        if (best.has(kind)) result.square_sigma[kind] = std::sqrt(variance[kind] / weights[kind]);
    }
    if (!best.has(markov_index)) {
        // Every set has a time of its own, so that a mean deviation without one of the times means nothing.
        result.mean_square[markov_index] = 0.0;
        return;
    }
    result.markov_time_s = best.time_s;
    result.markov_time_sigma_s = best.time_s * std::sqrt(variance[n_smooth] / weights[n_smooth]);
}

// What an absent term would be beside those found.
void take_absent(const std::vector<Candidate>& all, SmoothFit& result) {
    for (std::size_t kind = 0; kind < markov_index; ++kind)
        for (const Candidate& c : all) {
            if (c.mask != (all.front().mask | 1u << kind) || c.mask == all.front().mask) continue;
            const std::size_t place = place_of(c, kind);
            result.square_freed[kind] = c.fit.coefficient[static_cast<Eigen::Index>(place)];
            result.square_sigma[kind] = std::sqrt(variance_of(c, place));
            // What is seen of it, and the mean of what may remain below its error: of a half-normal variable,
            // sqrt(2/pi) standard deviations.
            constexpr double half_normal_mean = 0.8;
            result.mean_square[kind] = std::max(
                result.mean_square[kind], result.square_freed[kind] + half_normal_mean * result.square_sigma[kind]);
        }
}

}  // namespace

NoiseTerms terms_of(const std::array<double, n_smooth>& squares, double markov_time_s) {
    NoiseTerms terms{.quantisation_arcsec = std::sqrt(squares[0]),
                     .angle_random_walk_arcsec_sqrt_s = std::sqrt(squares[1]),
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
    MeasuredVariances v = measured(points, {.angle_random_walk_arcsec_sqrt_s = 1.0}, model_error);
    const Candidate all = Search(points, v).fit(basic_mask, 0.0);
    NoiseTerms terms = terms_of(squares_of(all), 0.0);
    std::vector<Candidate> sets;
    for (int round = 0; round < rounds; ++round) {
        v = measured(points, terms, model_error);
        sets = Search(points, v).all_sets(with_markov);
        terms = terms_of(squares_of(sets.front()), sets.front().time_s);
    }
    const Candidate& best = sets.front();
    SmoothFit result;
    result.square = squares_of(best);
    for (std::size_t kind = 0; kind < n_smooth; ++kind) result.found[kind] = best.has(kind);
    take_uncertainty(sets, result);
    take_absent(sets, result);
    result.fitted = best.fit.expected;
    result.degrees = v.freedom;
    result.chi2 = best.fit.chi2;
    result.dof = points.tau_s.size() - std::popcount(best.mask) - (best.has(markov_index) ? 1 : 0);
    return result;
}

}  // namespace zlg::noise
