#include <zlg/numeric/cluster_fit.hpp>

#include <Eigen/Dense>

namespace zlg::numeric {

ClusterFit fit_clusters(const std::vector<Cluster>& clusters, Laws laws) {
    Cluster total = clusters.front();
    for (std::size_t k = 1; k < clusters.size(); ++k) {
        total.information += clusters[k].information;
        total.products += clusters[k].products;
    }
    ClusterFit fit;
    if (laws == Laws::alike)
        fit.inverse = total.information.completeOrthogonalDecomposition().pseudoInverse();
    else
        fit.inverse = total.information.inverse();
    fit.coefficient = fit.inverse * total.products;
    Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(fit.coefficient.size(), fit.coefficient.size());
    for (const Cluster& c : clusters) {
        const Eigen::VectorXd score = c.products - c.information * fit.coefficient;
        scatter += score * score.transpose();
    }
    const auto n = static_cast<double>(clusters.size());
    fit.covariance = n / (n - static_cast<double>(fit.coefficient.size())) * (fit.inverse * scatter * fit.inverse);
    return fit;
}

}  // namespace zlg::numeric
