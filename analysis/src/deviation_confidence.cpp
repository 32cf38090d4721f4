#include <zlg/analysis/deviation_confidence.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <zlg/analysis/series.hpp>

#include "difference_covariance.hpp"

namespace zlg::analysis {
namespace {

bool is_modified(DeviationKind kind) {
    return kind == DeviationKind::mdev || kind == DeviationKind::tdev || kind == DeviationKind::mtotdev;
}

bool is_side_by_side(DeviationKind kind) { return kind == DeviationKind::adev || kind == DeviationKind::hdev; }

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

// In one averaging time: it need not be known better than to a few percent. Flicker of the angle is correlated in spikes.
std::int64_t skewness_steps(int noise, bool modified) { return noise == 1 && !modified ? 128 : 8; }

// White noise of the angle, not averaged: only whole averaging times are correlated.
VarianceLaw law_of_white_angle(double terms, double averagings, int d) {
    const DifferenceCovariance covariance(2, d, false, 1);
    auto rho = correlation(covariance, 1, std::max(1.0, averagings), d);
    const double edf = edf_of(rho) * terms / rho.terms;
    // As many independent sequences as there are starts in an averaging time.
    return {.edf = edf, .skewness_p = skewness_p_of(rho) * terms / rho.terms};
}

VarianceLaw law_of_differences(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    const int d = difference_order(kind);
    const bool modified = is_modified(kind), side_by_side = is_side_by_side(kind);
    const std::int64_t span = modified ? (d + 1) * m - 1 : d * m;
    if (span > n_intervals) return {};
    const std::int64_t starts = n_intervals - span + 1;
    const auto terms = static_cast<double>(side_by_side ? (starts - 1) / m + 1 : starts);
    const double averagings = side_by_side ? terms : terms / static_cast<double>(m);
    if (noise == 2 && !modified) return law_of_white_angle(terms, averagings, d);
    const DifferenceCovariance covariance(noise, d, modified, m);
    const std::int64_t fine = side_by_side ? 1 : covariance.steps(),
                       coarse = std::min(fine, skewness_steps(noise, modified));
    const auto law = [&](std::int64_t steps) {
        return correlation(covariance, steps, averagings * static_cast<double>(steps), d);
    };
    return {.edf = edf_of(law(fine)), .skewness_p = skewness_p_of(law(coarse))};
}

// One term has one degree of freedom; and no law is less skew than chi-square.
VarianceLaw at_least_one(const VarianceLaw& law) {
    const double edf = std::max(1.0, law.edf);
    return {.edf = edf, .skewness_p = std::clamp(law.skewness_p, std::min(edf, 0.5), edf)};
}

std::size_t row_of(int noise) { return static_cast<std::size_t>(2 - noise); }

// T/tau averaging times in the record. Rows: noise 2, 1, 0, -1, -2.
double edf_of_modified_total(int noise, double ratio) {
    constexpr std::array<std::array<double, 2>, 5> table{
        {{1.90, 2.10}, {1.20, 1.40}, {1.10, 1.20}, {0.85, 0.50}, {0.75, 0.31}}};
    const auto& row = table[row_of(std::clamp(noise, -2, 2))];
    return row[0] * ratio - row[1];
}

double edf_of_total(int noise, double ratio) {
    constexpr std::array<std::array<double, 2>, 3> table{{{1.500, 0.0}, {1.168, 0.222}, {0.927, 0.358}}};
    const auto& row = table[static_cast<std::size_t>(-std::clamp(noise, -2, 0))];
    return row[0] * ratio - row[1];
}

struct HadamardTotal {
    double bias, b0, b1;
};

const HadamardTotal& hadamard_total(int noise) {
    static constexpr std::array<HadamardTotal, 5> table{{{-0.005, 0.559, 1.004},
                                                         {-0.149, 0.868, 1.140},
                                                         {-0.229, 0.938, 1.696},
                                                         {-0.283, 0.974, 2.554},
                                                         {-0.321, 1.276, 3.149}}};
    return table[static_cast<std::size_t>(-std::clamp(noise, -4, 0))];
}

// V^h is nearly normal for h = 1 - 2/3 sqrt(edf/p). D. Jensen, H. Solomon, J. Amer. Statist. Assoc. 67 (1972) 898; h = 1/3 of
// chi-square is that of Wilson and Hilferty. 0 where the power would be of a negative number.
double power_quantile(double edf, double p, double z) {
    const double h = 1.0 - 2.0 / 3.0 * std::sqrt(edf / p);
    if (std::abs(h) < 1e-3) return std::exp(z * std::sqrt(2.0 / edf) - 1.0 / edf);
    const double power = 1.0 + h * (h - 1.0) / edf + z * h * std::sqrt(2.0 / edf);
    return power > 0.0 ? std::pow(power, 1.0 / h) : 0.0;
}

// Of V in units of its expectation. Two laws of the right mean, variance and skewness: the shifted chi-square
// 1 + (chi2(p) - p)/sqrt(p edf) ends too early below, chi-square times what skewness changes in the power law too late.
// The weighted geometric mean is nearly right, see bench/deviation_coverage; of few degrees of freedom the shift is the
// worse and weighs less.
double variance_quantile(const VarianceLaw& law, double probability) {
    const double p = law.skewness_p;
    const auto chi2 = [&](double dof) { return boost::math::quantile(boost::math::chi_squared(dof), probability); };
    const double shifted = 1.0 + (chi2(p) - p) / std::sqrt(p * law.edf);
    const double z = boost::math::quantile(boost::math::normal(), probability);
    const double plain = power_quantile(law.edf, law.edf, z), skew = power_quantile(law.edf, p, z);
    double unshifted = chi2(law.edf) / law.edf;
    if (plain > 0.0 && skew > 0.0) unshifted *= skew / plain;
    const double weight = 0.75 * std::min(1.0, p / 5.4);
    return shifted > 0.0 ? std::pow(shifted, weight) * std::pow(unshifted, 1.0 - weight) : unshifted;
}

}  // namespace

VarianceLaw variance_law(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    const double ratio = static_cast<double>(n_intervals) / static_cast<double>(m);
    const int law = std::clamp(noise, difference_order(kind) == 3 ? -4 : -2, 2);
    double edf = 0.0;
    if (kind == DeviationKind::mtotdev && m > 1)
        edf = edf_of_modified_total(law, ratio);
    else if (kind == DeviationKind::totdev && law <= 0)
        edf = edf_of_total(law, ratio);
    else if (kind == DeviationKind::htotdev && m > 1)
        edf = ratio / (hadamard_total(law).b0 + hadamard_total(law).b1 / ratio);
    else
        return at_least_one(law_of_differences(kind, law, m, n_intervals));
    return at_least_one({.edf = edf, .skewness_p = edf});
}

void check_confidence(double confidence) {
    if (!(confidence > 0.0 && confidence <= most_confidence))
        throw SeriesError(
            fmt::format("confidence: {}, allowed is more than 0 and at most {}", confidence, most_confidence));
}

Interval confidence_interval(double deviation, const VarianceLaw& law, double confidence) {
    check_confidence(confidence);
    const double tail = 0.5 * (1.0 - confidence);
    return {.low = deviation / std::sqrt(variance_quantile(law, 1.0 - tail)),
            .high = deviation / std::sqrt(variance_quantile(law, tail))};
}

double total_variance_bias(DeviationKind kind, int noise, std::int64_t m, std::int64_t n_intervals) {
    constexpr std::array<double, 3> of_total{0.0, 0.481, 0.750};
    constexpr std::array<double, 5> of_modified{0.94, 0.83, 0.73, 0.70, 0.69};
    switch (kind) {
        case DeviationKind::totdev:
            return 1.0 - of_total[static_cast<std::size_t>(-std::clamp(noise, -2, 0))] * static_cast<double>(m) /
                             static_cast<double>(n_intervals);
        case DeviationKind::mtotdev:
            return of_modified[row_of(std::clamp(noise, -2, 2))];
        case DeviationKind::htotdev:
            return m > 1 ? 1.0 + hadamard_total(noise).bias : 1.0;
        default:
            return 1.0;
    }
}

}  // namespace zlg::analysis
