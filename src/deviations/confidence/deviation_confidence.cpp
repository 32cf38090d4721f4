#include <zlg/deviations/deviation_confidence.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <zlg/deviations/series.hpp>

#include "difference_covariance.hpp"
#include "variance_parts.hpp"

namespace zlg::deviations {
namespace {

// Correlation of terms that are `lag` apart, 0 beyond the table.
struct TermCorrelation {
    double terms = 1.0;            // how many there are
    std::vector<double> of_lag{};  // [0] = 1

    [[nodiscard]] std::int64_t reach() const { return static_cast<std::int64_t>(of_lag.size()) - 1; }
    [[nodiscard]] double operator()(std::int64_t lag) const {
        const auto k = static_cast<std::size_t>(std::abs(lag));
        return k < of_lag.size() ? of_lag[k] : 0.0;
    }
};

// Terms thinned to `per_averaging` in one averaging time: of a smooth correlation that is an integral for the sum.
TermCorrelation correlation(const DifferenceCovariance& covariance, std::int64_t per_averaging, double terms, int d) {
    TermCorrelation found{.terms = terms};
    const double variance = covariance(0);
    for (std::int64_t k = 0; k <= (d + 1) * per_averaging && (k == 0 || static_cast<double>(k) < terms); ++k)
        found.of_lag.push_back(covariance(k * covariance.steps() / per_averaging) / variance);
    return found;
}

// Pairs of terms.
double edf_of(const TermCorrelation& rho) {
    double sum = 1.0;
    for (std::int64_t k = 1; k <= rho.reach(); ++k)
        sum += 2.0 * std::max(0.0, 1.0 - static_cast<double>(k) / rho.terms) * rho(k) * rho(k);
    return rho.terms / sum;
}

// Triples of terms: of a quadratic form with covariance C the skewness is sqrt(8) tr C^3/(tr C^2)^(3/2).
double skewness_p_of(const TermCorrelation& rho) {
    double triples = 0.0;
    for (std::int64_t a = -rho.reach(); a <= rho.reach(); ++a)
        for (std::int64_t b = -rho.reach(); b <= rho.reach(); ++b) {
            const auto span =
                static_cast<double>(std::max({a, b, std::int64_t{0}}) - std::min({a, b, std::int64_t{0}}));
            triples += std::max(0.0, rho.terms - span) * rho(a) * rho(b) * rho(b - a);
        }
    const double pairs = rho.terms * rho.terms / edf_of(rho);
    return pairs * pairs * pairs / (triples * triples);
}

// In one averaging time: it need not be known better than to a few percent. Flicker of the angle is correlated in
// spikes.
std::int64_t skewness_steps(int noise, bool modified) { return noise == 1 && !modified ? 128 : 8; }

// White noise of the angle, not averaged: only whole averaging times are correlated.
VarianceLaw law_of_white_angle(double terms, double averagings, int d) {
    const DifferenceCovariance covariance(2, d, false, 1);
    auto rho = correlation(covariance, 1, std::max(1.0, averagings), d);
    const double edf = edf_of(rho) * terms / rho.terms;
    // As many independent sequences as there are starts in an averaging time.
    return {.edf = edf, .skewness_p = skewness_p_of(rho) * terms / rho.terms};
}

// Intervals of one difference.
std::int64_t span_of(DeviationKind kind, std::int64_t m) {
    return is_modified(kind) ? 3 * m - 1 : difference_order(kind) * m;
}

VarianceLaw law_of_differences(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    const int d = difference_order(kind);
    const bool modified = is_modified(kind), side_by_side = is_side_by_side(kind);
    const std::int64_t span = span_of(kind, m);
    if (span > n_intervals) return {};
    const std::int64_t starts = n_intervals - span + 1;
    const auto terms = static_cast<double>(side_by_side ? (starts - 1) / m + 1 : starts);
    const double averagings = side_by_side ? terms : terms / static_cast<double>(m);
    const bool in_parts = averagings <= max_averagings;
    const DifferenceTerms all{
        .noise = noise, .d = d, .is_modified = modified, .is_side_by_side = side_by_side, .m = m, .starts = starts};
    if (noise == 2 && !modified)
        return in_parts ? law_of_difference_parts(all, 0.0) : law_of_white_angle(terms, averagings, d);
    const DifferenceCovariance covariance(noise, d, modified, m);
    const std::int64_t fine = side_by_side ? 1 : covariance.steps(),
                       coarse = std::min(fine, skewness_steps(noise, modified));
    const auto law = [&](std::int64_t steps) {
        return correlation(covariance, steps, averagings * static_cast<double>(steps), d);
    };
    const double edf = edf_of(law(fine));
    if (in_parts) return law_of_difference_parts(all, edf);
    return {.edf = edf, .skewness_p = skewness_p_of(law(coarse))};
}

// One term has one degree of freedom; and no law is less skew than chi-square.
VarianceLaw at_least_one(const VarianceLaw& law) {
    const double edf = std::max(1.0, law.edf);
    return {.edf = edf, .skewness_p = std::clamp(law.skewness_p, std::min(edf, 0.5), edf), .parts = law.parts};
}

// V^h is nearly normal for h = 1 - 2/3 sqrt(edf/p). D. Jensen, H. Solomon, J. Amer. Statist. Assoc. 67 (1972) 898; h =
// 1/3 of chi-square is that of Wilson and Hilferty. 0 where the power would be of a negative number.
double power_quantile(double edf, double p, double z) {
    const double h = 1.0 - 2.0 / 3.0 * std::sqrt(edf / p);
    if (std::abs(h) < 1e-3) return std::exp(z * std::sqrt(2.0 / edf) - 1.0 / edf);
    const double power = 1.0 + h * (h - 1.0) / edf + z * h * std::sqrt(2.0 / edf);
    return power > 0.0 ? std::pow(power, 1.0 / h) : 0.0;
}

// Of V in units of its expectation. Two laws of the right mean, variance and skewness: the shifted chi-square
// 1 + (chi2(p) - p)/sqrt(p edf) ends too early below, chi-square times what skewness changes in the power law too late.
// The weighted geometric mean is nearly right where degrees of freedom are not few.
double quantile_by_moments(const VarianceLaw& law, double probability) {
    constexpr double min_p = 6.0;  // below, moments do not say enough
    const double p = law.skewness_p;
    const auto chi2 = [&](double dof) { return boost::math::quantile(boost::math::chi_squared(dof), probability); };
    if (p < min_p) return chi2(law.edf) / law.edf;
    const double shifted = 1.0 + (chi2(p) - p) / std::sqrt(p * law.edf);
    const double z = boost::math::quantile(boost::math::normal(), probability);
    const double plain = power_quantile(law.edf, law.edf, z), skew = power_quantile(law.edf, p, z);
    double unshifted = chi2(law.edf) / law.edf;
    if (plain > 0.0 && skew > 0.0) unshifted *= skew / plain;
    constexpr double weight = 0.75;
    return shifted > 0.0 ? std::pow(shifted, weight) * std::pow(unshifted, 1.0 - weight) : unshifted;
}

VarianceLaw law_of_all(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    if (kind != DeviationKind::totdev) return law_of_differences(kind, noise, m, n_intervals);
    return span_of(kind, m) > n_intervals ? VarianceLaw{} : total_law(noise, m, n_intervals);
}

// Beyond 64 samples a law depends on m only through T/tau, but for white and flicker noise of the angle, which depend
// on the sampling. One of 1/64 of an averaging time is as good as the next.
struct Question {
    DeviationKind kind;
    int noise;
    std::int64_t m, n_intervals;

