#include <zlg/calibration/increment_fit.hpp>

#include <Eigen/Dense>

#include "test.hpp"

using namespace zlg::calibration;

namespace {

constexpr double rate = 2.5;

struct Made {
    std::vector<Increment> increments;
    Eigen::MatrixXd laws;
};

// Chains of `per_chain` increments of a rate, with a growth of 0.1 per second of the chain's own number.
Made made(int chains, int per_chain, double border_sigma, double walk_per_s, std::uint64_t seed) {
    std::mt19937_64 random{seed};
    std::normal_distribution<double> normal;
    Made m;
    m.laws.resize(chains * per_chain, 2);
    for (int c = 0; c < chains; ++c) {
        double read = border_sigma * normal(random);
        for (int k = 0; k < per_chain; ++k) {
            const double length_s = 0.5 + 0.25 * ((c + k) % 3);
            const double next = border_sigma * normal(random);
            const double walked = std::sqrt(walk_per_s * length_s) * normal(random);
            m.laws.row(c * per_chain + k) << length_s, 0.1 * c * length_s;
            m.increments.push_back({rate * length_s + 0.1 * c * length_s + next - read + walked, length_s, c});
            read = next;
        }
    }
    return m;
}

// The covariance written out.
Eigen::MatrixXd covariance_of(const std::vector<Increment>& increments, double border, double walk) {
    const Eigen::Index n = std::ssize(increments);
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index p = 0; p < n; ++p) {
        c(p, p) = 2.0 * border + walk * increments[static_cast<std::size_t>(p)].length_s;
        if (p > 0 && increments[static_cast<std::size_t>(p)].chain == increments[static_cast<std::size_t>(p) - 1].chain)
            c(p, p - 1) = c(p - 1, p) = -border;
    }
    return c;
}

}  // namespace

TEST(IncrementFit, is_generalised_least_squares_with_the_written_covariance) {
    const Made m = made(7, 5, 1.0, 0.3, 3);
    const Eigen::MatrixXd inverse = covariance_of(m.increments, 1.0, 0.3).inverse();
    Eigen::VectorXd y(m.laws.rows());
    for (Eigen::Index p = 0; p < y.size(); ++p) y[p] = m.increments[static_cast<std::size_t>(p)].value;
    const Eigen::MatrixXd covariance = (m.laws.transpose() * inverse * m.laws).inverse();
    const Eigen::VectorXd expected = covariance * m.laws.transpose() * inverse * y;
    const IncrementFit fit = fit_known(m.increments, m.laws, 1.0, 0.3);
    EXPECT_NEAR((fit.coefficient - expected).norm(), 0.0, 1e-10);
    EXPECT_NEAR((fit.covariance - covariance).norm(), 0.0, 1e-10 * covariance.norm());
    const Eigen::VectorXd left = y - m.laws * expected;
    EXPECT_NEAR(fit.residual, left.dot(inverse * left), 1e-9);
    EXPECT_EQ(fit.dof, 33);
}

TEST(IncrementFit, without_noise_the_law_is_exact) {
    const Made m = made(6, 3, 0.0, 0.0, 1);
    const IncrementFit fit = fit_walk(m.increments, m.laws, 0.5);
    EXPECT_NEAR(fit.coefficient[0], rate, 1e-12);
    EXPECT_NEAR(fit.coefficient[1], 1.0, 1e-12);
    EXPECT_EQ(fit.walk_variance_per_s, 0.0);
    EXPECT_TRUE(std::isinf(fit.walk_variance_sigma)) << "no walk is seen, so it is not determined";
}

TEST(IncrementFit, finds_the_walk_within_its_standard_error) {
    double sum = 0.0;
    double sum_sq = 0.0;
    constexpr int trials = 60;
    for (int trial = 0; trial < trials; ++trial) {
        const Made m = made(60, 4, 1.0, 2.0, 100 + static_cast<std::uint64_t>(trial));
        const IncrementFit fit = fit_walk(m.increments, m.laws, 1.0);
        const double off = (fit.walk_variance_per_s - 2.0) / fit.walk_variance_sigma;
        sum += off;
        sum_sq += off * off;
    }
    EXPECT_NEAR(sum / trials, 0.0, 3.0 / std::sqrt(trials));
    EXPECT_NEAR(sum_sq / trials, 1.0, 0.55);
}

TEST(IncrementFit, states_the_error_of_the_law) {
    double sum_sq = 0.0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        const Made m = made(20, 6, 1.0, 0.2, 500 + static_cast<std::uint64_t>(trial));
        const IncrementFit fit = fit_walk(m.increments, m.laws, 1.0);
        const double off = fit.coefficient[0] - rate;
        sum_sq += off * off / fit.covariance(0, 0);
    }
    // Four standard deviations of the mean of 200 squares: 0.4.
    EXPECT_NEAR(sum_sq / trials, 1.0, 0.4);
}

TEST(IncrementFit, units_of_the_laws_do_not_matter) {
    Made m = made(10, 4, 1.0, 0.5, 9);
    const IncrementFit before = fit_walk(m.increments, m.laws, 1.0);
    m.laws.col(1) *= 1e9;
    const IncrementFit after = fit_walk(m.increments, m.laws, 1.0);
    EXPECT_NEAR(after.coefficient[0], before.coefficient[0], 1e-9);
    EXPECT_NEAR(1e9 * after.coefficient[1], before.coefficient[1], 1e-9);
}

TEST(IncrementFit, refuses_fewer_increments_than_a_fit_needs) {
    const Made m = made(1, 2, 1.0, 0.0, 1);
    EXPECT_THROW((void)fit_walk(m.increments, m.laws, 1.0), std::invalid_argument);
    EXPECT_THROW((void)fit_known(m.increments, Eigen::MatrixXd::Ones(3, 1), 1.0, 0.0), std::invalid_argument);
}
