#include <zlg/numeric/cluster_fit.hpp>

#include "test.hpp"

namespace zlg::numeric::cluster_fit_test {

Cluster cluster_of(const std::vector<Eigen::Vector2d>& x, const std::vector<double>& y) {
    Cluster c{Eigen::MatrixXd::Zero(2, 2), Eigen::VectorXd::Zero(2)};
    for (std::size_t k = 0; k < x.size(); ++k) {
        c.information += x[k] * x[k].transpose();
        c.products += y[k] * x[k];
    }
    return c;
}

// y = 2 x0 + 3 x1, one observation of either law in each cluster, off by e, -e.
std::vector<Cluster> four(double e) {
    std::vector<Cluster> all;
    for (const double off : {e, -e, e, -e}) all.push_back(cluster_of({{1.0, 0.0}, {0.0, 1.0}}, {2.0 + off, 3.0 + off}));
    return all;
}

TEST(ClusterFit, finds_what_all_clusters_hold) {
    const ClusterFit fit = fit_clusters(four(0.0));
    EXPECT_TRUE(fit.coefficient.isApprox(Eigen::Vector2d(2.0, 3.0), 1e-12));
    EXPECT_TRUE(fit.inverse.isApprox(Eigen::MatrixXd::Identity(2, 2) / 4.0, 1e-12));
    EXPECT_LT(fit.covariance.norm(), 1e-20);
}

// Each score is (e, e) or its opposite: their sum of squares is 4 e^2 everywhere, over 4^2, times 4/(4 - 2).
TEST(ClusterFit, takes_its_error_from_the_scatter_of_the_clusters) {
    const ClusterFit fit = fit_clusters(four(0.1));
    EXPECT_TRUE(fit.covariance.isApprox(Eigen::MatrixXd::Constant(2, 2, 0.01 / 2.0), 1e-12)) << fit.covariance;
}

TEST(ClusterFit, laws_that_are_alike_share_what_there_is_and_one_of_zeros_has_no_part) {
    std::vector<Cluster> same, one;
    for (const double y : {1.0, 3.0, 2.0}) {
        same.push_back(cluster_of({{1.0, 1.0}}, {y}));
        one.push_back(cluster_of({{1.0, 0.0}}, {y}));
    }
    EXPECT_TRUE(fit_clusters(same, Laws::alike).coefficient.isApprox(Eigen::Vector2d(1.0, 1.0), 1e-12));
    const ClusterFit fit = fit_clusters(one, Laws::alike);
    EXPECT_NEAR(fit.coefficient[0], 2.0, 1e-12);
    EXPECT_EQ(fit.coefficient[1], 0.0);
    EXPECT_EQ(fit.covariance(1, 1), 0.0);
}

}  // namespace zlg::numeric::cluster_fit_test