    [[nodiscard]] auto operator<=>(const Question&) const = default;
};

Question simplified(const Question& asked) {
    constexpr std::int64_t max_m = 64, max_flicker_m = 512;
    const bool averages = is_modified(asked.kind);
    const std::int64_t m = asked.noise > 0 && !averages ? max_flicker_m : max_m;
    if (asked.m <= m || (asked.noise == 2 && !averages)) return asked;
    if (is_side_by_side(asked.kind)) return {asked.kind, asked.noise, m, m * (asked.n_intervals / asked.m)};
    const auto thinned = [&](std::int64_t n) {
        return std::llround(static_cast<double>(n) * static_cast<double>(m) / static_cast<double>(asked.m));
    };
    if (asked.kind == DeviationKind::totdev) return {asked.kind, asked.noise, m, thinned(asked.n_intervals)};
    // The starts are what counts: at least one, and so many beyond the span of one difference.
    const std::int64_t spans = averages ? 3 : difference_order(asked.kind), one = averages ? 2 : 1;
    const std::int64_t starts = std::max<std::int64_t>(1, thinned(asked.n_intervals - spans * asked.m + one));
    return {asked.kind, asked.noise, m, starts + spans * m - one};
}

constexpr std::size_t max_remembered = 4096;

// The records of a campaign, or the times of a curve, ask for the same laws again and again.
VarianceLaw remembered_law(const Question& asked) {
    thread_local std::map<Question, VarianceLaw> known;
    const Question question = simplified(asked);
    if (const auto found = known.find(question); found != known.end()) return found->second;
    if (known.size() >= max_remembered) known.clear();
    return known[question] = at_least_one(law_of_all(question.kind, question.noise, question.m, question.n_intervals));
}

// Of V over its expectation.
Interval variance_interval(const VarianceLaw& law, double confidence) {
    const double tail = 0.5 * (1.0 - confidence);
    const Tails low{.below = tail, .above = 1.0 - tail}, high{.below = 1.0 - tail, .above = tail};
    if (!law.parts) return {.low = quantile_by_moments(law, low.below), .high = quantile_by_moments(law, high.below)};
    return {.low = quantile(*law.parts, low), .high = quantile(*law.parts, high)};
}

Interval remembered_interval(const VarianceLaw& law, double confidence) {
    struct Known {
        std::shared_ptr<const Parts> parts;  // kept, so that no other has its address
        Interval interval;
    };
    thread_local std::map<std::pair<const Parts*, double>, Known> known;
    if (!law.parts) return variance_interval(law, confidence);
    const std::pair key{law.parts.get(), confidence};
    if (const auto found = known.find(key); found != known.end()) return found->second.interval;
    if (known.size() >= max_remembered) known.clear();
    return known.emplace(key, Known{law.parts, variance_interval(law, confidence)}).first->second.interval;
}

int clamped(DeviationKind kind, int noise) { return std::clamp(noise, difference_order(kind) == 3 ? -4 : -2, 2); }

}  // namespace

VarianceLaw variance_law(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    return remembered_law({kind, clamped(kind, noise), m, n_intervals});
}

void check_confidence(double confidence) {
    if (!(confidence > 0.0 && confidence <= max_confidence))
        throw SeriesError(
            fmt::format("confidence: {}, allowed is more than 0 and at most {}", confidence, max_confidence));
}

Interval confidence_interval(double deviation, const VarianceLaw& law, double confidence) {
    check_confidence(confidence);
    const Interval variance = remembered_interval(law, confidence);
    return {.low = deviation / std::sqrt(variance.high), .high = deviation / std::sqrt(variance.low)};
}

double total_variance_bias(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    return kind == DeviationKind::totdev ? total_bias(clamped(kind, noise), m, n_intervals) : 1.0;
}

}  // namespace zlg::deviations
