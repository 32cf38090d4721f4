#include <zlg/core/common/maths.hpp>

#include <zlg/design/error.hpp>
#include <zlg/design/magnetic_angle.hpp>

#include "magnetic_segments.hpp"

namespace zlg::design::magnetic_angle_test {

constexpr GyroDrift warm{.magnetic_arcsec_s = 0.7, .magnetic_thermal_arcsec_s = 14.0, .thermal_time_s = 3000.0};
using core::infinity;
using core::not_a_number;

GyroDrift random_gyro(std::mt19937_64& random) {
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    return {.magnetic_arcsec_s = uniform(-20.0, 20.0),
            .magnetic_thermal_arcsec_s = uniform(-20.0, 20.0),
            .thermal_time_s = std::pow(10.0, uniform(1.0, 5.0))};
}

// Simpson's rule on the formula of the rate as it stands in the paper.
double simpson_arcsec(const GyroDrift& g, double from_s, double to_s) {
    const auto rate = [&](double t) {
        return g.magnetic_thermal_arcsec_s * (1.0 - std::exp(-t / g.thermal_time_s)) + g.magnetic_arcsec_s;
    };
    constexpr int n = 2000;
    const double step = (to_s - from_s) / n;
    double sum = rate(from_s) + rate(to_s);
    for (int k = 1; k < n; ++k) sum += (k % 2 ? 4.0 : 2.0) * rate(from_s + k * step);
    return sum * step / 3.0;
}

TEST(MagneticAngle, AGyroThatCannotBeIsRefused) {
    const auto refused = [](auto change) {
        GyroDrift gyro = warm;
        change(gyro);
        EXPECT_THROW(check(gyro), DesignError);
    };
    EXPECT_NO_THROW(check(warm));
    EXPECT_NO_THROW(check({.magnetic_arcsec_s = -0.7, .magnetic_thermal_arcsec_s = -14.0}));
    for (const double bad : {not_a_number, infinity, -infinity}) {
        refused([=](auto& g) { g.nonmagnetic_arcsec_s = bad; });
        refused([=](auto& g) { g.magnetic_arcsec_s = bad; });
        refused([=](auto& g) { g.magnetic_thermal_arcsec_s = bad; });
        refused([=](auto& g) { g.thermal_time_s = bad; });
    }
    refused([](auto& g) { g.thermal_time_s = 0.0; });
    refused([](auto& g) { g.thermal_time_s = -3000.0; });
}

TEST(MagneticAngle, ARefusalIsOneLineThatNamesTheParameterAndItsValue) {
    GyroDrift gyro = warm;
    gyro.thermal_time_s = -7.5;
    const std::string text = test::message_of<DesignError>([&] { check(gyro); });
    test::expect_contains(text, "thermal_time_s");
    test::expect_contains(text, "-7.5");
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(MagneticAngle, TheRateRisesFromItsStartByTheThermalChange) {
    EXPECT_DOUBLE_EQ(magnetic_rate_arcsec_s(warm, 0.0), 0.7);
    EXPECT_NEAR(magnetic_rate_arcsec_s(warm, 3000.0), 0.7 + 14.0 * (1.0 - 1.0 / std::exp(1.0)), 1e-12);
    EXPECT_NEAR(magnetic_rate_arcsec_s(warm, 1e6), 14.7, 1e-12);
}

TEST(MagneticAngle, TheIntegralIsThatOfTheRate) {
    std::mt19937_64 random{1};
    for (int i = 0; i < 200; ++i) {
        const GyroDrift gyro = random_gyro(random);
        const double from_s = std::uniform_real_distribution(0.0, 2.0)(random) * gyro.thermal_time_s;
        const double to_s = from_s + std::uniform_real_distribution(0.0, 2.0)(random) * gyro.thermal_time_s;
        EXPECT_NEAR(magnetic_integral_arcsec(gyro, from_s, to_s), simpson_arcsec(gyro, from_s, to_s),
                    1e-11 * 40.0 * gyro.thermal_time_s);
    }
}

TEST(MagneticAngle, TheIntegralOfAShortSegmentKeepsItsDigits) {
    // 1 ms of a gyro that warms up in a day: Om0 L + A L^2/(2 tau), the second term 1e-8 of the first.
    const GyroDrift slow{.magnetic_arcsec_s = 1e-3, .magnetic_thermal_arcsec_s = 1.0, .thermal_time_s = 1e5};
    EXPECT_NEAR(magnetic_integral_arcsec(slow, 0.0, 1e-3) / (1e-6 + 0.5e-11) - 1.0, 0.0, 1e-12);
}

TEST(MagneticAngle, TheKernelGivesTheSumOfTheIntegralsAfterEverySegment) {
    std::mt19937_64 random{2};
    for (int i = 0; i < 500; ++i) {
        const GyroDrift gyro = random_gyro(random);
        const double interval_s =
            gyro.thermal_time_s * std::pow(10.0, std::uniform_real_distribution(-3.0, 0.7)(random));
        for (const FirstSegment first : {FirstSegment::full, FirstSegment::half}) {
            std::vector<double> segments;
            for (int n = 1; n <= 30; ++n) {
                segments.push_back(n == 1 && first == FirstSegment::half ? interval_s / 2.0 : interval_s);
                EXPECT_NEAR(angle_after_segments_arcsec(gyro, interval_s, first, n), end_error_arcsec(gyro, segments),
                            1e-12 * 40.0 * interval_s * n);
            }
        }
    }
}

TEST(MagneticAngle, TheKernelOfAConstantDriftIsHalfAnInterval) {
    const GyroDrift cold{.magnetic_arcsec_s = 0.7, .magnetic_thermal_arcsec_s = 0.0};
    EXPECT_DOUBLE_EQ(kernel_arcsec(cold, 90.0, 0.0), 31.5);
    EXPECT_DOUBLE_EQ(kernel_arcsec(cold, 90.0, 5000.0), 31.5);
    // Hence nothing after an even number of segments, and all of one after an odd number.
    EXPECT_NEAR(angle_after_segments_arcsec(cold, 90.0, FirstSegment::full, 40), 0.0, 1e-12);
    EXPECT_NEAR(angle_after_segments_arcsec(cold, 90.0, FirstSegment::full, 41), 63.0, 1e-12);
    // A half first segment centres the saw.
    EXPECT_NEAR(angle_after_segments_arcsec(cold, 90.0, FirstSegment::half, 40), -31.5, 1e-12);
    EXPECT_NEAR(angle_after_segments_arcsec(cold, 90.0, FirstSegment::half, 41), 31.5, 1e-12);
}

TEST(MagneticAngle, TheSeriesOfTheKernelLacksTheFifthOrderAndNoLower) {
    // K = L/2 - L^3 D^2/24 with D = d/dt; K[exp] = tau tanh(L/2tau), whose next term is L^5/(240 tau^4).
    for (const double interval_s : {300.0, 600.0, 900.0}) {
        const double series = magnetic_rate_arcsec_s(warm, 600.0) * interval_s / 2.0 +
                              14.0 * std::exp(-0.2) / 9e6 * std::pow(interval_s, 3) / 24.0;
        const double missing = kernel_arcsec(warm, interval_s, 600.0) - series;
        const double fifth = -14.0 * std::exp(-0.2) * std::pow(interval_s, 5) / (240.0 * std::pow(3000.0, 4));
        EXPECT_NEAR(missing / fifth, 1.0, 0.011 * std::pow(interval_s / 900.0, 2));
    }
}

TEST(MagneticAngle, OddAndEvenSwitchesDifferByTwoKernelsAndNotByAWholeSawtooth) {
    // Of the two the second, L Om(t), is short of the first by L^3 D^2/12.
    const double interval_s = 900.0;
    const double t_s = 9.0 * interval_s;
    const double odd = angle_after_segments_arcsec(warm, interval_s, FirstSegment::full, 9);
    const double even_form = kernel_arcsec(warm, interval_s, 0.0) - kernel_arcsec(warm, interval_s, t_s);
    const double third = std::pow(interval_s, 3) / 12.0 * 14.0 * std::exp(-t_s / 3000.0) / 9e6;
    EXPECT_NEAR((odd - even_form - interval_s * magnetic_rate_arcsec_s(warm, t_s)) / third, 1.0, 0.02);
}

TEST(MagneticAngle, TheResidueOfAHalfFirstSegmentIsOfSecondOrder) {
    for (const double interval_s : {3.0, 30.0}) {
        EXPECT_NEAR(
            start_residue_arcsec(warm, interval_s, FirstSegment::half) / (-14.0 * interval_s * interval_s / 24000.0),
            1.0, 1e-4);
    }
    // And by its definition for a long one.
    const double interval_s = 4000.0;
    EXPECT_NEAR(start_residue_arcsec(warm, interval_s, FirstSegment::half),
                simpson_arcsec(warm, 0.0, 2000.0) - kernel_arcsec(warm, interval_s, 2000.0), 1e-6);
}

// A = 14, t = 600, L = 60: alternating full segments against A BB AA ... B with half segments at both ends.
TEST(MagneticAngle, HalfSegmentsAtBothEndsTakeTheEndErrorFrom76To0_38Arcsec) {
    EXPECT_NEAR(end_error_arcsec(warm, segments_s(60.0, FirstSegment::full, 600.0)), -76.1, 0.05);
    const auto halved = segments_s(60.0, FirstSegment::half, 600.0);
    ASSERT_EQ(halved.size(), 11U);
    EXPECT_NEAR(halved.back(), 30.0, 1e-9);
    EXPECT_NEAR(end_error_arcsec(warm, halved), -0.38, 0.005);
}

TEST(MagneticAngle, InsideThatRunTheAngleSwings96ArcsecToEitherSide) {
    double lowest = 0.0;
    double highest = 0.0;
    for (int n = 1; n <= 10; ++n) {
        const double angle = angle_after_segments_arcsec(warm, 60.0, FirstSegment::half, n);
        lowest = std::min(lowest, angle);
        highest = std::max(highest, angle);
    }
    EXPECT_NEAR(lowest, -96.0, 0.5);
    // The other side is a segment earlier and on the other side of the residue.
    EXPECT_NEAR(highest, 83.0, 3.0);
}

}  // namespace zlg::design::magnetic_angle_test
