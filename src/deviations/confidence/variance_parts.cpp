#include "variance_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>
#include <boost/math/tools/toms748_solve.hpp>

#include "difference_covariance.hpp"

namespace zlg::deviations {
namespace {

constexpr std::size_t max_parts = 24;
constexpr double max_cells = 128.0;

Eigen::MatrixXd covariance_by_lag(Eigen::Index n, const std::function<double(std::int64_t)>& covariance) {
    Eigen::VectorXd of_lag(n);
    for (Eigen::Index k = 0; k < n; ++k) of_lag[k] = covariance(k);
    return toeplitz(of_lag, n);
}

// White noise of the angle: only terms whole averaging times apart are correlated, so the starts fall into chains.
Parts parts_of_white_angle(const DifferenceTerms& terms) {
    const DifferenceCovariance covariance(2, terms.d, false, 1, static_cast<std::int64_t>(max_averagings) + 3);
    const std::int64_t whole = terms.starts / terms.m, longer = terms.starts % terms.m;
    Parts parts;
    for (const auto& [length, chains] : {std::pair{whole + 1, longer}, std::pair{whole, terms.m - longer}}) {
        if (length < 1 || chains < 1) continue;
        for (ChiSquarePart part : parts_of_covariance(covariance_by_lag(length, std::cref(covariance)))) {
            part.dof = static_cast<double>(chains);
            parts.push_back(part);
        }
    }
    return parts;
}

Parts parts_side_by_side(const DifferenceTerms& terms) {
    // Whole averaging times apart, white noise of the angle is correlated alike at any m.
    const DifferenceCovariance covariance(terms.noise, terms.d, terms.is_modified, terms.noise == 2 ? 1 : terms.m,
                                          static_cast<std::int64_t>(max_averagings) + 3);
    return parts_of_covariance(covariance_by_lag((terms.starts - 1) / terms.m + 1,
                                                 [&](std::int64_t k) { return covariance(k * covariance.steps()); }));
}

Parts parts_of_cells(const DifferenceTerms& terms, double edf) {
    const DifferenceCovariance covariance(terms.noise, terms.d, terms.is_modified, terms.m,
                                          static_cast<std::int64_t>(max_averagings) + 3);
    const double steps =
        static_cast<double>(terms.starts) / static_cast<double>(terms.m) * static_cast<double>(covariance.steps());
    const auto in_cell = static_cast<std::int64_t>(std::max(1.0, std::ceil(steps / max_cells)));
    const auto cells = std::max<Eigen::Index>(1, std::lround(steps / static_cast<double>(in_cell)));
    const double variance = covariance(0), square = static_cast<double>(in_cell * in_cell);
    const auto of_cells = [&](std::int64_t k) {
        double sum = 0.0;
        for (std::int64_t j = 1 - in_cell; j < in_cell; ++j)
            sum += static_cast<double>(in_cell - std::abs(j)) * covariance(std::abs(k * in_cell + j));
        return sum / (square * variance * static_cast<double>(cells));
    };
    Parts parts = parts_of_covariance(covariance_by_lag(cells, of_cells));
    double mean = 0.0, squares = 0.0;
    for (const auto& part : parts) mean += part.scale, squares += part.scale * part.scale;
    // What varies within a cell has a degree of freedom there at least.
    const double rest = 1.0 - mean, apart = static_cast<double>(cells);
    const double dof = std::clamp(rest * rest / std::max(1.0 / edf - squares, 1e-300), apart, 1e4 * apart);
    if (rest > 1e-6) parts.push_back({.scale = rest / dof, .dof = dof});
    return parts;
}

}  // namespace

Eigen::MatrixXd toeplitz(const Eigen::VectorXd& of_lag, Eigen::Index n) {
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) matrix(i, j) = of_lag[std::abs(i - j)];
    return matrix;
}

Parts parts_of_covariance(const Eigen::MatrixXd& covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance, Eigen::EigenvaluesOnly);
    Parts parts;
    for (const double value : solver.eigenvalues()) parts.push_back({.scale = std::max(0.0, value), .dof = 1.0});
    return parts;
}

Parts condensed(Parts parts) {
    std::ranges::sort(parts, std::greater{}, &ChiSquarePart::scale);
    double mean = 0.0, rest = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const double share = parts[k].scale * parts[k].dof;
        mean += share;
        if (k < max_parts) continue;
        rest += share;
        squares += share * parts[k].scale;
    }
    if (parts.size() > max_parts) parts.resize(max_parts);
    if (rest > 1e-12 * mean) parts.push_back({.scale = squares / rest, .dof = rest * rest / squares});
    std::erase_if(parts, [&](const ChiSquarePart& part) { return !(part.scale > 1e-12 * parts.front().scale); });
    for (auto& part : parts) part.scale /= mean;
    return parts;
}

VarianceLaw law_of(Parts parts) {
    double pairs = 0.0, triples = 0.0;
    for (const auto& part : parts) {
        pairs += part.dof * part.scale * part.scale;
        triples += part.dof * part.scale * part.scale * part.scale;
    }
    return {.edf = 1.0 / pairs,
            .skewness_p = pairs * pairs * pairs / (triples * triples),
            .parts = std::make_shared<const Parts>(std::move(parts))};
}

VarianceLaw law_of_difference_parts(const DifferenceTerms& terms, double edf) {
    Parts parts;
    if (terms.is_side_by_side)
        parts = parts_side_by_side(terms);
    else if (terms.noise == 2 && !terms.is_modified)
        parts = parts_of_white_angle(terms);
    else
        parts = parts_of_cells(terms, edf);
    return law_of(condensed(std::move(parts)));
}

