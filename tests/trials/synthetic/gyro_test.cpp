#include "synthetic/gyro.hpp"
#include "test.hpp"

namespace zlg::trials::gyro_test {

constexpr double half_s = 0.0025;

std::vector<double> increments(const MotionLaw& law, std::size_t n, std::uint64_t seed) {
    SyntheticMotion motion{law, half_s, {seed, chance::Cause::test}};
    std::vector<double> x(n);
    for (double& v : x) v = motion.advance();
    return x;
}

// Mean of x[k] x[k + lag] over many gyros.
double covariance(const MotionLaw& law, std::size_t lag, std::size_t n, int gyros) {
    double sum = 0.0;
    for (int g = 0; g < gyros; ++g) {
        const auto x = increments(law, n + lag, static_cast<std::uint64_t>(g) + 1);
        for (std::size_t k = 0; k < n; ++k) sum += x[k] * x[k + lag];
    }
    return sum / static_cast<double>(n) / gyros;
}

TEST(AccuracyMotion, AToneObeysItsDifferenceEquationForLong) {
    MotionLaw law;
    law.tones = {{20.06, 12000.0}};
    const auto x = increments(law, 400000, 3);
    const double turn = 2.0 * std::cos(2.0 * std::numbers::pi * 20.06 * half_s);
    double square = 0.0;
    for (std::size_t k = 1; k + 1 < x.size(); ++k) {
        EXPECT_NEAR(x[k + 1] + x[k - 1], turn * x[k], 1e-8);
        square += x[k] * x[k];
    }
    // The integral of a sine over a half: A sin(w h/2)/(w/2) times a sine.
    const double w = 2.0 * std::numbers::pi * 20.06;
    const double amplitude = 12000.0 * std::sin(0.5 * w * half_s) / (0.5 * w);
    EXPECT_NEAR(square / static_cast<double>(x.size()), 0.5 * amplitude * amplitude, 1e-3 * amplitude * amplitude);
}

TEST(AccuracyMotion, AConstantRateIsAddedExactly) {
    MotionLaw law;
    law.rate_arcsec_s = 40.0;
    for (double x : increments(law, 5, 1)) EXPECT_DOUBLE_EQ(x, 0.1);
}

TEST(AccuracyMotion, ABandHasTheCovarianceOfItsSpectrum) {
    MotionLaw law;
    law.bands = {{2.0, 20.0, 1000.0}};
    // Of a rate with a flat spectrum from a to b: s^2 [sin(bt) - sin(at)]/((b - a) t), smoothed little by a half.
    const double a = 2.0 * std::numbers::pi * 2.0;
    const double b = 2.0 * std::numbers::pi * 20.0;
    const auto expected = increment_covariance(law, half_s, 9);
    for (std::size_t lag : {std::size_t{0}, std::size_t{4}, std::size_t{8}}) {
        const double t = static_cast<double>(lag) * half_s;
        const double rate = lag == 0 ? 1.0 : (std::sin(b * t) - std::sin(a * t)) / ((b - a) * t);
        const double scale = 1e6 * half_s * half_s;
        EXPECT_NEAR(expected[lag], scale * rate, 0.01 * scale) << lag;
        EXPECT_NEAR(covariance(law, lag, 4000, 40), expected[lag], 0.05 * scale) << lag;
    }
}

TEST(AccuracyMotion, BlowsHaveTheCovarianceOfCampbell) {
    MotionLaw law;
    law.shocks = {.per_s = 20.0, .rate_arcsec_s = 4000.0, .ring_hz = 12.0, .decay_s = 0.05};
    const auto expected = increment_covariance(law, half_s, 20);
    // Mean square rate: r R^2 int exp(-2t/d) sin^2(wt) dt = r R^2 (d/4) (1 - 1/(1 + (w d)^2)).
    const double wd = 2.0 * std::numbers::pi * 12.0 * 0.05;
    const double square = 20.0 * 16e6 * 0.0125 * (1.0 - 1.0 / (1.0 + wd * wd));
    EXPECT_NEAR(expected[0], square * half_s * half_s, 0.01 * expected[0]);
    for (std::size_t lag : {std::size_t{0}, std::size_t{10}})
        EXPECT_NEAR(covariance(law, lag, 20000, 20), expected[lag], 0.06 * expected[0]) << lag;
}

TEST(AccuracyLoop, StartsAtTheMissAndDies) {
    for (LoopShape shape : {LoopShape::exponential, LoopShape::slew, LoopShape::second_order, LoopShape::underdamped,
                            LoopShape::dead_time}) {
        EXPECT_DOUBLE_EQ(detuning_ratio(shape, 0.0), 1.0) << loop_name(shape);
        EXPECT_LT(std::abs(detuning_ratio(shape, 40.0)), 2e-5) << loop_name(shape);
    }
}

TEST(AccuracyLoop, MeanSquaresOfAnExponentialAreInClosedForm) {
    const auto decay = relock_decay(LoopShape::exponential, 16);
    for (std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{12}}) {
        const double from = 0.5 * static_cast<double>(k);
        const double tau = 3.5;
        const double expected = tau * (std::exp(-2.0 * from / tau) - std::exp(-2.0 * (from + 0.5) / tau));
        EXPECT_NEAR(decay[k].mean_sq, expected, 1e-9);
        EXPECT_NEAR(decay[k].samples[3], std::exp(-(from + 0.5 * 3.5 / 16.0) / tau), 1e-12);
    }
}

