#include "ramp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>

#include <zlg/deviations/series.hpp>

namespace zlg::noise {
namespace {

// 121 covariances of the blocks are factorised in each of four rounds; more blocks cost their cube and tell a slope
// from slow noise no better, for that noise lies at the lowest frequencies.
constexpr std::size_t max_blocks = 64;
constexpr double odds_of_none = 1.0 / 3.0;  // that a slow term is not there: to miss one is worse
constexpr int n_sizes = 11;                 // of each slow term, in either of two rounds
// Below the largest a logarithm of weight this far counts for nothing; on a coarse grid the largest may lie between.
constexpr std::array<double, 3> enough{40.0, 20.0, 10.0};
constexpr double next_to_nothing = 0.02;  // of the variance of the slope that other noise gives

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

// What the blocks show, as differences of neighbours.
struct Evidence {
    Eigen::VectorXd step, law;               // of the means, and of their times
    Eigen::MatrixXd known;                   // covariance by the terms given
    std::array<Eigen::MatrixXd, 2> of_slow;  // of 1: bias instability, or the Markov term, and rate random walk
};

Evidence evidence_of(const Blocks& blocks, double rate_hz, const NoiseTerms& terms) {
    const auto n = std::ssize(blocks.block);
    Eigen::VectorXd mean(n), time_s(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const Block& b = blocks.block[static_cast<std::size_t>(k)];
        mean[k] = b.mean;
        time_s[k] = b.time_s;
    }
    const Eigen::MatrixXd d = differences(n);
    const auto of = [&](const NoiseTerms& each) -> Eigen::MatrixXd {
        return d * covariance(blocks, rate_hz, each) * d.transpose();
    };
    NoiseTerms known = terms, flat{.bias_instability_arcsec_s = 1.0};
    known.bias_instability_arcsec_s = known.rate_random_walk_arcsec_s_sqrt_s = 0.0;
    const double block_s = blocks.length / rate_hz;
    // A Markov term as long as the blocks cannot be distinguished from the beginning of a random walk, which stands for
    // it.
    if (!known.markov.empty() && known.markov.front().time_s < block_s) {
        flat = {.markov = {{.deviation_arcsec_s = 1.0, .time_s = known.markov.front().time_s}}};
    }
    known.markov.clear();
    return {.step = d * mean,
            .law = d * time_s,
            .known = of(known),
            .of_slow = {of(flat), of({.rate_random_walk_arcsec_s_sqrt_s = 1.0})}};
}

// Least squares under slow terms of given squares.
struct Slope {
    double value = 0.0, variance = 0.0;
    double log_likelihood = -std::numeric_limits<double>::infinity();  // of the rest
};

using Squares = std::array<double, 2>;

Slope slope_under(const Evidence& seen, const Squares& squares) {
    const Eigen::MatrixXd c = seen.known + squares[0] * seen.of_slow[0] + squares[1] * seen.of_slow[1];
    const Eigen::LLT<Eigen::MatrixXd> root(c);
    if (root.info() != Eigen::Success) return {};
    const Eigen::VectorXd law = root.matrixL().solve(seen.law), step = root.matrixL().solve(seen.step);
    const double information = law.squaredNorm();
    Slope slope{.value = law.dot(step) / information, .variance = 1.0 / information};
    const double log_det = 2.0 * Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
    slope.log_likelihood = -0.5 * (log_det + std::log(information) + (step - slope.value * law).squaredNorm());
    if (!std::isfinite(slope.log_likelihood)) return {};
    return slope;
}

// Of one slow term: none, or one whose logarithm may lie anywhere between two, either as likely as the other.
struct Sizes {
    double least = 0.0, most = 0.0;  // squares
    double log_range = 1.0;          // of all that were likely at first

