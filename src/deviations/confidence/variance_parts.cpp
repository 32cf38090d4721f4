#include "variance_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

#include <Eigen/Eigenvalues>

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

}  // namespace zlg::deviations
