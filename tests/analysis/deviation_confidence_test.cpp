#include <zlg/analysis/deviation_confidence.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <zlg/analysis/deviation.hpp>
#include <zlg/analysis/series.hpp>

using namespace zlg::analysis;

namespace {

// Terms of a deviation as a matrix on the angles: each row one difference.
Eigen::MatrixXd terms(DeviationKind kind, int m, int n_intervals) {
    const int d = difference_order(kind);
    const bool averaged = kind == DeviationKind::mdev;
    const int window = averaged ? m : 1, step = kind == DeviationKind::adev || kind == DeviationKind::hdev ? m : 1;
    const std::array<double, 4> weight = d == 2 ? std::array{1.0, -2.0, 1.0, 0.0} : std::array{-1.0, 3.0, -3.0, 1.0};
    std::vector<Eigen::RowVectorXd> rows;
    for (int i = 0; i + d * m + window - 1 <= n_intervals; i += step) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n_intervals + 1);
        for (int k = 0; k <= d; ++k)
            for (int j = 0; j < window; ++j) row(i + k * m + j) += weight[static_cast<std::size_t>(k)];
        rows.push_back(row);
    }
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), n_intervals + 1);
    for (std::size_t k = 0; k < rows.size(); ++k) matrix.row(static_cast<Eigen::Index>(k)) = rows[k];
    return matrix;
}

// White noise summed so often is the angle; (2 - noise)/2 times for rate noise f^noise.
Eigen::MatrixXd angle_of_white_noise(int noise, int n) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(n, n);
    for (int k = noise; k < 2; k += 2)
        sum = sum.triangularView<Eigen::Lower>() *
              Eigen::MatrixXd::Ones(n, n).triangularView<Eigen::Lower>().toDenseMatrix();
    return sum;
}

// 2 <V>^2/var V and 8/skewness^2 of V = sum of squares, from the covariance of the terms.
TEST(DeviationConfidence, has_the_degrees_of_freedom_and_the_skewness_of_the_sum_of_squares) {
    constexpr int n = 60;
    for (const auto kind :
         {DeviationKind::adev, DeviationKind::oadev, DeviationKind::mdev, DeviationKind::hdev, DeviationKind::ohdev})
        for (const int noise : {2, 0, -2})
            for (const int m : {1, 2, 5, 8}) {
                const Eigen::MatrixXd a = terms(kind, m, n) * angle_of_white_noise(noise, n + 1);
                const Eigen::MatrixXd c = a * a.transpose(), c2 = c * c;
                const double edf = c.trace() * c.trace() / c2.trace();
                const double triple = (c2 * c).trace();
                const double p = c2.trace() * c2.trace() * c2.trace() / (triple * triple);
                const auto law = variance_law(kind, noise, m, n);
                // White angle noise is taken to repeat in whole averaging times; else the sums are exact.
                const double tolerance = noise == 2 && m > 1 ? 0.03 : 1e-6;
                EXPECT_NEAR(law.edf, edf, tolerance * edf) << name_of(kind) << " f^" << noise << " m " << m;
                EXPECT_NEAR(law.skewness_p, std::min(p, edf), 2.0 * tolerance * p)
                    << name_of(kind) << " f^" << noise << " m " << m;
            }
}

// Above m = 64 the continuous law takes over, and sums become integrals.
TEST(DeviationConfidence, does_not_jump_where_the_sampled_law_ends) {
    for (const auto kind : {DeviationKind::oadev, DeviationKind::mdev, DeviationKind::ohdev})
        for (const int noise : {2, 1, 0, -1, -2}) {
            const double a = variance_law(kind, noise, 64, 6400).edf, b = variance_law(kind, noise, 66, 6600).edf;
            EXPECT_NEAR(b / a, 1.0, noise == 1 || noise == 2 ? 0.04 : 0.01) << name_of(kind) << " f^" << noise;
        }
}

