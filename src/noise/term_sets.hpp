#pragma once
// Sets of terms, fitted to the variances of a record.

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "noise_likelihood.hpp"
#include "noise_selection.hpp"

namespace zlg::noise {

inline constexpr std::size_t quantised_index = 0, white_index = 1;

// The averaging times before the octave `skipped` are left free, each at the cost of a coefficient: what a sensor does
// between samples, its filter and its rounding, ends there.
struct TermSet {
    unsigned mask = 0;  // a bit per smooth kind
    std::size_t skipped = 0;
    double time_s = 0.0;  // of the Markov term
    TermFit fit;
    double objective = std::numeric_limits<double>::infinity();  // with that of the averaging times left free
    double price = std::numeric_limits<double>::infinity();
    bool filtered = false;  // the Markov term is white noise behind a low pass of that time
    // What the set says of each kind; 0: nothing.
    std::array<double, n_smooth> square{}, variance{};

    [[nodiscard]] bool has(std::size_t kind) const { return (mask >> kind & 1u) != 0; }
    // A coefficient that sets without the shortest times cannot leave out shows where it is more than its error.
    [[nodiscard]] bool shows(std::size_t kind) const {
        return square[kind] > (skipped == 0 ? 0.0 : std::sqrt(variance[kind]));
    }
    [[nodiscard]] Eigen::Index place_of(std::size_t kind) const;  // among the coefficients; of n_smooth the time
    [[nodiscard]] std::size_t n_free() const { return static_cast<std::size_t>(fit.covariance.rows()) + skipped; }
    [[nodiscard]] double log_time_variance() const;
    // As they were fitted; what quantisation leaves at gaps is white noise.
    [[nodiscard]] NoiseTerms seen_terms(const HadamardPoints& points) const;
    // Over all averaging times.
    [[nodiscard]] Eigen::VectorXd expected(const HadamardPoints& points) const;
};

// Every basic set over all averaging times.
[[nodiscard]] TermSet all_basic_terms(const HadamardPoints& points, const Eigen::MatrixXd& relative);

// Every set of terms over all averaging times and, as far as that may be worth its price, without the shortest ones;
// that of the least price first.
//
// relative  covariance of the variances, cov(V_i, V_j)/(E_i E_j).
[[nodiscard]] std::vector<TermSet> all_sets(const HadamardPoints& points, const Eigen::MatrixXd& relative,
                                            bool with_markov);

}  // namespace zlg::noise
