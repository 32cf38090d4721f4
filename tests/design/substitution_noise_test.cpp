#include <zlg/design/substitution_noise.hpp>

#include <rapidcheck/gtest.h>

#include <zlg/design/error.hpp>

#include "substitution_support.hpp"

namespace zlg::design::substitution_noise_test {

using namespace substitution_test;

TEST(SubstitutionNoise, SigmaOfTheSumOverThreeTicks) {
    const auto gain = [](Fit fit, int order) { return sum_gain({fit, order, 3}, TickNoise::white); };
    EXPECT_NEAR(gain(Fit::extrapolation, 0), 1.5, 1e-14);
    EXPECT_NEAR(gain(Fit::extrapolation, 1), std::sqrt(24.3), 1e-12);             // 4.930
    EXPECT_NEAR(gain(Fit::extrapolation, 2), std::sqrt(132220.0) / 20.0, 1e-12);  // 18.18
    EXPECT_NEAR(gain(Fit::interpolation, 0), 1.5, 1e-14);
    EXPECT_NEAR(gain(Fit::interpolation, 1), 1.5, 1e-14);
    EXPECT_NEAR(gain(Fit::interpolation, 2), std::sqrt(14.5), 1e-13);  // 3.808
}

TEST(SubstitutionNoise, RatiosToTheConstant) {
    const double interpolated[] = {1.94, 2.24, 2.54, 2.85, 3.16, 3.48, 3.80, 4.12, 4.45, 4.77};
    for (int n = 1; n <= 10; ++n) {
        const double ratio = sigma_ratio_to_constant({Fit::interpolation, 2, n});
        EXPECT_NEAR(ratio, interpolated[n - 1], 0.005) << n;
        // Weights n/2 + n(n+1)/12 and -n(n+1)/12 over n/4.
        const double u = (n + 1.0) / 3.0;
        EXPECT_NEAR(ratio, std::sqrt((u * u + (2.0 + u) * (2.0 + u)) / 2.0), 1e-12) << n;
    }
    const double linear[] = {2.45, 2.86, 3.29}, quadratic[] = {5.57, 8.50, 12.1};
    for (int n = 1; n <= 3; ++n) {
        EXPECT_NEAR(sigma_ratio_to_constant({Fit::extrapolation, 1, n}), linear[n - 1], 0.005);
        EXPECT_NEAR(sigma_ratio_to_constant({Fit::extrapolation, 2, n}), quadratic[n - 1], n == 3 ? 0.05 : 0.005);
    }
}

RC_GTEST_PROP(SubstitutionNoiseLaw, CounterGainIsTheQuadraticFormOfItsCovariance, ()) {
    const Substitution s = any_substitution(20, 8);
    const auto x = points_of(s);
    const auto exact = exact_weights(s, 1, s.n);
    double form = 0.0;
    for (std::size_t a = 0; a < x.size(); ++a) {
        for (std::size_t b = 0; b < x.size(); ++b) {
            const double c = a == b ? 1.0 : std::abs(x[a] - x[b]) == 1 ? -0.5 : 0.0;  // over LSB^2/6
            form += c * Rational(exact[a] * exact[b]).convert_to<double>();
        }
    }
    const double white = sum_gain(s, TickNoise::white);
    RC_ASSERT(std::abs(std::pow(sum_gain(s, TickNoise::counter), 2) - form) <= 1e-11 * white * white);
}

// Ticks as differences of a rounded angle with independent roundings, the switch as the processor does it.
TEST(SubstitutionNoise, CounterGainsAreThoseOfARoundedAngle) {
    const Substitution s{};
    const std::array<double, 4> w{-1.0, 2.5, 2.5, -1.0};  // of ticks -1, 0, 4, 5
    std::mt19937_64 random{1};
    std::uniform_real_distribution<double> rounding{-0.5, 0.5};
    constexpr int n_trials = 400000;
    double sum = 0.0, tick = 0.0;
    for (int k = 0; k < n_trials; ++k) {
        std::array<double, 8> edge{};  // ends of ticks -2 .. 5
        for (double& e : edge) e = rounding(random);
        const auto error_of = [&](int j) {
            return edge[static_cast<std::size_t>(j + 2)] - edge[static_cast<std::size_t>(j + 1)];
        };
        const double gap = w[0] * error_of(-1) + w[1] * error_of(0) + w[2] * error_of(4) + w[3] * error_of(5);
        sum += gap * gap;
        tick += error_of(0) * error_of(0);
    }
    const double sigma = counter_tick_sigma_arcsec(1.0);
    EXPECT_NEAR(sigma, 1.0 / std::sqrt(6.0), 1e-15);
    EXPECT_NEAR(std::sqrt(tick / n_trials), sigma, 0.004 * sigma);
    EXPECT_NEAR(std::sqrt(sum / n_trials) / sigma, sum_gain(s, TickNoise::counter), 0.02);
}

// Edges 0.75 e_0 - 0.75 e_-2 + 0.75 e_5 - 0.75 e_3.
TEST(SubstitutionNoise, CounterGainsOfTheConstantInClosedForm) {
    const Substitution s{Fit::interpolation, 0, 3};
    EXPECT_NEAR(sum_gain(s, TickNoise::counter), std::sqrt(1.125), 1e-14);
    // Extrapolated from four ticks in a row, only the outer edges are left.
    EXPECT_NEAR(sum_gain({Fit::extrapolation, 0, 3}, TickNoise::counter), 0.75, 1e-14);
}

TEST(SubstitutionNoise, ThePrintedNoiseOfTheConstantIsThatOfIndependentTicks) {
    for (int n = 1; n <= 10; ++n) {
        // Each tick has half the noise: four points. Root sum square over the ticks, and their sum.
        EXPECT_NEAR(constant_noise_as_printed_arcsec(1.6, n), std::sqrt(n * 0.8 * 0.8), 1e-14);
        EXPECT_NEAR(constant_noise_arcsec(1.6, n), n * 0.8, 1e-14);
        EXPECT_NEAR(constant_noise_arcsec(1.6, n), 1.6 * sum_gain({Fit::interpolation, 0, n}, TickNoise::white), 1e-12);
    }
}

TEST(SubstitutionNoise, WhatRelockPutsIntoTheSumThroughTheFit) {
    const auto angles = [](double a, double b) { return std::array<double, 2>{a * 0.005, b * 0.005}; };
    const auto through = [](int order, const std::array<double, 2>& r) {
        return relock_through_fit_arcsec({Fit::interpolation, order, 3}, r);
    };
    const auto raw = angles(4056, 2956), table1 = angles(4056, 557), table2 = angles(336, 571);
    EXPECT_NEAR(through(0, raw), 26, 0.5);
    EXPECT_NEAR(through(2, raw), 36, 0.5);
    EXPECT_NEAR(through(0, table1), 17, 0.5);
    EXPECT_NEAR(through(2, table1), 48, 0.5);
    EXPECT_NEAR(through(0, table2), 3.4, 0.05);
    EXPECT_NEAR(through(2, table2), 1.3, 0.05);
}

TEST(SubstitutionNoise, RelockStaysInTheAngleAlsoDirectly) {
    const std::array<double, 4> residual{1.68, 2.855, -0.87, -0.355};
    EXPECT_NEAR(relock_through_fit_arcsec({}, residual), 2.5 * 1.68 - 2.855, 1e-12);
    EXPECT_NEAR(relock_residual_arcsec({}, residual), 2.5 * 1.68 - 2.855 + 3.31, 1e-12);
    EXPECT_NEAR(relock_through_fit_arcsec({Fit::extrapolation, 2, 3}, residual), 0.0, 0.0);
    EXPECT_NEAR(relock_through_fit_arcsec({}, std::array<double, 1>{2.0}), 5.0, 1e-12);
}

TEST(SubstitutionNoise, TheWholeErrorOfASwitchIsTheRootSumSquare) {
    EXPECT_NEAR(switch_error_as_printed_arcsec(3.0, 4.0), 5.0, 1e-15);
    EXPECT_NEAR(switch_error_arcsec(3.0, 4.0, 12.0), 13.0, 1e-14);
}

TEST(SubstitutionNoise, RefusesWhatIsOutOfRange) {
    const double nan = std::nan("");
    EXPECT_THROW((void)counter_tick_sigma_arcsec(-1.0), DesignError);
    EXPECT_THROW((void)constant_noise_arcsec(nan, 3), DesignError);
    EXPECT_THROW((void)constant_noise_as_printed_arcsec(1.0, 0), DesignError);
    EXPECT_THROW((void)switch_error_arcsec(1.0, nan, 1.0), DesignError);
    EXPECT_THROW((void)relock_residual_arcsec({}, std::array<double, 1>{nan}), DesignError);
}

// rms over phases of the error of simulated ticks, with the noise of the exact weights.
double simulated_rms(Substitution s, int order, double amplitude, double f, double sigma) {
    s.order = order;
    double square = 0.0;
    for (int k = 0; k < 16; ++k) {
        const double e = simulated_error(s, 1, s.n, amplitude, f, 2.0 * std::numbers::pi * k / 16);
        square += e * e / 16;
    }
    for (const Rational& w : exact_weights(s, 1, s.n)) square += std::pow(w.convert_to<double>() * sigma, 2);
    return std::sqrt(square);
}

// The paper's rows: amplitude 12 000 arcsec/s at 20 Hz, three ticks.
TEST(SubstitutionNoise, RmsErrorsOfAToneOfRandomPhase) {
    const Tone tone{12000.0, 20.0};
    const auto rms = [&](Substitution s, int order, double sigma) {
        s.order = order;
        return std::hypot(rms_arcsec(ErrorResponse(s), tone), sum_gain(s, TickNoise::white) * sigma);
    };
    EXPECT_NEAR(rms({}, 0, 1.6), 109, 0.5);
    EXPECT_NEAR(rms({}, 0, 0.53), 109, 0.5);
    EXPECT_NEAR(rms({}, 2, 1.6), 19.9, 0.05);
    EXPECT_NEAR(rms({}, 2, 0.53), 19.1, 0.05);
    Substitution quartic;
    quartic.points = {4, 3, 3};
    EXPECT_NEAR(rms(quartic, 4, 1.6), 9.6, 0.05);
    EXPECT_NEAR(rms(quartic, 4, 0.53), 4.8, 0.05);
}

TEST(SubstitutionNoise, TheOrdersChangePlacesAtTheCrossing) {
    for (const double f : {1.0, 5.0, 10.0, 20.0}) {
        const auto ratio = crossing_ratio({}, 0, 2, f);
        ASSERT_TRUE(ratio.has_value());
        const double sigma = 1.6;
        const auto rms = [&](int order, double factor) {
            return simulated_rms({}, order, factor * *ratio * sigma / 0.005, f, sigma);
        };
        EXPECT_NEAR(rms(0, 1.0), rms(2, 1.0), 1e-9 * rms(0, 1.0));
        EXPECT_LT(rms(0, 0.999), rms(2, 0.999));
        EXPECT_GT(rms(0, 1.001), rms(2, 1.001));
    }
    EXPECT_FALSE(crossing_ratio({}, 0, 1, 20.0).has_value());  // the same estimator
    EXPECT_FALSE(crossing_ratio({}, 2, 0, 20.0).has_value());
    EXPECT_THROW((void)crossing_ratio({}, 0, 4, 1.0), DesignError);
}

// Extrapolated over three ticks at 20 Hz the line is worse than the constant in motion, 312 to 259, and in noise.
TEST(SubstitutionNoise, AnOrderThatIsBetterInBothWinsFromTheStart) {
    const auto ratio = crossing_ratio({.fit = Fit::extrapolation}, 1, 0, 20.0);
    ASSERT_TRUE(ratio.has_value());
    EXPECT_EQ(*ratio, 0.0);
}

}  // namespace zlg::design::substitution_noise_test
