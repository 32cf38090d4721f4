#pragma once
// Likelihood of measured variances under a sum of terms, each a column of what one unit of it adds. Its maximum is
// found by Fisher scoring (McCullagh and Nelder, Generalized Linear Models, 1989, ch. 2) with Levenberg-Marquardt
// damping (Marquardt, J. SIAM 11, 1963).

#include <functional>

#include <Eigen/Core>

namespace zlg::noise {

struct MeasuredVariances {
    Eigen::VectorXd value;
    Eigen::VectorXd freedom;    // degrees of freedom, nu
    Eigen::MatrixXd whitening;  // W with W^T W the inverse of the correlation
};

// Sets freedom and whitening from the relative covariance of the variances, cov(V_i, V_j)/(E_i E_j).
void set_scatter(const Eigen::MatrixXd& relative, MeasuredVariances& variances);

// A last column that depends on a time of its own.
struct TimedColumn {
    std::function<Eigen::VectorXd(double log_time)> at;  // none: there is no such column
    double log_time = 0.0;                               // to start with
    double low = 0.0, high = 0.0;                        // bounds of log_time
};

struct TermFit {
    Eigen::VectorXd coefficient;  // > 0, one per column
    double log_time = 0.0;
    Eigen::VectorXd expected;
    Eigen::MatrixXd covariance;  // of the coefficients, and of log_time
    double objective = 0.0;      // -2 log likelihood, but for a constant
    double chi2 = 0.0;           // z^T R^-1 z of the fit
};

// Chi-square variables by the cube root (Wilson and Hilferty, PNAS 17, 1931), which is nearly normal, so that the
// correlation R of neighbours can be allowed for:
//
//   z_i = ((V_i/E_i)^(1/3) - 1 + 2/(9 nu_i))/sqrt(2/(9 nu_i))      -2 log L = z^T R^-1 z + (2/3) sum log E_i
//
// E = columns coefficient. Its maximum has no bias from noisy weights: of a single variance it is E = V. Fisher scoring
// in the logarithms of the coefficients and of the time.
[[nodiscard]] TermFit fit_terms(const MeasuredVariances& variances, const Eigen::MatrixXd& columns,
                                const TimedColumn& timed = {});

}  // namespace zlg::noise
