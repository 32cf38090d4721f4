#pragma once
// Which terms the variances need, and how large they are: every set of terms is fitted, the one of least penalised
// likelihood is reported (as by Akaike's criterion, with a price set by the chance of a false term), and the others
// enter the standard errors by their weight (model averaging; Burnham and Anderson, Model Selection, 2002, ch. 4).

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

struct HadamardPoints {
    std::vector<std::int64_t> m;  // powers of 2 in rising order
    Eigen::VectorXd tau_s;
    Eigen::VectorXd value;     // (arcsec/s)^2
    Eigen::VectorXd scarcity;  // differences that a record without gaps would have, over those there were
    double tau_0_s = 1.0;
    std::int64_t n_intervals = 0;
    double gap_rate_hz = 0.0;  // gaps a second: the errors of the angle at the two ends of each do not cancel
};

// Squares of Q, N, B, K, and of the deviation of the Markov term.
inline constexpr std::size_t n_smooth = 5;
inline constexpr std::size_t markov_index = 4;

struct SmoothFit {
    std::array<bool, n_smooth> found{};
    std::array<double, n_smooth> square{};  // 0 where absent
    std::array<double, n_smooth>
        square_sigma{};  // of those found; of the others one that they would have, markov excepted
    std::array<double, n_smooth> square_freed{};  // what each basic one would be, were it fitted beside those found
    std::array<double, n_smooth> mean_square{};   // over the sets of terms that fit, weighted by how well
    double filter_time_s = 0.0;                   // of a low pass behind the angle random walk; 0: there is none
    std::size_t skipped = 0;                      // octaves, from the first, of which the terms say nothing
    double markov_time_s = 0.0;
    double markov_time_sigma_s = 0.0;
    Eigen::VectorXd fitted;
    Eigen::VectorXd degrees;
    double chi2 = 0.0;
    std::int64_t dof = 0;
};

[[nodiscard]] NoiseTerms terms_of(const std::array<double, n_smooth>& squares, double markov_time_s,
                                  double filter_time_s = 0.0);

// model_error  relative, of each variance: what terms of these kinds may miss, beside chance.
[[nodiscard]] SmoothFit select_terms(const HadamardPoints& points, bool with_markov, double model_error);

}  // namespace zlg::noise
