#include "compensation/estimate/window_covariance.hpp"

#include "compensation/compensation_support.hpp"

namespace zlg::core::window_covariance_test {

using compensation_test::Random;
using compensation_test::Statistics;

TEST(CounterRounding, IsTheFourierSeriesOfTheSecondBernoulliPolynomial) {
    for (double x = -3.0; x < 3.0; x += 0.0737) {
        double sum = 0.0;
        for (int k = 200000; k > 0; --k) sum += std::cos(2.0 * M_PI * k * x) / (2.0 * M_PI * M_PI * k * k);
        EXPECT_NEAR(rounding_law(x, 0.0), sum, 1e-6) << x;
    }
}

TEST(CounterRounding, TwoReadingsThatTurnBySoMuchHaveThisCovariance) {
    Random random{2};
    for (const double turn : {0.0, 0.3, 7.5, 12.8}) {
        Statistics product;
        for (int k = 0; k < 400000; ++k) {
            const double phase = random.uniform(0.0, 1.0);
            const double first = std::floor(phase) - phase + 0.5;
            const double second = std::floor(phase + turn) - (phase + turn) + 0.5;
            product.add(first * second);
        }
        const double sigma = std::sqrt(product.variance() / 400000.0);
        EXPECT_NEAR(product.mean(), rounding_law(turn, 0.0), 5.0 * sigma) << turn;
    }
}

TEST(CounterRounding, ScatterOfTheTurnLeavesTheFirstTerm) {
    for (const double variance : {0.05, 0.3, 1.0})
        for (const double turn : {0.1, 0.9, 4.4}) {
            const double coherence = std::exp(-2.0 * M_PI * M_PI * variance);
            EXPECT_NEAR(rounding_law(turn, variance), rounding_law(turn, 0.0) * coherence, 1e-16);
        }
    EXPECT_EQ(rounding_law(0.0, 2.0), 0.0);
    EXPECT_EQ(rounding_law(0.0, std::nan("")), 0.0);
}

TEST(CounterRounding, BeyondThePrecisionOfANumberNoFractionIsKnown) {
    EXPECT_EQ(rounding_law(3e15, 0.0), 1.0 / 12.0);
    EXPECT_EQ(rounding_law(compensation_test::infinite, 0.0), 1.0 / 12.0);
    EXPECT_NEAR(rounding_law(1e15 + 0.5, 0.0), -1.0 / 24.0, 1e-15);
}

}  // namespace zlg::core::window_covariance_test
