#include <zlg/core/compensation/light_spline.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::light_spline_test {

using compensation_test::Random;

// Samples of a course of the detuning over all halves.
template <class Course> LightSums sums_of(int halves, int samples, Course course) {
    LightSums sums;
    sums.basis = light_basis(halves);
    std::vector<double> light(static_cast<unsigned>(samples));
    for (int h = 0; h < halves; ++h) {
        for (int i = 0; i < samples; ++i) light[static_cast<unsigned>(i)] = course(h + (i + 0.5) / samples);
        add(sums, h, light);
    }
    return sums;
}

TEST(LightSpline, TheBasisAddsUpToOneEverywhere) {
    for (const int halves : {1, 3, 16, 17, 40, 128, 160}) {
        const LightBasis basis = light_basis(halves);
        for (int h = 0; h < halves; ++h)
            for (const double part : {0.0, 0.3, 0.99}) {
                const auto span = span_of(basis, h);
                const auto value = values_at(span, h + part);
                double sum = 0.0;
                for (const double b : value) sum += b;
                EXPECT_NEAR(sum, 1.0, 1e-14);
                EXPECT_GE(span.first, 0);
                EXPECT_LE(span.first + 4, basis.n_terms);
            }
    }
}

TEST(LightSpline, KnotsAreAHalfApartForEightTicksAndWiderThen) {
    const LightBasis basis = light_basis(40);
    EXPECT_EQ(basis.n_terms, 24);
    EXPECT_EQ(basis.knot[3 + 16], 16.0);
    EXPECT_EQ(basis.knot[3 + 17], 20.0);
    EXPECT_EQ(basis.knot[3 + 21], 40.0);
}

// It has no third derivative: no smoothing bends it.
TEST(LightSpline, AParabolicCourseGivesItsMeanSquareInEveryHalf) {
    const auto course = [](double t) { return 0.2 - 0.03 * t + 0.0006 * t * t; };
    for (const int samples : {1, 4, 16, 64}) {
        const LightFit fit{sums_of(40, samples, course), 0.0};
        ASSERT_TRUE(fit.is_known());
        for (int h = 0; h < 40; ++h) {
            double mean_sq = 0.0;
            for (int k = 0; k < 1000; ++k) mean_sq += std::pow(course(h + (k + 0.5) / 1000.0), 2) / 1000.0;
            EXPECT_NEAR(fit.angle(fit.half(h)), mean_sq, 1e-8);
        }
    }
}

// Integrals by brute force; what the noise adds is taken off to second order, and the covariance is that of the trials.
TEST(LightSpline, TermsBeyondTheSquareAreIntegratedOverTheCourse) {
    const LossBend bend{{-60.0, 900.0, -2000.0}};
    const auto course = [](double t) { return 0.2 - 0.03 * t + 0.0006 * t * t; };
    const LightFit fit{sums_of(40, 16, course), 0.0, bend};
    for (int h = 0; h < 40; ++h) {
        double loss = 0.0;
        for (int k = 0; k < 1000; ++k) {
            const double u = std::pow(course(h + (k + 0.5) / 1000.0), 2);
            loss += (u - 60.0 * u * u + 900.0 * u * u * u - 2000.0 * u * u * u * u) / 1000.0;
        }
        EXPECT_NEAR(fit.angle(fit.half(h)), loss, 1e-7) << h;
    }
}

TEST(LightSpline, TheNoiseOfALossBeyondTheSquareIsThatOfTrials) {
    Random random{5};
    const LossBend bend{{-60.0, 900.0, -2000.0}};
    const auto course = [](double t) { return 0.2 * std::exp(-t / 6.0); };
    constexpr double noise = 0.003;
    constexpr int trials = 400;
    const LightFit exact{sums_of(40, 16, course), 1e-9, bend};
    double sum = 0.0, sum_sq = 0.0, claimed = 0.0;
    for (int k = 0; k < trials; ++k) {
        const LightFit fit{sums_of(40, 16, [&](double t) { return course(t) + noise * random.normal(); }), noise, bend};
        const LightHalf half = fit.half(1);
        const double off = fit.angle(half) - exact.angle(exact.half(1));
        sum += off / trials;
        sum_sq += off * off / trials;
        claimed += fit.covariance(half, half) / trials;
    }
    EXPECT_NEAR(sum, 0.0, 4.0 * std::sqrt(sum_sq / trials));
    EXPECT_NEAR(sum_sq / claimed, 1.0, 0.3);
}

