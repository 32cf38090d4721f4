#include <zlg/core/compensation/relock_drift.hpp>
#include <zlg/core/control/sync_detector.hpp>

#include "common/expansive_curve.hpp"

#include "support.hpp"

namespace zlg::core::discriminator_curve_test {

static_assert(check(DiscriminatorCurve{}) == CurveFault::none);

using test::expansive;
using test::expansive_curve;

double worst_error(const DiscriminatorCurve& c) {
    double worst = 0.0;
    for (double dl = 0.0; dl < 0.24; dl += 1e-4) {
        worst = std::max(worst, std::abs(true_detuning(c, expansive(dl)).detuning_lambda - dl));
    }
    return worst;
}

TEST(DiscriminatorCurve, WithoutNodesIsTheLinearLawToTheLastBit) {
    for (const double x : {0.0, 1e-300, -0.123456789, 17.0}) {
        EXPECT_EQ(true_detuning({}, x).detuning_lambda, x);
        EXPECT_EQ(true_detuning({}, x).slope, 1.0);
    }
    const TrueMoments m = true_moments({}, 0.1, 0.02, 1e-5);
    EXPECT_EQ(m.mean_lambda, 0.1);
    EXPECT_EQ(m.mean_sq_lambda2, 0.02);
}

// Also below the noise, where the spread of a half comes out negative: else the mean of many halves is too large.
TEST(DiscriminatorCurve, AStraightCurveLeavesTheMomentsAsTheyAre) {
    const std::array<double, 2> x = {0.2, 0.5};
    const DiscriminatorCurve straight = discriminator_curve(x, x);
    for (const double mean_sq : {0.010009, 0.01001, 0.0102}) {
        const TrueMoments m = true_moments(straight, 0.1, mean_sq, 1e-5);
        EXPECT_NEAR(m.mean_lambda, 0.1, 1e-15);
        EXPECT_NEAR(m.mean_sq_lambda2, mean_sq, 1e-15);
    }
}

TEST(DiscriminatorCurve, PassesThroughItsNodesAndIsOdd) {
    const DiscriminatorCurve c = expansive_curve(12);
    ASSERT_EQ(check(c), CurveFault::none);
    for (int k = 1; k < 12; ++k) {
        const double dl = 0.24 * k / 12;
        EXPECT_NEAR(true_detuning(c, expansive(dl)).detuning_lambda, dl, 1e-15);
        EXPECT_EQ(true_detuning(c, -expansive(dl)).detuning_lambda, -true_detuning(c, expansive(dl)).detuning_lambda);
    }
}

TEST(DiscriminatorCurve, ThirtyOneNodesAreGoodToFiveHundredThousandthsOfAWavelength) {
    EXPECT_LT(worst_error(expansive_curve(31)), 5e-5);
    EXPECT_GT(worst_error(expansive_curve(7)), 2e-4);
    // Half the distance leaves an eighth of the error.
    const double ratio = worst_error(expansive_curve(15)) / worst_error(expansive_curve(30));
    EXPECT_GT(ratio, 6.0);
    EXPECT_LT(ratio, 20.0);
}

TEST(DiscriminatorCurve, IsMonotoneWhateverGrowsInItsNodes) {
    const std::array<double, 5> x = {0.1, 0.11, 0.5, 0.50001, 3.0};
    const std::array<double, 5> y = {1e-6, 0.9, 0.90001, 2.0, 2.00001};
    const DiscriminatorCurve c = discriminator_curve(x, y);
    ASSERT_EQ(check(c), CurveFault::none);
    double last = 0.0;
    for (double at = 0.0; at < 3.1; at += 1e-4) {
        const CurvePoint p = true_detuning(c, at);
        EXPECT_GE(p.detuning_lambda, last);
        EXPECT_GE(p.slope, 0.0);
        last = p.detuning_lambda;
    }
}

TEST(DiscriminatorCurve, TheSlopeIsTheDerivative) {
    const DiscriminatorCurve c = expansive_curve(20);
    for (const double x : {-0.2, -0.05, 0.013, 0.1, 0.31}) {
        const double h = 1e-7;
        const double rise = true_detuning(c, x + h).detuning_lambda - true_detuning(c, x - h).detuning_lambda;
        EXPECT_NEAR(true_detuning(c, x).slope, rise / (2.0 * h), 1e-6);
    }
}

TEST(DiscriminatorCurve, BeyondItsLastNodeItHolds) {
    const DiscriminatorCurve c = expansive_curve(20);
    EXPECT_EQ(true_detuning(c, 50.0).detuning_lambda, 0.24);
    EXPECT_EQ(true_detuning(c, -50.0).detuning_lambda, -0.24);
    EXPECT_TRUE(std::isnan(true_detuning(c, not_a_number).detuning_lambda));
}

// Unlike sides: to the left the curve of above, to the right one that is steeper.
double right_apparent(double dl) { return dl * (1.1 + 25.0 * dl * dl); }

TEST(DiscriminatorCurve, EachSideMayHaveItsOwnNodes) {
    const DiscriminatorCurve c = expansive_curve(31, right_apparent, true);
    ASSERT_EQ(check(c), CurveFault::none);
    EXPECT_EQ(nodes_below(c), 31u);
    EXPECT_EQ(true_detuning(c, 0.0).detuning_lambda, 0.0);
    for (double dl = 1e-3; dl < 0.24; dl += 1e-3) {
        EXPECT_NEAR(true_detuning(c, expansive(-dl)).detuning_lambda, -dl, 3e-4);
        EXPECT_NEAR(true_detuning(c, right_apparent(dl)).detuning_lambda, dl, 3e-4);
    }
    EXPECT_EQ(true_detuning(c, -50.0).detuning_lambda, -0.24);
    EXPECT_EQ(true_detuning(c, -50.0).slope, 0.0);
    EXPECT_EQ(true_detuning(c, 50.0).detuning_lambda, 0.24);
}

TEST(DiscriminatorCurve, TwoEqualSidesAreTheMirroredOne) {
    const DiscriminatorCurve both = expansive_curve(31, expansive, true);
    const DiscriminatorCurve one = expansive_curve(31);
    for (double at = -3.0; at < 3.0; at += 0.0173)
        EXPECT_NEAR(true_detuning(both, at).detuning_lambda, true_detuning(one, at).detuning_lambda, 1e-5) << at;
}

// A half in which the detuning goes evenly from one value to another.
SyncDetectorOutput detected(const SyncDetectorConfig& c, double from, double to, int sign,
                            double (*right)(double) = expansive) {
    std::array<float, 16> a{};
    std::array<float, 16> b{};
    for (std::size_t k = 0; k < 16; ++k) {
        const double dl = from + (to - from) * (static_cast<double>(k) + 0.5) / 16.0;
        const double signal = sign * 0.332 * (dl < 0.0 ? expansive(dl) : right(dl));
        a[k] = static_cast<float>(1000.0 * (1.0 + signal));
        b[k] = static_cast<float>(1000.0 * (1.0 - signal));
    }
    SyncDetectorState s;
    return step(c, s, {.light_a = a, .light_b = b, .sign = sign});
}

// The light turns with the sign of the half before it goes through a curve that is not odd.
TEST(DiscriminatorCurve, TheSignOfAHalfTurnsTheSignalAndNotTheDetuning) {
    SyncDetectorConfig config;
    config.curve = expansive_curve(31, right_apparent, true);
    for (const double dl : {-0.2, -0.05, 0.1}) {
        for (const int sign : {1, -1}) {
            const SyncDetectorOutput out = detected(config, dl, dl, sign, right_apparent);
            ASSERT_TRUE(out.usable);
            EXPECT_NEAR(out.detuning.value(), dl, 4e-4) << sign;
        }
    }
}

constexpr RelockDriftConfig by_mean_square{.method = RelockMethod::mean_square};

RelockDriftOutput after_gap(const CompensationConstants& gyro, const HalfRecord& first, const HalfRecord& second) {
    RelockDriftState state;
    enter_gap(state);
    return step(gyro, by_mean_square, state, {first, second});
}

// A bias that is largest at c: what a half lacks is chi <(dl - c)^2>.
TEST(DiscriminatorCurve, TheCorrectionIsThatOfTheSquareFromTheLargestBias) {
    const CompensationConstants gyro{.bias = Hertz{60e3}, .chi = 3.6, .centre = Wavelengths{0.02}};
    const double first = 0.15, second = 0.06;
    for (const double side : {1.0, -1.0}) {
        const HalfRecord one{.detuning_lambda = side * first, .detuning_sq_lambda2 = first * first};
        const HalfRecord other{.detuning_lambda = side * second, .detuning_sq_lambda2 = second * second};
        const RelockDriftOutput out = after_gap(gyro, one, other);
        const double before = (side * first - 0.02) * (side * first - 0.02);
        const double after = (side * second - 0.02) * (side * second - 0.02);
        ASSERT_TRUE(out.tick.known);
        EXPECT_NEAR(out.tick.value_arcsec, 3.263 * 0.005 * 0.5 * 3.6 * 60e3 * (after - before), 1e-9);
    }
}

TEST(DiscriminatorCurve, RefusesNodesThatDoNotGrowAndSidesThatAreNone) {
    const auto fault = [](std::vector<double> x, std::vector<double> y) { return check(discriminator_curve(x, y)); };
    EXPECT_EQ(fault({}, {}), CurveFault::none);
    EXPECT_EQ(fault({0.1}, {0.1}), CurveFault::none);
    EXPECT_EQ(fault({0.1, 0.1}, {0.1, 0.2}), CurveFault::node);
    EXPECT_EQ(fault({0.1, 0.2}, {0.1, 0.05}), CurveFault::node);
    EXPECT_EQ(fault({-0.1, 0.2}, {0.1, 0.2}), CurveFault::node);
    EXPECT_EQ(fault({0.1, not_a_number}, {0.1, 0.2}), CurveFault::node);
    EXPECT_EQ(fault({0.1, 2000.0}, {0.1, 0.2}), CurveFault::node);
    EXPECT_EQ(fault({0.1}, {0.1, 0.2}), CurveFault::size);
    EXPECT_EQ(fault(std::vector<double>(32, 0.1), std::vector<double>(32, 0.1)), CurveFault::size);
    EXPECT_EQ(fault({-0.2, -0.1}, {-0.2, -0.1}), CurveFault::size) << "the positive side is missing";
    EXPECT_EQ(fault({-0.1, 0.1}, {0.1, 0.2}), CurveFault::node);
    EXPECT_EQ(fault({-0.1, 0.1, 0.05}, {-0.1, 0.1, 0.2}), CurveFault::node);
    EXPECT_EQ(fault({-0.1, 0.1}, {-0.1, 0.1}), CurveFault::none);
    DiscriminatorCurve steep = expansive_curve(4);
    steep.slope[2] = 10.0;
    EXPECT_EQ(check(steep), CurveFault::slope);
}

TEST(DiscriminatorCurve, TheDetectorReadsTrueDetuningsThroughIt) {
    SyncDetectorConfig with;
    with.curve = expansive_curve(31);
    ASSERT_TRUE(is_allowed(with));
    for (const int sign : {1, -1}) {
        const SyncDetectorOutput linear = detected({}, -0.2, -0.2, sign);
        EXPECT_NEAR(linear.detuning.value(), -expansive(0.2), 1e-5);
        const SyncDetectorOutput read = detected(with, -0.2, -0.1, sign);
        EXPECT_NEAR(read.detuning.value(), -0.15, 2e-5);
        EXPECT_NEAR(read.mean_sq_lambda2, 0.15 * 0.15 + 0.01 / 12.0, 2e-5);
    }
}

// Halves in which the detuning falls evenly; the truth is (chi f0/2) (<dl^2>_second - <dl^2>_first).
double relock_ratio(const SyncDetectorConfig& detector, const CompensationConstants& gyro, double miss) {
    const double middle = 0.6 * miss;
    const double end = 0.3 * miss;
    const SyncDetectorOutput first = detected(detector, miss, middle, 1);
    const SyncDetectorOutput second = detected(detector, middle, end, -1);
    const auto read = [](const SyncDetectorOutput& half) {
        return HalfRecord{.detuning_lambda = half.detuning.value(),
                          .detuning_sq_lambda2 = half.mean_sq_lambda2,
                          .temperature_c = 20.0};
    };
    const auto mean_sq = [](double a, double b) { return (a * a + a * b + b * b) / 3.0; };
    const double rate_hz = 0.5 * 3.6 * 60e3 * (mean_sq(middle, end) - mean_sq(miss, middle));
    return after_gap(gyro, read(first), read(second)).tick.value_arcsec / (3.263 * 0.005 * rate_hz);
}

TEST(DiscriminatorCurve, CuresTheRelockCorrectionInTheDetectorOrInTheLog) {
    const CompensationConstants plain{.light_noise = Wavelengths{0.0}};
    CompensationConstants late = plain;
    late.record_curve = expansive_curve(31);
    ASSERT_EQ(check(late), GyroCompensationFault::none);
    SyncDetectorConfig with;
    with.curve = expansive_curve(31);
    for (const double miss : {0.05, 0.1, 0.2}) {
        EXPECT_NEAR(relock_ratio(with, plain, miss), 1.0, 2e-3) << miss;
        EXPECT_NEAR(relock_ratio({}, late, miss), 1.0, 0.03) << miss;
        EXPECT_GT(relock_ratio({}, plain, miss), 1.0 + 15.0 * miss * miss) << miss;
    }
}

TEST(DiscriminatorCurve, LightNoiseGrowsByTheSlope) {
    CompensationConstants c{.light_noise = Wavelengths{0.003}};
    const HalfRecord first{.detuning_lambda = 0.1, .detuning_sq_lambda2 = 0.1 * 0.1 + 9e-6};
    const HalfRecord second{.detuning_lambda = 0.06, .detuning_sq_lambda2 = 0.06 * 0.06 + 9e-6};
    const auto variance = [&] { return after_gap(c, first, second).tick.variance_arcsec2; };
    const double linear = variance();
    const std::array<double, 1> x = {1.0};
    const std::array<double, 1> half = {0.5};
    c.record_curve = discriminator_curve(x, half);  // a straight line of slope 1/2: dl and noise half as large
    EXPECT_NEAR(variance() / linear, 1.0 / 16.0, 1e-9);
}

}  // namespace zlg::core::discriminator_curve_test
