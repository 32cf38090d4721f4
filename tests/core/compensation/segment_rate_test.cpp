#include <zlg/core/compensation/segment_rate.hpp>

#include "support.hpp"

namespace zlg::core::segment_rate_test {

constexpr double tick_s = 0.005;

// Of a base whose angle is given.
SegmentRate rate_of_motion(const std::function<double(double)>& angle_arcsec, std::int64_t n_ticks) {
    SegmentRateState s;
    for (std::int64_t k = 0; k < n_ticks; ++k) {
        const auto t_s = static_cast<double>(k) * tick_s;
        accumulate(s, angle_arcsec(t_s + tick_s) - angle_arcsec(t_s));
    }
    return rate_of(s, tick_s);
}

TEST(SegmentRate, AConstantRateIsFound) {
    for (const std::int64_t n : {100, 999, 9000, 200000}) {
        const SegmentRate got = rate_of_motion([](double t) { return 15.0 * t; }, n);
        EXPECT_NEAR(got.mean_arcsec_s, 15.0, 15.0 / (static_cast<double>(n) * static_cast<double>(n))) << n;
        EXPECT_NEAR(got.curvature_arcsec_s, 0.0, 0.02 / static_cast<double>(n)) << n;
    }
}

TEST(SegmentRate, ASteadyChangeHasTheMeanOfTheMiddleAndABendTheRateOfTheEndsOverThatOfTheMiddle) {
    constexpr double length_s = 9000 * tick_s;
    const auto steady = [](double t) { return 2.0 * t + 0.5 * 0.3 * t * t; };
    // rate 4 x^2, x = 2 t/L - 1
    const auto bend = [](double t) { return 4.0 * length_s / 6.0 * std::pow(2.0 * t / length_s - 1.0, 3.0); };
    const auto expect = [](const SegmentRate& got, double mean, double curvature) {
        EXPECT_NEAR(got.mean_arcsec_s, mean, 1e-6);
        EXPECT_NEAR(got.curvature_arcsec_s, curvature, 1e-5);
    };
    expect(rate_of_motion(steady, 9000), 2.0 + 0.3 * length_s / 2.0, 0.0);
    expect(rate_of_motion(bend, 9000), 4.0 / 7.0, 4.0);
}

TEST(SegmentRate, OfAnOscillationLittleIsLeft) {
    for (const double frequency_hz : {0.5, 7.03, 20.0, 20.06}) {
        const double w = 2.0 * std::numbers::pi * frequency_hz;
        double worst = 0.0;
        for (int phase = 0; phase < 16; ++phase) {
            const auto angle = [&](double t) { return -12000.0 / w * std::cos(w * t + 0.4 * phase); };
            worst = std::max(worst, std::abs(rate_of_motion(angle, 9000).mean_arcsec_s));
        }
        EXPECT_LT(worst, 12000.0 * 121.0 / std::pow(w * 45.0, 3.0) + 1e-9) << frequency_hz;
        EXPECT_GT(worst, 0.0);
    }
}

TEST(SegmentRate, WhatASwitchSpoilsAtTheEndsWeighsNothing) {
    SegmentRateState s;
    for (int k = 0; k < 9000; ++k) accumulate(s, k < 4 || k >= 8997 ? 20.0 : 0.0);
    EXPECT_LT(std::abs(rate_of(s, tick_s).mean_arcsec_s), 1e-4);
}

TEST(SegmentRate, ItsVarianceIsThatOfWalkAndRounding) {
    std::mt19937_64 random{3};
    std::normal_distribution<> normal;
    std::uniform_real_distribution<> uniform;
    constexpr int n_trials = 4000, n_ticks = 200;
    double of_walk = 0.0, of_rounding = 0.0;
    SegmentRateState s;
    for (int trial = 0; trial < n_trials; ++trial) {
        SegmentRateState walk, rounding;
        double edge = uniform(random);
        for (int k = 0; k < n_ticks; ++k) {
            accumulate(walk, 0.14 * std::sqrt(tick_s) * normal(random));
            const double next = uniform(random);
            accumulate(rounding, 3.0 * (next - edge));
            edge = next;
        }
        of_walk += std::pow(rate_of(walk, tick_s).mean_arcsec_s, 2.0) / n_trials;
        of_rounding += std::pow(rate_of(rounding, tick_s).mean_arcsec_s, 2.0) / n_trials;
        s = walk;
    }
    // 4000 trials know a variance to 2.2 %.
    EXPECT_NEAR(of_walk / mean_rate_variance(s, tick_s, 0.14, 0.0), 1.0, 0.09);
    EXPECT_NEAR(of_rounding / mean_rate_variance(s, tick_s, 0.0, 3.0), 1.0, 0.09);
}

TEST(SegmentRate, AnEmptySegmentKnowsNothing) {
    EXPECT_EQ(rate_of({}, tick_s).mean_arcsec_s, 0.0);
    EXPECT_EQ(mean_rate_variance({}, tick_s, 0.14, 3.0), std::numeric_limits<double>::infinity());
}

}  // namespace zlg::core::segment_rate_test
