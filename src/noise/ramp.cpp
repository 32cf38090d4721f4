#include "ramp.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include <zlg/deviations/series.hpp>

namespace zlg::noise {
namespace {

// More blocks cost their cube and tell a slope from slow noise no better, for that noise lies at the lowest
// frequencies.
constexpr std::size_t max_blocks = 64;

struct Block {
    double mean = 0.0;
    double time_s = 0.0;  // of the known samples, mean
    double n = 0.0;
    double begin = 0.0;  // samples
};

struct Blocks {
    std::vector<Block> block;
    double length = 0.0;  // samples
};

Blocks blocks_of(std::span<const double> rates, double rate_hz) {
    const std::size_t length = std::max<std::size_t>(1, (rates.size() + max_blocks - 1) / max_blocks);
    Blocks all{.block = {}, .length = static_cast<double>(length)};
    for (std::size_t from = 0; from + length <= rates.size(); from += length) {
        Block b{.begin = static_cast<double>(from)};
        for (std::size_t k = from; k < from + length; ++k) {
            if (!std::isfinite(rates[k])) continue;
            b.n += 1.0;
            b.mean += (rates[k] - b.mean) / b.n;
            b.time_s += ((static_cast<double>(k) + 0.5) / rate_hz - b.time_s) / b.n;
        }
        if (b.n > 0.0) all.block.push_back(b);
    }
    return all;
}

// Generalised covariance of the blocks' means: right for differences of them. Fewer samples leave more white noise.
Eigen::MatrixXd covariance(const Blocks& blocks, double rate_hz, const NoiseTerms& terms) {
    const double length_s = blocks.length / rate_hz;
    const double white = terms.angle_random_walk_arcsec_sqrt_s * terms.angle_random_walk_arcsec_sqrt_s;
    const double angle = terms.quantisation_arcsec * terms.quantisation_arcsec / (length_s * length_s);
    const auto n = std::ssize(blocks.block);
    Eigen::MatrixXd c(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = i; j < n; ++j) {
            const Block& a = blocks.block[static_cast<std::size_t>(i)];
            const Block& b = blocks.block[static_cast<std::size_t>(j)];
            const double apart_s = (b.begin - a.begin) / rate_hz;
            double value = (2.0 * angle_covariance(terms, apart_s) - angle_covariance(terms, apart_s + length_s) -
                            angle_covariance(terms, apart_s - length_s)) /
                           (length_s * length_s);
            if (i == j) value += 2.0 * angle + white / length_s * (blocks.length / a.n - 1.0);
            if (apart_s > 0.5 * length_s && apart_s < 1.5 * length_s) value -= angle;
            c(i, j) = c(j, i) = value;
        }
    return c;
}

Eigen::MatrixXd differences(Eigen::Index n) {
    Eigen::MatrixXd d = Eigen::MatrixXd::Zero(n - 1, n);
    for (Eigen::Index k = 0; k + 1 < n; ++k) d(k, k) = -1.0, d(k, k + 1) = 1.0;
    return d;
}

}  // namespace

Ramp find_ramp(std::span<const double> rates, double rate_hz, const NoiseTerms& terms) {
    const Blocks blocks = blocks_of(rates, rate_hz);
    const auto n = std::ssize(blocks.block);
    if (n < 4) throw deviations::SeriesError("ramp: fewer than 4 stretches of the record are known");
    Eigen::VectorXd mean(n), time_s(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        mean[k] = blocks.block[static_cast<std::size_t>(k)].mean;
        time_s[k] = blocks.block[static_cast<std::size_t>(k)].time_s;
    }
    const Eigen::MatrixXd d = differences(n);
    const Eigen::LLT<Eigen::MatrixXd> root(d * covariance(blocks, rate_hz, terms) * d.transpose());
    // Differences of neighbours, so that the level of the rate does not count: slope = (t' C^-1 r)/(t' C^-1 t).
    const Eigen::VectorXd law = root.matrixL().solve(d * time_s), step = root.matrixL().solve(d * mean);
    const double slope = law.dot(step) / law.squaredNorm(), sigma = 1.0 / law.norm();
    if (root.info() != Eigen::Success || !std::isfinite(sigma))
        throw deviations::SeriesError(
            "ramp: no covariance of these noise terms is positive, so no slope can be weighed");
    return {
        .slope_arcsec_s2 = slope, .sigma = sigma, .chance = std::erfc(std::abs(slope) / sigma / std::numbers::sqrt2)};
}

}  // namespace zlg::noise
