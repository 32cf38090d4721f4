#include <zlg/core/compensation/optimal_bridge.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "compensation/compensation_support.hpp"

namespace optimal_bridge_test {

using compensation_test::Random;
using namespace zlg::core;

constexpr double pi = std::numbers::pi;

CompensationConstants with_count(double count_arcsec) {
    return {.scale = Arcsec{count_arcsec}, .random_walk = ArcsecPerRootSecond{0.0}};
}

// A prior of one line of 8485 arcsec/s rms at 20 Hz, 2.5 ms a half-tick.
OptimalBridgeConfig line_prior(bool halves) {
    OptimalBridgeConfig c{.learns = false, .halves = halves};
    const double half_s = 0.0025;
    const double x = pi * 20.06 * half_s;
    const double variance = 0.5 * 12000.0 * 12000.0 * half_s * half_s * std::pow(std::sin(x) / x, 2);
    for (unsigned k = 0; k < c.prior_arcsec2.size(); ++k) c.prior_arcsec2[k] = variance * std::cos(2.0 * x * k);
    return c;
}

GapProblem whole_problem(const CompensationConstants& gyro, const OptimalBridgeConfig& config, bool halves, int n_gap,
                         double error = 0.0) {
    const MotionMomentsState none;
    const MotionCovariance covariance{gyro, config, none, fast_memory};
    GapProblem problem{.halves = halves, .n_gap = n_gap, .n_side = points_a_side(n_gap)};
    const int stride = halves ? 2 : 1;
    for (int k = 0; k < stride * (2 * problem.n_side + n_gap); ++k) {
        const bool in_gap = k >= stride * problem.n_side && k < stride * (problem.n_side + n_gap);
        if (in_gap) continue;
        Column e{};
        if (k > stride * problem.n_side) e[static_cast<unsigned>(problem.factor.n)] = error;
        add_point(covariance, problem, k, e);
    }
    EXPECT_FALSE(problem.failed);
    return problem;
}

double angle(const GapEstimate& estimate, int n_gap) {
    double sum = 0.0;
    for (int j = 0; j < n_gap; ++j) sum += estimate.value_arcsec[static_cast<unsigned>(j)];
    return sum;
}

TEST(OptimalBridge, WhiteNoiseIsBridgedByTheMean) {
    // Ticks of independent errors of variance v and an unknown rate: weights 3/16, variance 3 v + 9 v/16.
    const CompensationConstants gyro{
        .tick = Seconds{0.5}, .scale = Arcsec{0.0}, .random_walk = ArcsecPerRootSecond{2.0}};
    OptimalBridgeConfig config{.learns = false};
    config.prior_arcsec2[0] = 1e-12;
    const MotionMomentsState none;
    const MotionCovariance covariance{gyro, config, none, fast_memory};
    const GapProblem problem = whole_problem(gyro, config, false, 3);
    const GapWeights w = weights(covariance, problem);
    ASSERT_TRUE(w.known);
    for (unsigned k = 0; k < 16; ++k) EXPECT_NEAR(w.weight[k], 3.0 / 16.0, 1e-9);
    EXPECT_NEAR(w.variance_arcsec2, 2.0 * (3.0 + 9.0 / 16.0), 1e-9);
}

TEST(OptimalBridge, AConstantRateIsBridgedExactlyAndTheLevelDoesNotMatter) {
    const CompensationConstants gyro = with_count(3.263);
    const OptimalBridgeConfig config = line_prior(false);
    const MotionMomentsState none;
    const MotionCovariance covariance{gyro, config, none, fast_memory};
    for (const int n : {1, 2, 3, 7, 15}) {
        const GapProblem problem = whole_problem(gyro, config, false, n);
        for (const double level : {0.0, 500.0}) {
            GapData data{.level = level};
            for (double& x : data.value) x = 7.5 - level;
            const GapEstimate found = solve(covariance, problem, data);
            ASSERT_TRUE(found.known);
            for (int j = 0; j < n; ++j) EXPECT_NEAR(found.value_arcsec[static_cast<unsigned>(j)], 7.5, 1e-8);
            EXPECT_NEAR(found.innovation_ratio, 0.0, 1e-12);
        }
    }
}

TEST(OptimalBridge, NoHalfIsMovedByTheBiasOrItsStepAtTheSwitch) {
    const CompensationConstants gyro = with_count(3.263);
    const OptimalBridgeConfig config = line_prior(true);
    const MotionMomentsState none;
    const MotionCovariance covariance{gyro, config, none, fast_memory};
    const GapProblem problem = whole_problem(gyro, config, true, 3);
    GapData data;
    for (unsigned k = 0; k < 32; ++k) data.value[k] = 1.0 + (k % 2 == 0 ? 1.0 : -1.0) * (k < 16 ? 40.0 : -90.0);
    const GapEstimate found = solve(covariance, problem, data);
    ASSERT_TRUE(found.known);
    EXPECT_NEAR(angle(found, 3), 6.0, 1e-7);
    EXPECT_NEAR(found.innovation_ratio, 0.0, 1e-9);
}

// Trials of a line of random phase read by a counter, with an error in each tick after the gap.
struct Trials {
    double mean_sq_error = 0.0, claimed = 0.0, innovation = 0.0;
};

Trials try_line(double count_arcsec, bool halves, double error_variance) {
    const CompensationConstants gyro = with_count(count_arcsec);
    const OptimalBridgeConfig config = line_prior(halves);
    const MotionMomentsState none;
    const MotionCovariance covariance{gyro, config, none, fast_memory};
    const GapProblem problem = whole_problem(gyro, config, halves, 3, error_variance);
    const int stride = halves ? 2 : 1;
    Random random{5};
    Trials result;
    constexpr int n_trials = 600;
    for (int trial = 0; trial < n_trials; ++trial) {
        const double phase = random.uniform(0.0, 2.0 * pi);
        const double offset = random.uniform(0.0, 1e4);
        const auto reading = [&](int edge) {
            const double t = 0.005 / stride * edge;
            const double true_arcsec = -12000.0 / (2.0 * pi * 20.06) * std::cos(2.0 * pi * 20.06 * t + phase) + offset;
            return count_arcsec * std::floor(true_arcsec / count_arcsec);
        };
        GapData data;
        double errors = 0.0;
        for (unsigned i = 0; i < static_cast<unsigned>(problem.factor.n); ++i) {
            const int k = problem.place[i];
            data.value[i] = reading(k + 1) - reading(k);
            if (k <= stride * problem.n_side) continue;
            const double e = std::sqrt(error_variance) * random.normal();
            data.value[i] += e;
            errors += e;
            data.error_with_all[i] = error_variance;
            data.error_variance += error_variance;
        }
        const GapEstimate found = solve(covariance, problem, data);
        double total = angle(found, 3);
        for (unsigned i = 0; i < 32; ++i) total -= data.error_with_all[i] * found.dual[i];
        // The permanent error: the gap's angle and the errors after it, against the readings at its edges.
        const double truth = reading(11 * stride) - reading(8 * stride);
        result.mean_sq_error += std::pow(total + errors - truth, 2) / n_trials;
        result.claimed += found.sum_variance_arcsec2 / n_trials;
        result.innovation += found.innovation_ratio / n_trials;
    }
    return result;
}

TEST(OptimalBridge, TheClaimedVarianceIsThatOfTrials) {
    for (const bool halves : {false, true})
        for (const double error : {0.0, 0.3}) {
            const Trials got = try_line(3.263, halves, error);
            EXPECT_NEAR(got.mean_sq_error / got.claimed, 1.0, 0.2) << halves << ' ' << error;
            EXPECT_NEAR(got.innovation, 1.0, 0.15) << halves << ' ' << error;
        }
}

TEST(OptimalBridge, AKnownToneIsBridgedToItsBound) {
    // Dense covariance of independent roundings of the edges, rate unknown: 1.62 arcsec at 1.6 arcsec of noise in a tick,
    // from tables of the theory without re-lock; here 3.263/sqrt 6 = 1.33 arcsec of noise.
    EXPECT_LT(std::sqrt(try_line(3.263, false, 0.0).mean_sq_error), 1.9);
    EXPECT_LT(std::sqrt(try_line(0.816, false, 0.0).mean_sq_error), 0.5);
}

TEST(OptimalBridge, TheProbeFindsItsFactor) {
    // e = -p d with d = 0.5, nothing else: the estimate of d is -P p^T u, and the information grows with p.
    const CompensationConstants gyro = with_count(0.5);
    const OptimalBridgeConfig config = line_prior(false);
    const MotionMomentsState none;
    const MotionCovariance covariance{gyro, config, none, fast_memory};
    const double variance = 1.0;
    GapProblem problem{.n_gap = 3, .n_side = 8};
    GapData data;
    for (int k = 0; k < 19; ++k) {
        if (k >= 8 && k < 11) continue;
        const auto n = static_cast<unsigned>(problem.factor.n);
        data.probe[n] = k == 11 ? 20.0 : k == 12 ? -8.0 : 0.0;
        Column error{};
        for (unsigned i = 0; i <= n; ++i) error[i] = variance * data.probe[i] * data.probe[n];
        data.value[n] = -0.5 * data.probe[n];
        add_point(covariance, problem, k, error);
    }
    const GapEstimate found = solve(covariance, problem, data);
    const double left = variance - variance * variance * found.probe_information;
    EXPECT_NEAR(-variance * found.probe_dual, 0.5, 3.0 * std::sqrt(left));
    EXPECT_LT(left, 0.02);
    EXPECT_GT(left, 0.0);
}

TEST(OptimalBridge, AMatrixThatCannotBeInvertedIsSaid) {
    const CompensationConstants gyro = with_count(0.0);
    OptimalBridgeConfig config = line_prior(false);  // a pure line is known from two points
    const MotionMomentsState none;
    const MotionCovariance covariance{gyro, config, none, fast_memory};
    GapProblem problem{.n_gap = 3, .n_side = 8};
    for (int k = 0; k < 8; ++k) add_point(covariance, problem, k, Column{});
    EXPECT_TRUE(problem.failed);
    EXPECT_FALSE(solve(covariance, problem, GapData{}).known);
    EXPECT_FALSE(weights(covariance, problem).known);
}

TEST(OptimalBridge, CheckNamesWhatIsWrong) {
    EXPECT_EQ(check(OptimalBridgeConfig{}), OptimalBridgeFault::none);
    EXPECT_EQ(check(line_prior(true)), OptimalBridgeFault::none);
    EXPECT_EQ(check(OptimalBridgeConfig{.learns = false}), OptimalBridgeFault::prior);
    OptimalBridgeConfig wild = line_prior(true);
    wild.prior_arcsec2[7] = 2.0 * wild.prior_arcsec2[0];
    EXPECT_EQ(check(wild), OptimalBridgeFault::prior);
}

TEST(OptimalBridge, AWindowHoldsAsManyPointsAsTheGapLeaves) {
    EXPECT_EQ(points_a_side(1), 8);
    EXPECT_EQ(points_a_side(3), 8);
    EXPECT_EQ(points_a_side(4), 7);
    EXPECT_EQ(points_a_side(11), 4);
    EXPECT_EQ(points_a_side(15), 2);
}

}  // namespace optimal_bridge_test
