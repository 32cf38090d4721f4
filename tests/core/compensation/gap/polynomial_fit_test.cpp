#include <zlg/core/compensation/polynomial_fit.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::polynomial_fit_test {

using Positions = std::vector<std::int32_t>;

PolynomialFit fit_of(const Positions& positions, int order) {
    std::array<std::int32_t, max_fit_points> position{};
    for (std::size_t k = 0; k < positions.size(); ++k) position[k] = positions[k];
    return {position, static_cast<int>(positions.size()), order};
}

const Positions extrapolation{-3, -2, -1, 0};

// The p ticks on each side of a gap of n ticks.
Positions around(int n, int p) {
    Positions positions;
    for (std::int32_t x = 1 - p; x <= 0; ++x) positions.push_back(x);
    for (std::int32_t x = n + 1; x <= n + p; ++x) positions.push_back(x);
    return positions;
}

// Weights of the sum over the ticks 1..n.
std::vector<double> weights_of_sum(const Positions& positions, int order, int n) {
    std::vector<double> sum(positions.size(), 0.0);
    const PolynomialFit fit = fit_of(positions, order);
    for (int j = 1; j <= n; ++j)
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += fit.weights(j)[k];
    return sum;
}

double sigma_of_sum(const Positions& positions, int order, int n) {
    double squares = 0.0;
    for (const double w : weights_of_sum(positions, order, n)) squares += w * w;
    return std::sqrt(squares);
}

// One line of a table: numerators over a common denominator. Every weight is rounded once, so nothing but equality will
// do.
void expect_weights(const Positions& positions, int order, int j, std::initializer_list<int> numerators,
                    int denominator) {
    const FitWeights w = fit_of(positions, order).weights(j);
    unsigned k = 0;
    for (const int numerator : numerators) {
        EXPECT_EQ(w[k], static_cast<double>(numerator) / denominator)
            << "order " << order << " tick " << j << " point " << k;
        ++k;
    }
    for (; k < max_fit_points; ++k) EXPECT_EQ(w[k], 0.0);
}

void expect_sum(const Positions& positions, int order, int n, const std::vector<double>& expected) {
    const std::vector<double> sum = weights_of_sum(positions, order, n);
    ASSERT_EQ(sum.size(), expected.size());
    for (std::size_t k = 0; k < sum.size(); ++k)
        EXPECT_NEAR(sum[k], expected[k], 1e-14 * (1.0 + std::fabs(expected[k])))
            << "order " << order << " n " << n << " point " << k;
}

TEST(PolynomialFit, ExtrapolationFromFourTicksHasTheExactWeights) {
    for (const int j : {1, 2, 3}) expect_weights(extrapolation, 0, j, {1, 1, 1, 1}, 4);
    expect_weights(extrapolation, 1, 1, {-5, 0, 5, 10}, 10);
    expect_weights(extrapolation, 1, 2, {-8, -1, 6, 13}, 10);
    expect_weights(extrapolation, 1, 3, {-11, -2, 7, 16}, 10);
    expect_weights(extrapolation, 2, 1, {3, -5, -3, 9}, 4);
    expect_weights(extrapolation, 2, 2, {39, -57, -43, 81}, 20);
    expect_weights(extrapolation, 2, 3, {73, -99, -81, 127}, 20);
}

TEST(PolynomialFit, InterpolationFromTwoTicksOnEachSideHasTheExactWeights) {
    const Positions points = around(3, 2);
    for (const int j : {1, 2, 3}) expect_weights(points, 0, j, {1, 1, 1, 1}, 4);
    expect_weights(points, 1, 1, {19, 17, 9, 7}, 52);
    expect_weights(points, 1, 2, {1, 1, 1, 1}, 4);
    expect_weights(points, 1, 3, {7, 9, 17, 19}, 52);
    expect_weights(points, 2, 1, {-12, 57, 47, -27}, 65);
    expect_weights(points, 2, 2, {-4, 9, 9, -4}, 10);
    expect_weights(points, 2, 3, {-27, 47, 57, -12}, 65);
}

