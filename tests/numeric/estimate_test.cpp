#include <zlg/numeric/estimate.hpp>

#include "test.hpp"

using namespace zlg::numeric;

TEST(Estimate, a_number_that_is_not_finite_determines_nothing) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const auto& [value, sigma] :
         {std::pair{nan, 1.0}, {1.0, nan}, {infinite, 1.0}, {1.0, infinite}, {1.0, -1.0}}) {
        const Estimate e = estimated(value, sigma);
        EXPECT_FALSE(e.determined);
        EXPECT_FALSE(e.reason.empty());
    }
    EXPECT_TRUE(estimated(1.0, 0.0).determined);
}

TEST(Estimate, refusal_keeps_its_reason) {
    EXPECT_FALSE(refused("too short").determined);
    EXPECT_EQ(refused("too short").reason, "too short");
}

// Variance of Student's t with n degrees of freedom: n/(n - 2).
TEST(Estimate, widening_gives_student_s_variance) {
    EXPECT_DOUBLE_EQ(widened(2.0, 4.0), 2.0 * std::sqrt(2.0));
    EXPECT_NEAR(widened(1.0, 1e9), 1.0, 1e-8);
    EXPECT_TRUE(std::isinf(widened(1.0, 2.0)));
}
