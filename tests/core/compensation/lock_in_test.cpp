// What lock-in takes from the counts, against the mean beat of Adler's equation, found here by its period.
#include <zlg/core/compensation/lock_in.hpp>

#include <rapidcheck/gtest.h>

#include "compensation_support.hpp"

namespace zlg::core::lock_in_test {

using namespace compensation_test;

constexpr double tick_s = 0.005;

CompensationConstants gyro_of(double bias_hz, double edge_s = 0.0) {
    const double plateau_ratio = 1.0 / (1.0 - edge_s / tick_s);
    return {.tick = Seconds{tick_s}, .bias = Hertz{bias_hz / plateau_ratio}, .plateau_ratio = plateau_ratio};
}

LockInConfig known(double threshold_hz, double sigma_hz = 0.0) {
    return {.threshold = Hertz{threshold_hz}, .sigma = Hertz{sigma_hz}};
}

// psi' = 2 pi (f - L sin psi): one turn lasts the integral of 1/(f - L sin 2 pi u), by the sum over evenly spaced
// places, which converges faster than any power.
double mean_beat_hz(double f, double threshold_hz) {
    constexpr int n = 4096;
    if (std::abs(f) <= threshold_hz) return 0.0;
    double period_s = 0.0;
    for (int k = 0; k < n; ++k) period_s += 1.0 / (f - threshold_hz * std::sin(2.0 * std::numbers::pi * k / n)) / n;
    return 1.0 / period_s;
}

TEST(LostToLockIn, WithoutEdgesTheRotationComesBackFromRestToBeyondTheBias) {
    constexpr double bias_hz = 60e3, threshold_hz = 300.0;
    for (double rate_hz = -200e3; rate_hz < 200e3; rate_hz += 1234.5) {
        for (const int sign : {1, -1}) {
            const double first = 0.5 * tick_s * mean_beat_hz(rate_hz + sign * bias_hz, threshold_hz);
            const double second = 0.5 * tick_s * mean_beat_hz(rate_hz - sign * bias_hz, threshold_hz);
            if (std::min(std::abs(first), std::abs(second)) < 1.0) continue;  // may stand
            // Nothing of the bias needs to be known.
            for (const double wrong : {1.0, 0.5, 0.9, 1.2}) {
                const CompensationConstants gyro = gyro_of(wrong * bias_hz);
                const double lost = lost_to_lock_in(gyro, known(threshold_hz), first, second).value;
                ASSERT_NEAR(first + second + lost, rate_hz * tick_s, 1e-9) << rate_hz;
            }
        }
    }
}

// Whole halves with linear edges: each border is passed at the rate of the rotation. Over the reversals L^2/2f has the
// principal value (L^2 t_e/4 f0) ln|f_+/f_-| each.
TEST(LostToLockIn, WithEdgesTheScaleErrorIsThatOfTheFormula) {
    constexpr double edge_s = 50e-6, bias_hz = 60e3, threshold_hz = 300.0;
    for (const double x : {1e-3, 0.1, 0.5, 0.9, 0.96, -0.96, 1.04, 1.5, 2.0}) {
        const double r = x * bias_hz;
        const auto half = [&](double f) {
            const double plateau = mean_beat_hz(f, threshold_hz) * (0.5 * tick_s - edge_s);
            return plateau + edge_s * 0.5 * (f + r);
        };
        const double edges =
            threshold_hz * threshold_hz * edge_s / (2.0 * bias_hz) * std::log(std::abs((1 + x) / (1 - x)));
        const double first = half(r + bias_hz) - 0.5 * edges;
        const double second = half(r - bias_hz) - 0.5 * edges;
        const double missing = r * tick_s - (first + second);
        const double lost = lost_to_lock_in(gyro_of(bias_hz, edge_s), known(threshold_hz), first, second).value;
        EXPECT_NEAR(lost / missing, 1.0, std::abs(x) > 1.0 ? 0.02 : 3e-3) << x;
        const double ratio = threshold_hz / bias_hz;
        const double formula = -0.5 * ratio * ratio * r * tick_s * (1.0 - 4.0 * edge_s / tick_s) / (1.0 - x * x);
        if (std::abs(x) < 1.0) EXPECT_NEAR(lost / formula, 1.0, 0.03) << x;
    }
}

TEST(LostToLockIn, OfAnUnknownThresholdTheLikelyLossIsTheVariance) {
    const CompensationConstants gyro = gyro_of(60e3);
    EXPECT_EQ(lost_to_lock_in(gyro, {}, 294.0, -6.0).variance, 0.0);
    EXPECT_EQ(lost_to_lock_in(gyro, known(0.0, 300.0), 150.0, -150.0).variance, 0.0);
    for (const double x : {-0.96, 0.1, 0.5, 0.9, 0.96, 1.04, 2.0}) {
        const double first = 150.0 * (x + 1.0), second = 150.0 * (x - 1.0);
        const double likely = lost_to_lock_in(gyro, known(300.0), first, second).value;
        const LostCounts unknown = lost_to_lock_in(gyro, known(0.0, 300.0), first, second);
        EXPECT_EQ(unknown.value, 0.0);
        EXPECT_NEAR(std::sqrt(unknown.variance) / std::abs(likely), 1.0, 0.02) << x;
    }
    // One half stands still, and lacks up to its threshold.
    EXPECT_NEAR(std::sqrt(lost_to_lock_in(gyro, known(0.0, 300.0), 300.0, 0.0).variance), 0.5 * 300.0 * 0.5 * tick_s,
                1e-3);
}

TEST(LostToLockIn, AThresholdThatIsOffByItsSigmaLeavesOneSigma) {
    const LostCounts presumed = lost_to_lock_in(gyro_of(60e3), known(250.0, 50.0), 297.0, -9.0);
    const LostCounts true_one = lost_to_lock_in(gyro_of(60e3), known(300.0), 297.0, -9.0);
    EXPECT_NEAR(std::abs(true_one.value - presumed.value) / std::sqrt(presumed.variance), 1.0, 1e-9);
}

// |f| <= L: the beat stands, and the rotation is wherever |f| allows. A reading of 0 has no sign to give anything back
// to.
TEST(LostToLockIn, AHalfThatStandsHoldsItsThreshold) {
    for (double f = -290.0; f <= 290.0; f += 29.0) {
        const double r = 60e3 + f;
        const double first = 0.5 * tick_s * mean_beat_hz(r + 60e3, 300.0);
        for (const double reading : {-1.0, 0.0, 1.0}) {
            const LostCounts lost = lost_to_lock_in(gyro_of(60e3), known(300.0), first, reading);
            const double error = first + lost.value - r * tick_s;
            EXPECT_LT(std::abs(error), (reading == 0.0 ? 1.0 : 2.7) * std::sqrt(lost.variance)) << f;
        }
    }
}

RC_GTEST_PROP(LostToLockIn, TurnsItsSignWithTheRotationAndKnowsNoOrderOfTheHalves, ()) {
    const double a = 1e-2 * *rc::gen::inRange(-100'000, 100'000), b = 1e-2 * *rc::gen::inRange(-100'000, 100'000);
    const LockInConfig config = known(*rc::gen::inRange(0, 2000), *rc::gen::inRange(0, 2000));
    const CompensationConstants gyro = gyro_of(60e3, 50e-6);
    const LostCounts one = lost_to_lock_in(gyro, config, a, b);
    const LostCounts swapped = lost_to_lock_in(gyro, config, b, a);
    const LostCounts mirrored = lost_to_lock_in(gyro, config, -a, -b);
    RC_ASSERT(std::abs(one.value - swapped.value) < 1e-12 * (1.0 + std::abs(one.value)));
    if (a != 0.0 && b != 0.0) RC_ASSERT(std::abs(one.value + mirrored.value) < 1e-12 * (1.0 + std::abs(one.value)));
    RC_ASSERT(one.variance >= 0.0);
}

// What overflows is not known to be nothing.
TEST(LostToLockIn, EveryInputGivesNumbersOrAnInfiniteVariance) {
    const CompensationConstants tiny{.bias = Hertz{1e-300}};
    for (const double counts : {0.0, 1.0, 0x1p53, -0x1p53, infinite, not_a_number}) {
        for (const CompensationConstants& gyro : {gyro_of(60e3), tiny}) {
            for (const LockInConfig& config : {known(0.0, 0.0), known(1e9, 1e9), known(1e-300, 1e-300)}) {
                for (const LostCounts& lost :
                     {lost_to_lock_in(gyro, config, counts, -counts), lost_to_lock_in(gyro, config, counts, counts)}) {
                    EXPECT_TRUE(std::isfinite(lost.value));
                    EXPECT_GE(lost.variance, 0.0);
                    const bool is_possible = std::isfinite(counts) && gyro.bias.value() > 1.0;
                    if (is_possible) EXPECT_TRUE(std::isfinite(lost.variance));
                    if (config.threshold.value() > 0.0 && !std::isfinite(counts)) EXPECT_EQ(lost.variance, infinite);
                }
                const double unknown = lost_to_lock_in(gyro, known(0.0, config.sigma.value()), counts, 1.0).variance;
                if (std::isnan(counts)) EXPECT_EQ(unknown, config.sigma.value() > 0.0 ? infinite : 0.0);
                EXPECT_EQ(lost_to_lock_in(gyro, known(0.0), counts, 1.0).variance, 0.0);
            }
        }
    }
}

TEST(LostToLockIn, AThresholdThatIsNoneIsRefused) {
    EXPECT_TRUE(is_allowed(LockInConfig{}));
    EXPECT_TRUE(is_allowed(known(1e9, 1e9)));
    for (const double bad : {-1.0, 1.1e9, infinite, not_a_number}) {
        EXPECT_FALSE(is_allowed(known(bad)));
        EXPECT_FALSE(is_allowed(known(1.0, bad)));
    }
}

}  // namespace zlg::core::lock_in_test