TEST(LightSpline, TheNoiseOfTheLightAddsNothingOnTheMeanAndScattersAsItSays) {
    Random random{4};
    const auto course = [](double t) { return 0.22 * std::exp(-t / 5.0); };
    constexpr int trials = 1500;
    constexpr double noise = 0.01;
    const LightFit exact{sums_of(40, 16, course), 1e-9};
    double sum[3] = {}, square[3][3] = {}, claimed[3][3] = {};
    const int half[3] = {1, 2, 5};
    for (int k = 0; k < trials; ++k) {
        const LightFit fit{sums_of(40, 16, [&](double t) { return course(t) + noise * random.normal(); }), 0.0};
        for (int a = 0; a < 3; ++a) {
            const double off = fit.angle(fit.half(half[a])) - exact.angle(exact.half(half[a]));
            sum[a] += off;
            for (int b = 0; b < 3; ++b) {
                square[a][b] += off * (fit.angle(fit.half(half[b])) - exact.angle(exact.half(half[b])));
                claimed[a][b] += fit.covariance(fit.half(half[a]), fit.half(half[b]));
            }
        }
    }
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(sum[a] / trials, 0.0, 4.0 * std::sqrt(square[a][a]) / trials);
        for (int b = 0; b < 3; ++b)
            EXPECT_NEAR(square[a][b], claimed[a][b], 0.12 * std::sqrt(square[a][a] * square[b][b])) << a << b;
    }
}

// (Q c)^T cov c (Q c) holds its own noise, twice the trace: where nothing is detuned, the variance is claimed three
// times by the knots alone. How much is smoothed is chosen from the same noise, which adds to what is claimed for.
TEST(LightSpline, WhereNothingIsDetunedTheVarianceIsClaimedInFullAndAtMostThreeTimes) {
    Random random{5};
    double square = 0.0, claimed = 0.0;
    for (int k = 0; k < 1500; ++k) {
        const LightFit fit{sums_of(40, 16, [&](double) { return 0.01 * random.normal(); }), 0.0};
        square += fit.angle(fit.half(30)) * fit.angle(fit.half(30));
        claimed += fit.covariance(fit.half(30), fit.half(30));
    }
    EXPECT_GT(claimed / square, 1.0);
    EXPECT_LT(claimed / square, 3.0);
}

// Of a slow loop the light of one half tells of its neighbours: by the knots alone it would not.
TEST(LightSpline, ASlowLoopIsSmoothedOverManyHalves) {
    Random random{6};
    constexpr double noise = 0.0116;
    double square = 0.0;
    for (int k = 0; k < 300; ++k) {
        const auto course = [&](double t) { return 0.22 * std::exp(-t / 60.0) + noise * random.normal(); };
        const LightFit fit{sums_of(40, 8, course), noise};
        const double off =
            fit.angle(fit.half(8)) - std::pow(0.22, 2) * 30.0 * (std::exp(-8.0 / 30.0) - std::exp(-9.0 / 30.0));
        square += off * off / 300.0;
    }
    // By its own samples alone a half is known to 2 dl s/sqrt(n).
    EXPECT_LT(std::sqrt(square), 0.6 * 2.0 * 0.22 * std::exp(-8.5 / 60.0) * noise / std::sqrt(8.0));
}

TEST(LightSpline, NoSampleIsNoFit) {
    LightSums sums;
    sums.basis = light_basis(40);
    EXPECT_FALSE(LightFit(sums, 0.0033).is_known());
}

}  // namespace zlg::core::light_spline_test
