#pragma once
// Covariance of least squares from the scatter of clusters, here re-locks: nothing is presumed of the noise within one.
//
//   cov = I^-1 (sum_c s_c s_c^T) I^-1      I the information of all, s_c what cluster c adds to the normal equations
//
// At the solution the s_c add up to 0. Source: Liang and Zeger, Biometrika 73, 1986 (the sandwich estimator). For few
// clusters the callers widen it by n/(n - number of coefficients).

#include <Eigen/Core>

namespace zlg::calibration {

// The sum; score_of(cluster) is s_c.
template <class Clusters, class Score>
[[nodiscard]] auto cluster_scatter(const Clusters& clusters, Score score_of) {
    using Vector = decltype(score_of(clusters.front()));
    using Matrix = Eigen::Matrix<double, Vector::RowsAtCompileTime, Vector::RowsAtCompileTime>;
    const Eigen::Index size = score_of(clusters.front()).size();
    Matrix scatter = Matrix::Zero(size, size);
    for (const auto& cluster : clusters) {
        const Vector score = score_of(cluster);
        scatter += score * score.transpose();
    }
    return scatter;
}

}  // namespace zlg::calibration
