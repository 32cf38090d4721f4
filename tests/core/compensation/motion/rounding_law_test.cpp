#include "compensation/motion/rounding_law.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace zlg::core {
namespace rounding_law_test {

double fraction(double x) { return x - std::floor(x); }

// Every phase that a counter may start from, none more than another.
constexpr int n_phases = 2000;

double by_enumeration(double turned) {
    double sum = 0.0;
    for (int k = 0; k < n_phases; ++k) {
        const double phase = (k + 0.5) / n_phases;
        sum += (fraction(phase) - 0.5) * (fraction(phase + turned) - 0.5);
    }
    return sum / n_phases;
}

TEST(RoundingLaw, IsThatOfEveryPhase) {
    for (double turned : {0.0, 1.0, 0.1, 0.25, 0.5, 0.9, 3.77, -0.3, -12.01, 461.2})
        EXPECT_NEAR(rounding_covariance(turned, 0.0), by_enumeration(turned), 1e-5) << turned;
}

// R as a series: the sum over m of cos(2 pi m x)/(2 pi^2 m^2), of which a normal scatter leaves exp(-2 pi^2 m^2 s^2).
double by_series(double turned, double variance) {
    double sum = 0.0;
    for (int m = 1; m < 4000; ++m) {
        const double w = 2.0 * std::numbers::pi * m;
        sum += 2.0 * std::cos(w * turned) / (w * w) * std::exp(-0.5 * w * w * variance);
    }
    return sum;
}

TEST(RoundingLaw, ScatterLeavesAsMuchAsItsSeries) {
    for (double turned : {0.0, 0.2, 0.5, 0.8}) {
        EXPECT_NEAR(by_series(turned, 0.0), rounding_covariance(turned, 0.0), 1e-4);
        for (double variance : {0.001, 0.01, 0.05, 0.1, 0.3, 1.0})
            EXPECT_NEAR(rounding_covariance(turned, variance), by_series(turned, variance), 0.021)
                << turned << " " << variance;
    }
}

TEST(RoundingLaw, FindsTheScatterInWhatTheCounterReads) {
    for (double turned : {0.0, 0.1, 0.3, 0.7, 0.95}) {
        for (double variance : {0.0, 0.02, 0.1, 0.4, 3.0, 1e6}) {
            const double read = variance + 1.0 / 6.0 - 2.0 * by_series(turned, variance);
            // What is wanted of it is the covariance.
            EXPECT_NEAR(rounding_covariance(turned, scatter_of_rotation(turned, read)), by_series(turned, variance),
                        0.02)
                << turned << " " << variance;
        }
    }
    EXPECT_EQ(scatter_of_rotation(0.0, 0.0), 0.0);
}

// The moments of a counter that turns by so many counts a tick.
MotionMomentsState learnt(double rate_counts, double step_arcsec) {
    MotionMomentsState state;
    double phase = 0.37;
    for (int k = 0; k < 9000; ++k) {
        const double before = std::floor(phase);
        phase += rate_counts;
        (void)step(MotionMomentsConfig{}, state, {true, step_arcsec * (std::floor(phase) - before), 0.0});
    }
    return state;
}

BorderWeights weights_of(const std::array<double, 8>& before, const std::array<double, 8>& after, int n_gap) {
    BorderWeights w{.gap_begin = 8, .gap_end = 8 + n_gap};
    for (int k = 0; k < 8; ++k) w.add(k, before[static_cast<unsigned>(k)]);
    for (int k = 0; k < 8; ++k) w.add(8 + n_gap + k, after[static_cast<unsigned>(k)]);
    w.add_edges();
    return w;
}

// Of all phases before a gap and all phases after it: the mean square of the roundings with these weights.
double mean_square(const BorderWeights& w, double rate_counts) {
    const auto side = [&](int from, int to) {
        double sum = 0.0;
        for (int k = 0; k < n_phases; ++k) {
            double error = 0.0;
            for (int b = from; b <= to; ++b)
                error -= w.weight[static_cast<unsigned>(b)] * (fraction((k + 0.5) / n_phases + rate_counts * b) - 0.5);
            sum += error * error;
        }
        return sum / n_phases;
    };
    return side(0, w.gap_begin) + side(w.gap_end, w.gap_end + 8);
}

TEST(RoundingLaw, TheErrorOfAGapAtASteadyRateIsThatOfEveryPhase) {
    constexpr double step = 1.7;
    constexpr int n_gap = 3;
    const std::array<double, 8> even{0.19, 0.19, 0.19, 0.19, 0.19, 0.18, 0.18, 0.19};
    const std::array<double, 8> uneven{0.1, -0.2, 0.3, -0.1, 0.5, -0.4, 0.7, 0.6};
    const CompensationConstants gyro{.scale = Arcsec{step}};
    for (double rate : {0.0, 0.003, 0.25, 0.5, 0.7668, -0.31, 153.23, 460.0071}) {
        const RoundingLaw law = rounding_law(gyro, {}, learnt(rate, step), false, 0.0);
        for (const auto& side : {even, uneven}) {
            const BorderWeights w = weights_of(side, even, n_gap);
            const RoundingSums sums = rounding_of(law, w, 1, 1);
            EXPECT_NEAR(sums.broken_arcsec2 / (step * step), mean_square(w, rate), 0.03 * mean_square(w, rate) + 0.003)
                << rate;
        }
    }
}

TEST(RoundingLaw, AtRestTheEdgesAreAllThereIs) {
    const CompensationConstants gyro{.scale = Arcsec{2.0}};
    const std::array<double, 8> uneven{0.1, -0.2, 0.3, -0.1, 0.5, -0.4, 0.7, 0.6};
    const RoundingSums sums =
        rounding_of(rounding_law(gyro, {}, learnt(0.0, 2.0), false, 0.0), weights_of(uneven, uneven, 3), 1, 1);
    EXPECT_NEAR(sums.broken_arcsec2, 4.0 / 6.0, 1e-12);
    EXPECT_NEAR(sums.continuing_arcsec2, 0.0, 1e-12);
}

// False angles that turn the phase by whole numbers and by halves.
TEST(RoundingLaw, AFalseAngleTurnsThePhase) {
    const CompensationConstants gyro{.scale = Arcsec{1.0}};
    const RoundingLaw law = rounding_law(gyro, {}, learnt(0.0, 1.0), false, 0.0);
    BorderWeights w{.gap_begin = 1, .gap_end = 4};
    w.add(0, 0.0);
    w.add(4, -0.5, 7.5);
    w.add_edges();
    // Borders 1; 4 and 5, which weigh -0.5 each and are half a count apart: 1/12 + 2 (1/4)/12 - 2 (1/4)/24.
    EXPECT_NEAR(rounding_of(law, w, 1, 1).broken_arcsec2, 1.0 / 12.0 + 1.0 / 24.0 - 1.0 / 48.0, 1e-12);
}

TEST(RoundingLaw, WithoutCountsThereIsNone) {
    const RoundingSums sums = rounding_of(RoundingLaw{}, weights_of({1.0}, {1.0}, 2), 1, 1);
    EXPECT_EQ(sums.broken_arcsec2, 0.0);
}

}  // namespace rounding_law_test
}  // namespace zlg::core