namespace {

// Logarithm of the transform without the pole, and its derivatives, on the real axis.
struct Cumulants {
    double first = 0.0, second = 0.0, third = 0.0;
};

Cumulants cumulants(std::span<const ChiSquarePart> parts, double s) {
    Cumulants k;
    for (const auto& part : parts) {
        const double pull = 2.0 * part.scale / (1.0 + 2.0 * part.scale * s);
        k.first -= 0.5 * part.dof * pull;
        k.second += 0.5 * part.dof * pull * pull;
        k.third -= part.dof * pull * pull * pull;
    }
    return k;
}

double mean_of(std::span<const ChiSquarePart> parts) {
    double sum = 0.0;
    for (const auto& part : parts) sum += part.scale * part.dof;
    return sum;
}

double largest_scale(std::span<const ChiSquarePart> parts) {
    double largest = 0.0;
    for (const auto& part : parts) largest = std::max(largest, part.scale);
    return largest;
}

// Least of s x + K(s) - ln |s| between `low` and `high`, neither of which is reached; its slope rises from -inf to
// +inf.
double saddle(std::span<const ChiSquarePart> parts, double x, double low, double high) {
    for (int step = 0; step < 200 && high - low > 1e-6 * std::abs(low + high); ++step) {
        const double s = low > 0.0 && high > 2.0 * low ? std::sqrt(low * high) : 0.5 * (low + high);
        (x + cumulants(parts, s).first - 1.0 / s > 0.0 ? high : low) = s;
    }
    return 0.5 * (low + high);
}

// The share that scatters little. Below it a path that bends towards negative s would climb; without a bend so many
// degrees of freedom are a quick descent too.
double nearly_constant(std::span<const ChiSquarePart> parts) {
    constexpr double many = 8.0;
    double sum = 0.0;
    for (const auto& part : parts) sum += part.dof >= many ? part.scale * part.dof : 0.0;
    return sum;
}

// Along s0 + iy - b y^2 both halves are conjugate. Poles and branch points lie several steps away.
double integral(std::span<const ChiSquarePart> parts, double x, double s0) {
    constexpr double steps_a_width = 4.0, min_share = 1e-10;
    constexpr int max_steps = 4000;
    const Cumulants k = cumulants(parts, s0);
    const double bend = x > nearly_constant(parts) ? -k.third / (6.0 * k.second) : 0.0;
    const double step = 1.0 / (steps_a_width * std::sqrt(k.second + 1.0 / (s0 * s0)));
    double sum = 0.0, largest = 0.0;
    for (int n = 0; n < max_steps; ++n) {
        const double y = static_cast<double>(n) * step;
        const double re = s0 - bend * y * y;
        double size = re * x, angle = y * x;
        for (const auto& part : parts) {
            const double u = 1.0 + 2.0 * part.scale * re, v = 2.0 * part.scale * y;
            size -= 0.25 * part.dof * std::log(u * u + v * v);
            angle -= 0.5 * part.dof * std::atan2(v, u);
        }
        // ds/(i s) = (1 + 2i bend y) (re - iy)/|s|^2 dy
        size = std::exp(size) / (re * re + y * y);
        const double along_re = re + 2.0 * bend * y * y, along_im = 2.0 * bend * y * re - y;
        const double value = size * (along_re * std::cos(angle) - along_im * std::sin(angle));
        sum += n == 0 ? 0.5 * value : value;
        const double most = size * std::hypot(along_re, along_im);
        largest = std::max(largest, most);
        if (most < min_share * largest) break;
    }
    return sum * step / std::numbers::pi;
}

}  // namespace

Tails tails(std::span<const ChiSquarePart> parts, double x) {
    if (x < mean_of(parts)) {
        double high = 1.0 / x;
        while (x + cumulants(parts, high).first - 1.0 / high < 0.0) high *= 4.0;
        const double below = std::clamp(integral(parts, x, saddle(parts, x, 0.0, high)), 0.0, 1.0);
        return {.below = below, .above = 1.0 - below};
    }
    const double end = -0.5 / largest_scale(parts);
    const double above = std::clamp(-integral(parts, x, saddle(parts, x, end, 0.0)), 0.0, 1.0);
    return {.below = 1.0 - above, .above = above};
}

double quantile(std::span<const ChiSquarePart> parts, const Tails& probability) {
    const bool by_below = probability.below < probability.above;
    const double wanted = std::log(by_below ? probability.below : probability.above);
    constexpr double least = 1e-300;
    // Rises with ln x.
    const auto miss = [&](double log_x) {
        const Tails found = tails(parts, std::exp(log_x));
        return by_below ? std::log(std::max(least, found.below)) - wanted
                        : wanted - std::log(std::max(least, found.above));
    };
    const double centre = std::log(mean_of(parts));
    double low = centre, high = centre, low_miss = miss(centre), high_miss = low_miss;
    for (double step = 0.5; low_miss > 0.0 && step < 1e3; step *= 2.0) low_miss = miss(low -= step);
    for (double step = 0.5; high_miss < 0.0 && step < 1e3; step *= 2.0) high_miss = miss(high += step);
    if (low == high || low_miss == 0.0) return std::exp(low);
    if (high_miss == 0.0) return std::exp(high);
    std::uintmax_t rounds = 60;
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-8; };
    const auto root = boost::math::tools::toms748_solve(miss, low, high, low_miss, high_miss, near, rounds);
    return std::exp(0.5 * (root.first + root.second));
}

}  // namespace zlg::deviations
