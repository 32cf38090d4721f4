#include <zlg/core/common/maths_kernels.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::maths_kernels_test {

using namespace zlg::core::maths;
using namespace compensation_test;

constexpr int n_random = 100'000;

double any_normal(Random& random) { return std::ldexp(random.uniform(1.0, 2.0), random.index(-1022, 1023)); }

TEST(MathsKernels, SincosOfTurnsIsThatOfRadians) {
    Random random{2};
    for (int k = 0; k < n_random; ++k) {
        const double t = std::ldexp(random.uniform(-1.0, 1.0), random.index(-300, 48));
        const auto [sin, cos] = sincos_turns_kernel(t);
        const double rest = std::remainder(t, 1.0);
        EXPECT_NEAR(sin, maths::sin(2.0 * M_PI * rest), 1e-15 * std::min(1.0, 7.0 * std::abs(rest))) << t;
        EXPECT_NEAR(cos, maths::cos(2.0 * M_PI * rest), 1e-15) << t;
    }
}

TEST(MathsKernels, SincosOfWholeQuartersIsExact) {
    const double expected[][2] = {{0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}};
    for (const double whole : {0.0, 1.0, 123456789.0, 0x1p45})
        for (int quarter = 0; quarter < 4; ++quarter) {
            const double t = whole + 0.25 * quarter;
            const auto& [sin, cos] = expected[quarter];
            EXPECT_EQ(sincos_turns_kernel(t).sin, sin) << t;
            EXPECT_EQ(sincos_turns_kernel(t).cos, cos) << t;
            EXPECT_EQ(sincos_turns_kernel(-t).sin, -sin) << t;
            EXPECT_EQ(sincos_turns_kernel(-t).cos, cos) << t;
        }
}

TEST(MathsKernels, ASumIsExact) {
    Random random{3};
    for (int k = 0; k < n_random; ++k) {
        const double a = random.uniform(-1.0, 1.0);
        const double b = a * std::ldexp(random.uniform(-1.0, 1.0), -random.index(0, 59));
        const auto [high, low] = sum_of(a, b);
        EXPECT_TRUE(Quad{high} + Quad{low} == Quad{a} + Quad{b}) << a << " + " << b;
        EXPECT_EQ(high, a + b);
    }
}

TEST(MathsKernels, AHeadHas26BitsAndIsTruncated) {
    Random random{4};
    for (int k = 0; k < n_random; ++k) {
        const double x = any_normal(random);
        const double head = head_of(x);
        int exponent = 0;
        const double scaled_head = std::ldexp(std::frexp(head, &exponent), 26);
        EXPECT_EQ(scaled_head, std::floor(scaled_head)) << x;
        EXPECT_TRUE(head <= x && x - head < x * 0x1p-25) << x;
    }
}

TEST(MathsKernels, MantissaAndExponentMakeTheNumber) {
    Random random{5};
    for (int k = 0; k < n_random; ++k) {
        const double x = any_normal(random);
        const auto [exponent, mantissa] = scaled(x);
        EXPECT_EQ(std::ldexp(mantissa, static_cast<int>(exponent)), x);
        EXPECT_TRUE(mantissa >= std::sqrt(0.5) && mantissa < std::sqrt(2.0)) << x;
    }
}

}  // namespace zlg::core::maths_kernels_test
