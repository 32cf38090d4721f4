#include <zlg/core/compensation/border.hpp>

#include "support.hpp"

namespace zlg::core::border_test {

HalfRecord ended_at(float fringe) {
    HalfRecord half;
    half.fringe = fringe;
    return half;
}

constexpr CompensationConstants gyro{.scale = Arcsec{3.0}, .fringe_noise_counts = 0.002};

TEST(Border, APlaceIsKnownFrom0To65535AndElseTheMiddleOfTheCount) {
    for (const float known : {0.0f, 1.0f, 32768.0f, 65535.0f}) {
        EXPECT_TRUE(border_of(ended_at(known)).is_known());
        EXPECT_EQ(border_of(ended_at(known)).parts(), static_cast<std::int32_t>(known));
    }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (const float other : {nan, inf, -inf, -1.0f, 65536.0f, 1e30f}) {
        EXPECT_FALSE(border_of(ended_at(other)).is_known()) << other;
        EXPECT_EQ(border_of(ended_at(other)).parts(), 32768);
    }
    EXPECT_FALSE(border_of(HalfRecord{}).is_known());
}

TEST(Border, CountsAndPartsAreExact) {
    EXPECT_EQ(counts_and_parts(7, 16384), 7.25);
    EXPECT_EQ(counts_and_parts(-7, -1), -7.0 - std::ldexp(1.0, -16));
    const std::int64_t many = (std::int64_t{1} << 36) - 1;
    EXPECT_EQ(counts_and_parts(many, 1) - static_cast<double>(many), std::ldexp(1.0, -16));
    EXPECT_EQ(parts_between(Border{65535}, Border{3}), -65532);
    EXPECT_EQ(parts_between(Border{}, Border{}), 0);
}

// A uniform rounding to a count has the variance 1/12, to a 65536th of it 65536^2 times less.
TEST(Border, TheVarianceOfATickIsThatOfItsTwoReadings) {
    const double count = 9.0 / 12.0;
    const double phase = 9.0 * (0.002 * 0.002 + 1.0 / 12.0 / 65536.0 / 65536.0);
    const Border known{5};
    EXPECT_DOUBLE_EQ(rounding_arcsec2(gyro, Border{}, Border{}), 2.0 * count);
    EXPECT_DOUBLE_EQ(rounding_arcsec2(gyro, known, Border{}), count + phase);
    EXPECT_DOUBLE_EQ(rounding_arcsec2(gyro, Border{}, known), count + phase);
    EXPECT_DOUBLE_EQ(rounding_arcsec2(gyro, known, known), 2.0 * phase);
    EXPECT_EQ(rounding_arcsec2(gyro, false), rounding_arcsec2(gyro));
    EXPECT_DOUBLE_EQ(rounding_arcsec2(gyro, true), 2.0 * phase);
}

TEST(Border, NeighboursShareNoMoreThanEitherHas) {
    EXPECT_EQ(shared_rounding(1.5, 2.0, 3.0), 1.5);
    EXPECT_EQ(shared_rounding(1.5, 2.0, 0.1), 0.1);
    EXPECT_EQ(shared_rounding(1.5, 0.0, 3.0), 0.0);
    EXPECT_EQ(shared_rounding(1.5, 2.0, infinity), 1.5);
}

}  // namespace zlg::core::border_test