// Those between two points on each side follow below for every gap.
TEST(PolynomialFit, SumsOfThreeTicksAreThoseOfTheTables) {
    expect_sum(extrapolation, 0, 3, {0.75, 0.75, 0.75, 0.75});
    expect_sum(extrapolation, 1, 3, {-2.4, -0.3, 1.8, 3.9});
    expect_sum(extrapolation, 2, 3, {6.35, -9.05, -6.95, 12.65});
}

TEST(PolynomialFit, NoiseOfTheSumOfThreeTicksIsThatOfTheTables) {
    EXPECT_NEAR(sigma_of_sum(extrapolation, 0, 3), 1.5, 1e-12);
    EXPECT_NEAR(sigma_of_sum(extrapolation, 1, 3), 4.930, 5e-4);
    EXPECT_NEAR(sigma_of_sum(extrapolation, 2, 3), 18.18, 5e-3);
    EXPECT_NEAR(sigma_of_sum(around(3, 2), 0, 3), 1.5, 1e-12);
    EXPECT_NEAR(sigma_of_sum(around(3, 2), 1, 3), 1.5, 1e-12);
    EXPECT_NEAR(sigma_of_sum(around(3, 2), 2, 3), 3.808, 5e-4);
}

TEST(PolynomialFit, NoiseGrowsWithTheOrderAndTheGapAsPublished) {
    const std::vector<double> quadratic_to_constant{1.94, 2.24, 2.54, 2.85, 3.16};
    for (int n = 1; n <= 5; ++n)
        EXPECT_NEAR(sigma_of_sum(around(n, 2), 2, n) / sigma_of_sum(around(n, 2), 0, n),
                    quadratic_to_constant[static_cast<unsigned>(n - 1)], 5.1e-3);
    EXPECT_NEAR(sigma_of_sum(around(10, 2), 2, 10) / sigma_of_sum(around(10, 2), 0, 10), 4.77, 5.1e-3);

    const std::vector<double> linear_ahead{2.45, 2.86, 3.29};
    const std::vector<double> quadratic_ahead{5.57, 8.50, 12.1};
    for (int n = 1; n <= 3; ++n) {
        const double constant = sigma_of_sum(extrapolation, 0, n);
        EXPECT_NEAR(sigma_of_sum(extrapolation, 1, n) / constant, linear_ahead[static_cast<unsigned>(n - 1)], 5.1e-3);
        EXPECT_NEAR(sigma_of_sum(extrapolation, 2, n) / constant, quadratic_ahead[static_cast<unsigned>(n - 1)], 0.051);
    }
}

TEST(PolynomialFit, ConstantAndLinearGiveTheSameSumBetweenSymmetricPoints) {
    for (int n = 1; n <= 16; ++n)
        for (int p = 1; p <= 8; ++p) {
            const std::vector<double> mean(static_cast<std::size_t>(2 * p), 0.5 * n / p);
            expect_sum(around(n, p), 0, n, mean);
            expect_sum(around(n, p), 1, n, mean);
        }
}

TEST(PolynomialFit, QuadraticSumHasTheClosedForm) {
    for (int n = 1; n <= 16; ++n) {
        const double outer = -n * (n + 1) / 12.0;
        const double inner = 0.5 * n - outer;
        expect_sum(around(n, 2), 2, n, {outer, inner, inner, outer});
    }
}

TEST(PolynomialFit, TooFewPointsLowerTheOrder) {
    EXPECT_EQ(fit_of({7}, 2).order(), 0);
    EXPECT_EQ(fit_of({7, 9}, 2).order(), 1);
    EXPECT_EQ(fit_of({7, 9}, 1).order(), 1);
    EXPECT_EQ(fit_of({7, 9, 12}, 2).order(), 2);
    EXPECT_EQ(fit_of({7, 9, 12}, 0).order(), 0);
    expect_weights({7}, 2, -60, {1}, 1);
    expect_weights({0, 2}, 2, 5, {-3, 5}, 2);
}

}  // namespace zlg::core::polynomial_fit_test
