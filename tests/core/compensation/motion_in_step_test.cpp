#include <zlg/core/compensation/motion_in_step.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <zlg/core/compensation/segment_rate.hpp>

namespace motion_in_step_test {

using namespace zlg::core;

// n segments of weight 1 with a steady curvature and noise of one standard deviation.
MotionInStepState noisy(double curvature, int n, std::uint64_t seed, double sign = 1.0) {
    std::mt19937_64 random{seed};
    std::normal_distribution<> normal;
    MotionInStepState s;
    for (int k = 0; k < n; ++k, curvature *= sign)
        note_segment(s, 1.0, {0.1 * normal(random), normal(random), curvature + normal(random)});
    return s;
}

TEST(MotionInStep, WhatTurnsWithTheModeShowsInSize) {
    // Of 200 segments 32 count: the mean has a variance of 1/63, and 16 variances are less than 1.
    double sum_sq = 0.0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) sum_sq += seen_in_step(noisy(10.0, 200, seed), 0.0);
    // C^2 - 16 Var C, with (10^2 + 1)/63 for Var C; the mean rate may be four times as large.
    EXPECT_NEAR(sum_sq / 50.0, 16.0 * (100.0 - 16.0 * 101.0 / 63.0), 50.0);
}

TEST(MotionInStep, NoiseAndWhatDoesNotTurnWithTheModeDoNotShow) {
    int n_seen = 0;
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) n_seen += seen_in_step(noisy(0.0, 200, seed), 0.0) > 0.0;
    // Two of four standard deviations: 1.3 of ten thousand, and some more since the variance is measured.
    EXPECT_LE(n_seen, 3);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) EXPECT_EQ(seen_in_step(noisy(10.0, 200, seed, -1.0), 0.0), 0.0);
}

TEST(MotionInStep, OneTurnIsNoneAndFewSegmentsShowNothing) {
    MotionInStepState s = noisy(0.0, 100, 1);
    note_segment(s, 1.0, {1e5, 1e6, -1e6});
    EXPECT_EQ(seen_in_step(s, 0.0), 0.0);
    EXPECT_EQ(seen_in_step({}, 0.0), 0.0);
    EXPECT_EQ(seen_in_step(noisy(1000.0, 8, 1), 0.0), 0.0);
}

TEST(MotionInStep, ADriftThatTheSegmentsContradictShows) {
    MotionInStepState s;
    for (int k = 0; k < 200; ++k) note_segment(s, 1.0, {2.0, 0.0, 0.0});
    EXPECT_NEAR(mismatch_sq(s), 4.0 * (1.0 - 16.0 / 63.0), 0.05);
    EXPECT_EQ(seen_in_step(s, 0.0), 0.0);
    EXPECT_EQ(mismatch_sq({}), 0.0);
    EXPECT_EQ(mismatch_sq(noisy(10.0, 200, 1)), 0.0);
}

TEST(MotionInStep, AChangeThatAnUnknownTrendExplainsIsNone) {
    MotionInStepState s;
    for (int k = 0; k < 200; ++k) note_segment(s, 1.0, {0.0, 0.3, 0.0});
    EXPECT_GT(seen_in_step(s, 0.0), 0.0);
    EXPECT_EQ(seen_in_step(s, 0.1 * 0.1), 0.0);
}

TEST(MotionInStep, TheWeightIsTheWeight) {
    MotionInStepState s, scaled;
    for (int k = 0; k < 100; ++k) {
        note_segment(s, 1.0, {0.2, 0.5, 2.0 + k % 3});
        note_segment(scaled, 1e6, {0.2, 0.5, 2.0 + k % 3});
    }
    EXPECT_NEAR(seen_in_step(scaled, 0.0), seen_in_step(s, 0.0), 1e-9);
    // Segments without weight change nothing but the age of the others.
    for (int k = 0; k < 3; ++k) note_segment(s, 1e-12, {1e3, 1e3, -1e3});
    EXPECT_NEAR(seen_in_step(s, 0.0), seen_in_step(scaled, 0.0), 1e-6);
}

// 2 x 147/4 x 30 x 6/7 x e^3/3, the first term in e.
TEST(MotionInStep, AWaveThatJumpsLateHasTheCurvatureThatIsPresumed) {
    constexpr int n = 20000;
    constexpr double e = 0.02;
    SegmentRateState s;
    for (int k = 0; k < n; ++k) accumulate(s, k < e * n ? -1.0 : 1.0);
    EXPECT_NEAR(rate_of(s, 1.0).curvature_arcsec_s, -630.0 * e * e * e, 0.15 * 630.0 * e * e * e);
    EXPECT_NEAR(rate_of(s, 1.0).mean_arcsec_s, 1.0, 1e-3);
}

TEST(MotionInStep, OnARegularGridAnythingCouldBeThere) {
    MotionInStepState s = noisy(0.0, 100, 1);
    EXPECT_TRUE(std::isinf(unseen_in_step(s)));
    for (int k = 0; k < 1000; ++k) note_switch(s, 45.0);
    EXPECT_FALSE(unseen_in_step(s) < 1e12);
}

TEST(MotionInStep, SwitchesThatWanderLeaveLessUnseen) {
    std::mt19937_64 random{1};
    std::uniform_real_distribution<> part;
    double least = 1e12;
    for (const double width : {0.01, 0.1, 0.5}) {
        MotionInStepState s = noisy(0.0, 400, 1);
        for (int k = 0; k < 400; ++k) note_switch(s, 45.0 * (1.0 - width * part(random)));
        EXPECT_LT(unseen_in_step(s), 0.1 * least) << width;
        least = unseen_in_step(s);
    }
    // At most all of the square wave is seen: 4 standard deviations of the mean of 63 are left.
    EXPECT_GE(least, 16.0 / 63.0 * 0.5);
}

}  // namespace motion_in_step_test
