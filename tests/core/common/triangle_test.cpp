#include <zlg/core/common/triangle.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::triangle_test {

using compensation_test::Random;

// A A^T + 0.1 of a random A: positive definite.
std::vector<double> random_covariance(Random& random, int n) {
    std::vector<std::vector<double>> a(static_cast<unsigned>(n), std::vector<double>(static_cast<unsigned>(n)));
    for (auto& row : a)
        for (double& x : row) x = random.normal();
    std::vector<double> c(triangle_size(n));
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = i == j ? 0.1 : 0.0;
            for (unsigned k = 0; k < static_cast<unsigned>(n); ++k)
                sum += a[static_cast<unsigned>(i)][k] * a[static_cast<unsigned>(j)][k];
            c[row_start(i) + static_cast<unsigned>(j)] = sum;
        }
    return c;
}

TEST(Triangle, AFactorTimesItselfIsTheMatrixAndBothSystemsAreSolved) {
    Random random{1};
    for (const int n : {1, 2, 3, 4, 5, 7, 8, 9, 31, 64}) {
        const auto c = random_covariance(random, n);
        auto numbers = c;
        const Triangle factor{numbers.data()};
        std::vector<double> reciprocal(static_cast<unsigned>(n));
        ASSERT_TRUE(factorise(factor, reciprocal.data(), n));
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= i; ++j)
                EXPECT_NEAR(dot(factor.row(i), factor.row(j), j + 1), c[row_start(i) + static_cast<unsigned>(j)],
                            1e-12 * n);
        std::vector<double> x(static_cast<unsigned>(n));
        for (double& value : x) value = random.normal();
        std::vector<double> product(static_cast<unsigned>(n), 0.0);
        auto matrix = c;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                product[static_cast<unsigned>(i)] += Triangle{matrix.data()}.at(i, j) * x[static_cast<unsigned>(j)];
        eliminate(factor, reciprocal.data(), n, product.data());
        substitute_back(factor, reciprocal.data(), n, product.data());
        for (unsigned i = 0; i < static_cast<unsigned>(n); ++i) EXPECT_NEAR(product[i], x[i], 1e-9);
    }
}

TEST(Triangle, WhatIsNotPositiveDefiniteHasNoFactor) {
    std::vector<double> reciprocal(3);
    using Rows = std::vector<double>;
    for (Rows rows : {Rows{1, 1, 1}, Rows{1, 2, 3}, Rows{1, not_a_number, 3}, Rows{1, 0, infinity}})
        EXPECT_FALSE(factorise(Triangle{rows.data()}, reciprocal.data(), 2)) << rows[1];
}

}  // namespace zlg::core::triangle_test
