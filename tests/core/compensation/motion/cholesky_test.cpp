#include <zlg/core/compensation/cholesky.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "compensation/compensation_support.hpp"

namespace cholesky_test {

using compensation_test::Random;
using zlg::core::add_row;
using zlg::core::CholeskyFactor;
using zlg::core::Column;
using zlg::core::product;

using Matrix = std::vector<Column>;

// A A^T + 0.1 of a random A: positive definite.
Matrix random_covariance(Random& random, unsigned n) {
    Matrix a(n), c(n);
    for (Column& row : a)
        for (unsigned k = 0; k < n; ++k) row[k] = random.normal();
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) {
            c[i][j] = i == j ? 0.1 : 0.0;
            for (unsigned k = 0; k < n; ++k) c[i][j] += a[i][k] * a[j][k];
        }
    return c;
}

CholeskyFactor factor_of(const Matrix& c) {
    CholeskyFactor factor;
    for (const Column& row : c) EXPECT_TRUE(add_row(factor, row));
    return factor;
}

TEST(Cholesky, KnownFactorOfThreeByThree) {
    // [4 12 -16; 12 37 -43; -16 -43 98] = L L^T with L = [2; 6 1; -8 5 3].
    const CholeskyFactor factor = factor_of({Column{4.0}, Column{12.0, 37.0}, Column{-16.0, -43.0, 98.0}});
    const std::vector<double> expected{1.0 / 2.0, 6.0, 1.0, -8.0, 5.0, 1.0 / 3.0};
    for (unsigned k = 0; k < expected.size(); ++k) EXPECT_NEAR(factor.lower[k], expected[k], 1e-14) << k;
}

TEST(Cholesky, TheTwoTriangularSystemsInvertTheMatrix) {
    Random random{1};
    for (unsigned n : {1u, 2u, 7u, 16u, 32u}) {
        const Matrix c = random_covariance(random, n);
        const CholeskyFactor factor = factor_of(c);
        Column x{}, y{};
        for (unsigned k = 0; k < n; ++k) x[k] = random.normal();
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j) y[i] += c[i][j] * x[j];
        const Column solved = backward(factor, forward(factor, y));
        for (unsigned k = 0; k < n; ++k) EXPECT_NEAR(solved[k], x[k], 1e-9) << n << ' ' << k;
    }
}

TEST(Cholesky, TheQuadraticFormIsTheNormOfTheForwardSolution) {
    // x^T C^-1 x = |L^-1 x|^2; for a diagonal C it is the sum of squares over variances.
    CholeskyFactor factor;
    double expected = 0.0;
    Column x{};
    for (unsigned k = 0; k < 5; ++k) {
        Column row{};
        row[k] = 1.0 + k;
        x[k] = 3.0 - k;
        expected += x[k] * x[k] / row[k];
        ASSERT_TRUE(add_row(factor, row));
    }
    const Column g = forward(factor, x);
    EXPECT_NEAR(product(g, g, 5), expected, 1e-13);
}

TEST(Cholesky, ARowThatSaysNothingNewIsRefusedAndLeavesNoTrace) {
    CholeskyFactor factor;
    ASSERT_TRUE(add_row(factor, Column{2.0}));
    const CholeskyFactor before = factor;
    EXPECT_FALSE(add_row(factor, Column{2.0, 2.0}));  // the same unknown again
    EXPECT_FALSE(add_row(factor, Column{2.0, 1.0}));  // less than its own correlation
    EXPECT_FALSE(add_row(factor, Column{0.0, 0.0}));
    EXPECT_FALSE(add_row(factor, Column{0.0, compensation_test::not_a_number}));
    EXPECT_FALSE(add_row(factor, Column{0.0, compensation_test::infinite}));
    EXPECT_FALSE(add_row(factor, Column{compensation_test::not_a_number, 1.0}));
    EXPECT_EQ(factor, before);
    EXPECT_TRUE(add_row(factor, Column{2.0, 2.001}));
}

}  // namespace cholesky_test