TEST(DeviationConfidence, is_that_of_chi_square_where_terms_are_independent) {
    // Quantiles 2.5 % and 97.5 % of chi-square with 10 degrees of freedom, from printed tables.
    const auto interval = confidence_interval(1.0, {.edf = 10.0, .skewness_p = 10.0}, 0.95);
    EXPECT_NEAR(interval.low, std::sqrt(10.0 / 20.4832), 1e-5);
    EXPECT_NEAR(interval.high, std::sqrt(10.0 / 3.24697), 1e-5);
    for (const double bad : {0.0, 1.0, -1.0, 0.9999999999999999, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((void)confidence_interval(1.0, {10.0, 10.0}, bad), SeriesError);
}

TEST(DeviationConfidence, is_a_number_up_to_the_largest_confidence) {
    for (const double edf : {1.0, 2.0, 1e3, 1e7})
        for (const double p : {0.5, 1.0, edf}) {
            const auto interval = confidence_interval(1.0, {.edf = edf, .skewness_p = p}, most_confidence);
            EXPECT_GT(interval.low, 0.0) << edf << " " << p;
            EXPECT_LT(interval.low, 1.0) << edf << " " << p;
            EXPECT_GT(interval.high, 1.0) << edf << " " << p;
            EXPECT_TRUE(std::isfinite(interval.high)) << edf << " " << p;
        }
}

TEST(DeviationConfidence, holds_the_truth_as_often_as_it_says) {
    constexpr int records = 1000, n = 256;
    std::mt19937_64 engine(21);
    std::normal_distribution<double> normal;
    const std::array<std::int64_t, 2> factors{4, 32};
    for (const int noise : {0, -2}) {
        std::array<int, 2> inside_68{}, inside_95{};
        for (int r = 0; r < records; ++r) {
            std::vector<double> rates(n);
            for (auto& rate : rates) rate = normal(engine);
            if (noise == -2) std::partial_sum(rates.begin(), rates.end(), rates.begin());
            const AngleRecord record(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = rates});
            const auto curve = deviation(record, DeviationKind::oadev, factors, {.noise = noise});
            for (std::size_t t = 0; t < 2; ++t) {
                const auto& point = curve.points[t];
                const auto m = static_cast<double>(point.m);
                const double truth = std::sqrt(noise == 0 ? 1.0 / m : (2.0 * m * m + 1.0) / (6.0 * m));
                const auto wide = confidence_interval(point.deviation, point.law, 0.95);
                inside_68[t] += point.low <= truth && truth <= point.high ? 1 : 0;
                inside_95[t] += wide.low <= truth && truth <= wide.high ? 1 : 0;
            }
        }
        // Of 1000 records the shares scatter by 1.5 % and 0.7 %.
        for (std::size_t t = 0; t < 2; ++t) {
            EXPECT_NEAR(inside_68[t] / 10.0, 68.3, 4.5) << "f^" << noise << " m " << factors[t];
            EXPECT_NEAR(inside_95[t] / 10.0, 95.0, 2.1) << "f^" << noise << " m " << factors[t];
        }
    }
}

// NIST Special Publication 1065, tables 9 to 12, for T/tau = 10.
TEST(DeviationConfidence, has_the_published_numbers_of_the_total_deviations) {
    EXPECT_NEAR(variance_law(DeviationKind::totdev, 0, 10, 100).edf, 15.0, 1e-9);
    EXPECT_NEAR(variance_law(DeviationKind::totdev, -2, 10, 100).edf, 0.927 * 10 - 0.358, 1e-9);
    EXPECT_NEAR(variance_law(DeviationKind::mtotdev, 0, 10, 100).edf, 1.10 * 10 - 1.20, 1e-9);
    EXPECT_NEAR(variance_law(DeviationKind::htotdev, 0, 10, 100).edf, 10.0 / (0.559 + 0.1004), 1e-9);
    EXPECT_NEAR(total_variance_bias(DeviationKind::totdev, -1, 10, 100), 1.0 - 0.0481, 1e-12);
    EXPECT_NEAR(total_variance_bias(DeviationKind::mtotdev, 0, 10, 100), 0.73, 1e-12);
    EXPECT_NEAR(total_variance_bias(DeviationKind::htotdev, -1, 10, 100), 1.0 - 0.149, 1e-12);
    EXPECT_EQ(total_variance_bias(DeviationKind::oadev, -1, 10, 100), 1.0);
}

}  // namespace