    [[nodiscard]] double at(int k) const {
        return k == 0 ? 0.0 : least * std::pow(most / least, static_cast<double>(k - 1) / (n_sizes - 2));
    }
    [[nodiscard]] double weight(int k) const {
        return k == 0 ? odds_of_none : std::log(most / least) / (log_range * (n_sizes - 2));
    }
};

// From what does not matter to more than all that is seen.
Sizes likely_sizes(const Evidence& seen, const Eigen::MatrixXd& of_slow) {
    const double most = 8.0 * seen.step.squaredNorm() / of_slow.trace();
    const Eigen::LDLT<Eigen::MatrixXd> solver(seen.known);
    const Eigen::VectorXd solved = solver.solve(seen.law);
    const double information = seen.law.dot(solved),
                 by_slow = solved.dot(of_slow * solved) / (information * information);
    const double least = next_to_nothing / (information * by_slow);
    const double used = least > 0.0 && least < 1e-3 * most ? std::max(least, 1e-9 * most) : 1e-3 * most;
    return {.least = used, .most = most, .log_range = std::log(most / used)};
}

struct Weighed {
    std::array<int, 2> at{};
    Slope slope;
    double weight = 0.0;
};

std::vector<Weighed> weighed(const Evidence& seen, const std::array<Sizes, 2>& sizes) {
    std::vector<Weighed> all;
    double largest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_sizes; ++i)
        for (int j = 0; j < n_sizes; ++j) {
            all.push_back({.at = {i, j}, .slope = slope_under(seen, {sizes[0].at(i), sizes[1].at(j)})});
            largest = std::max(largest, all.back().slope.log_likelihood);
        }
    for (auto& each : all)
        each.weight =
            std::exp(each.slope.log_likelihood - largest) * sizes[0].weight(each.at[0]) * sizes[1].weight(each.at[1]);
    return all;
}

// Sizes between the neighbours of those that weigh anything.
std::array<Sizes, 2> narrowed(const std::vector<Weighed>& all, const std::array<Sizes, 2>& sizes, double below) {
    double largest = 0.0;
    for (const auto& each : all) largest = std::max(largest, each.weight);
    std::array<Sizes, 2> narrow = sizes;
    for (std::size_t kind = 0; kind < 2; ++kind) {
        int low = n_sizes, high = 0;
        for (const auto& each : all) {
            if (!(each.weight > std::exp(-below) * largest)) continue;
            low = std::min(low, each.at[kind]);
            high = std::max(high, each.at[kind]);
        }
        narrow[kind].least = sizes[kind].at(std::clamp(low - 1, 1, n_sizes - 2));
        narrow[kind].most = sizes[kind].at(std::clamp(high + 1, 2, n_sizes - 1));
    }
    return narrow;
}

Ramp mean_over(const std::vector<Weighed>& all) {
    double every = 0.0;
    Ramp ramp;
    for (const auto& each : all) {
        every += each.weight;
        ramp.slope_arcsec_s2 += each.weight * each.slope.value;
    }
    ramp.slope_arcsec_s2 /= every;
    double variance = 0.0, beyond = 0.0;
    const boost::math::normal normal;
    for (const auto& each : all) {
        if (!(each.weight > 0.0)) continue;
        const double apart = each.slope.value - ramp.slope_arcsec_s2;
        variance += each.weight * (each.slope.variance + apart * apart);
        const double sign = ramp.slope_arcsec_s2 < 0.0 ? -1.0 : 1.0;
        beyond += each.weight * boost::math::cdf(normal, -sign * each.slope.value / std::sqrt(each.slope.variance));
    }
    ramp.sigma = std::sqrt(variance / every);
    ramp.chance = 2.0 * beyond / every;
    return ramp;
}

// Without one, all weights are 0/0.
void refuse_no_covariance(const std::vector<Weighed>& all) {
    if (std::ranges::any_of(all, [](const Weighed& each) { return each.weight > 0.0; })) return;
    throw deviations::SeriesError("ramp: no covariance of these noise terms is positive, so no slope can be weighed");
}

}  // namespace

Ramp find_ramp(std::span<const double> rates, double rate_hz, const NoiseTerms& terms) {
    const Blocks blocks = blocks_of(rates, rate_hz);
    if (std::ssize(blocks.block) < 4)
        throw deviations::SeriesError("ramp: fewer than 4 stretches of the record are known");
    const Evidence seen = evidence_of(blocks, rate_hz, terms);
    std::array<Sizes, 2> sizes{likely_sizes(seen, seen.of_slow[0]), likely_sizes(seen, seen.of_slow[1])};
    auto all = weighed(seen, sizes);
    for (const double below : enough) {
        refuse_no_covariance(all);
        sizes = narrowed(all, sizes, below);
        all = weighed(seen, sizes);
    }
    refuse_no_covariance(all);
    return mean_over(all);
}

}  // namespace zlg::noise
