#include "bandwidth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include <zlg/noise/spectrum.hpp>

namespace zlg::noise {
namespace {

using std::numbers::ln2;
using std::numbers::pi;

constexpr double quarter = 0.25;
constexpr std::size_t mean_bins = 2;   // a Hann window's line of the mean reaches so far
constexpr std::size_t min_bins = 8;    // for three coefficients
constexpr double bins_below = 32.0;    // of the spectrum below the cut, where the record is long enough
constexpr std::size_t min_pieces = 4;  // lengths
constexpr double known_share = 0.5;    // of a piece

// The least frequency from which on the density, over a fifth of the frequency, is below a quarter of the level without
// what is beside it.
std::size_t end_of(const Spectrum& s, const std::vector<double>& beside, std::size_t from, double level) {
    for (std::size_t k = from; k < s.density.size();) {
        const std::size_t to = std::min(s.density.size(), std::max(k + 1, k + k / 5));
        double mean = 0.0;
        for (std::size_t i = k; i < to; ++i) mean += (s.density[i] - beside[i]) / static_cast<double>(to - k);
        if (mean < quarter * level) return (k + to) / 2;
        k = to;
    }
    return s.density.size();
}

Eigen::RowVector3d law(double u) { return {1.0, std::log1p((1.0 / quarter - 1.0) * u), u}; }

// u where the logarithm has fallen by ln 2 from what it is at 0; beyond 1: nowhere.
double half_at(const Eigen::Vector3d& b) {
    const auto fall = [&](double u) { return b[0] - law(u).dot(b); };
    constexpr int steps = 4096;
    for (int k = 1; k <= steps; ++k) {
        const double before = fall((k - 1.0) / steps), here = fall(static_cast<double>(k) / steps);
        if (here >= ln2) return (k - 1.0 + (ln2 - before) / (here - before)) / steps;
    }
    return 2.0;
}

}  // namespace

Bandwidth find_bandwidth(std::span<const double> rates, double rate_hz, const NoiseTerms& terms, double memory_s) {
    std::size_t piece = 8;
    const double step_hz = 1.0 / (2.0 * pi * memory_s * bins_below);
    while (rate_hz / static_cast<double>(piece) > step_hz && 2 * piece * min_pieces <= rates.size()) piece *= 2;
    const Spectrum s = welch_spectrum(rates, rate_hz, piece, known_share);
    NoiseTerms others = terms;
    others.angle_random_walk_arcsec_sqrt_s = 0.0;
    const double white = terms.angle_random_walk_arcsec_sqrt_s * terms.angle_random_walk_arcsec_sqrt_s;
    std::vector<double> beside;
    for (const double f : s.frequency_hz) beside.push_back(2.0 * rate_spectrum(others, f, rate_hz));
    std::size_t from = mean_bins;
    while (from < beside.size() && beside[from] > 2.0 * white) ++from;
    const std::size_t end = end_of(s, beside, from, 2.0 * white);
    if (end < from + min_bins) return {};
    const double quarter_hz = s.frequency_hz[end - 1];
    const auto n = static_cast<Eigen::Index>(end - from);
    Eigen::MatrixX3d laws(n, 3);
    const Eigen::Map<const Eigen::ArrayXd> density(s.density.data() + from, n), other(beside.data() + from, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const double share = s.frequency_hz[from + static_cast<std::size_t>(k)] / quarter_hz;
        laws.row(k) = law(share * share);
    }
    // Fisher scoring of a chi-square variable whose expectation is exp(laws b) and what is beside it.
    Eigen::Matrix3d inverse;
    Eigen::Vector3d b{std::log(2.0 * white), 0.0, 0.0};
    constexpr int rounds = 40;
    for (int round = 0; round < rounds; ++round) {
        const Eigen::ArrayXd of_white = (laws * b).array().exp(), expected = of_white + other;
        const Eigen::MatrixX3d by = (of_white / expected).matrix().asDiagonal() * laws;
        inverse = (by.transpose() * by).inverse();
        b += (inverse * (by.transpose() * (density / expected - 1.0).matrix())).cwiseMax(-1.0).cwiseMin(1.0);
    }
    const double u = half_at(b);
    if (!(u <= 1.0)) return {};
    // A Hann window ties a bin to its neighbours, correlation (2/3)^2 and (1/6)^2, and a piece to the one that overlaps
    // it by half, (1/6)^2.
    const double tied = (1.0 + 2.0 * (4.0 + 0.25) / 9.0) * (1.0 + 2.0 / 36.0) / static_cast<double>(s.pieces);
    const Eigen::RowVector3d by{0.0, law(u)[1], law(u)[2]};
    const double slope = by.norm() > 0.0 ? b[1] * 3.0 / (1.0 + 3.0 * u) + b[2] : 0.0;
    const double hz = quarter_hz * std::sqrt(u);
    const double u_sigma = std::sqrt(tied * (by * inverse * by.transpose())(0)) / std::abs(slope);
    // What the law misses of nine low passes, at a million samples each: 2 % of the cut at the most.
    constexpr double missed = 0.02;
    return {.hz = hz, .sigma_hz = hz * std::hypot(0.5 * u_sigma / u, missed)};
}

}  // namespace zlg::noise
