#pragma once
// Least squares over clusters, such as re-locks: nothing is presumed of the noise within one.
//
//   I c = sum of the products,   cov = n/(n - p) I^-1 (sum_k s_k s_k^T) I^-1,   s_k = products_k - I_k c
//
// I is the information of all n clusters, p the number of coefficients. The s_k add up to 0. Source: Liang and Zeger,
// Biometrika 73, 1986 (the sandwich estimator), with the factor for few clusters; of
// clusters of one observation White, Econometrica 48, 1980.

#include <vector>

#include <Eigen/Core>

namespace zlg::numeric {

// What a cluster adds to the normal equations.
struct Cluster {
    Eigen::MatrixXd information;  // sum of x x^T
    Eigen::VectorXd products;     // sum of x y
};

struct ClusterFit {
    Eigen::VectorXd coefficient;
    Eigen::MatrixXd inverse;     // of the information
    Eigen::MatrixXd covariance;  // from the scatter of the clusters
};

enum class Laws {
    distinct,
    alike  // by the pseudo-inverse: a combination that the clusters do not determine stays small, a column of zeros has
           // no part
};

// clusters  1 or more, of equal size.
[[nodiscard]] ClusterFit fit_clusters(const std::vector<Cluster>& clusters, Laws laws = Laws::distinct);

}  // namespace zlg::numeric