TEST(AccuracyGyro, CountsTheRotationAndLosesNone) {
    MotionLaw motion;
    motion.tones = {{7.03, 12000.0}};
    motion.rate_arcsec_s = 15.0;
    SyntheticGyro gyro{{}, motion, 5};
    double rotation = 0.0;
    std::int64_t counts = 0;
    for (int h = 0; h < 20000; ++h) {
        const SyntheticHalf half = gyro.advance();
        rotation += half.true_arcsec;
        counts += half.record.counts;
        EXPECT_LE(half.rounding_arcsec, 0.0);
        EXPECT_GT(half.rounding_arcsec, -3.263);
        // Whole ticks: the bias has cancelled.
        if (h % 2 == 1) EXPECT_LT(std::abs(3.263 * static_cast<double>(counts) - rotation), 3.264);
    }
}

// Whatever the loop, the false angle of a switch is (T/4) G(0+), to leading order.
TEST(AccuracyGyro, FalseAngleObeysTheLawOfAllLoops) {
    for (LoopShape shape : {LoopShape::exponential, LoopShape::slew, LoopShape::underdamped}) {
        GyroLaw law;
        law.loop = shape;
        SyntheticGyro gyro{law, {}, 9};
        gyro.advance();
        gyro.advance();
        gyro.open();
        for (int h = 0; h < 6; ++h) EXPECT_FALSE(gyro.advance().record.loop_closed);
        double false_arcsec = 0.0;
        for (int h = 0; h < 100; ++h) {
            const SyntheticHalf half = gyro.advance();
            EXPECT_TRUE(half.record.loop_closed);
            EXPECT_EQ(half.record.mode, -1);
            false_arcsec += half.false_arcsec;
        }
        const double law_arcsec = 0.005 / 4.0 * 3.6 * 60e3 * 3.263 * 0.22 * 0.22;
        EXPECT_NEAR(std::abs(false_arcsec), law_arcsec, 0.1 * law_arcsec) << loop_name(shape);
    }
}

TEST(AccuracyGyro, LightReadsTheDetuningOfTheHalf) {
    GyroLaw law;
    law.light_noise_lambda = 0.0;
    SyntheticGyro gyro{law, {}, 2};
    gyro.advance();
    gyro.advance();
    gyro.open();
    for (int h = 0; h < 6; ++h) gyro.advance();
    const SyntheticHalf half = gyro.advance();
    ASSERT_EQ(half.light.a.size(), 16u);
    const double a = half.light.a[5];
    const double b = half.light.b[5];
    const double read =
        half.record.bias_sign * half.record.mode * (a - b) / (a + b) / synthetic_discriminator_per_lambda;
    const double expected = 0.22 * (1.0 - 0.28 * 0.5 * 5.5 / 16.0);
    EXPECT_NEAR(std::abs(read), expected, 1e-5);
    EXPECT_NEAR(half.record.detuning_sq_lambda2, 0.22 * 0.22 * (1.0 - 0.28 * 0.5 + 0.28 * 0.28 / 12.0), 1e-5);
}

}  // namespace zlg::trials::gyro_test
