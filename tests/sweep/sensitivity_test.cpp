// Claims about the dependence of numbers on parameters.

#include <zlg/sweep/statistics.hpp>

#include "test.hpp"

namespace zlg::sweep::sensitivity_test {

TEST(Sensitivity, ranks_correlate_by_order_alone) {
    const std::vector<double> x{1, 2, 3, 4, 5};
    EXPECT_DOUBLE_EQ(rank_correlation(x, std::vector<double>{1, 8, 27, 64, 125}).value(), 1.0);
    EXPECT_DOUBLE_EQ(rank_correlation(x, std::vector<double>{5, 4, 3, 2, 1}).value(), -1.0);
    // Ranks 1, 2.5, 2.5, 4, 5 against 1..5: 9.5/sqrt(10 * 9.5).
    EXPECT_NEAR(rank_correlation(x, std::vector<double>{0, 3, 3, 7, 9}).value(), std::sqrt(0.95), 1e-15);
    EXPECT_FALSE(rank_correlation(x, std::vector<double>{2, 2, 2, 2, 2}));
    EXPECT_FALSE(rank_correlation(std::vector<double>{1, 2}, std::vector<double>{1, 2}));
    EXPECT_NEAR(chance_correlation(101), 0.196, 1e-12);
}

}  // namespace zlg::sweep::sensitivity_test
