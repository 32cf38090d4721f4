#include <zlg/twin/motion.hpp>

#include <zlg/core/common/maths.hpp>

#include "test.hpp"

namespace zlg::twin::motion_test {

using std::numbers::pi;
using zlg::core::not_a_number;
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Motion, ARestingCaseDoesNotTurn) {
    EXPECT_EQ(Motion::rest().increment_arcsec(0.0, 1e6), 0.0);
    EXPECT_EQ(Motion::rest().duration_s(), infinity);
}

TEST(Motion, IncrementsOfASineAddUpToTheAnalyticAngle) {
    const Motion motion = Motion::sines(15.0, {{12000.0, 7.03, 30.0}});
    double sum = 0.0;
    for (int k = 0; k < 40000; ++k) sum += motion.increment_arcsec(k * 0.0025, (k + 1) * 0.0025);
    const double w = 2.0 * pi * 7.03;
    const double expected = 15.0 * 100.0 + 12000.0 / w * (std::cos(pi / 6.0) - std::cos(w * 100.0 + pi / 6.0));
    EXPECT_NEAR(sum, expected, 1e-7);
}

TEST(Motion, SeveralSinesAddAndZeroFrequencyIsAConstantRate) {
    const Motion motion = Motion::sines(0.0, {{100.0, 0.0, 90.0}, {50.0, 1.0, 0.0}});
    EXPECT_NEAR(motion.increment_arcsec(0.0, 0.5), 100.0 * 0.5 + 50.0 / (2.0 * pi) * 2.0, 1e-12);
}

TEST(Motion, AShortIncrementOfASineAfterAMonthIsStillRight) {
    // A whole number of periods, so that the phase is that of the start.
    const double month_s = 2592000.0;
    const Motion motion = Motion::sines(0.0, {{12000.0, 8.0, 0.0}});
    const double first = motion.increment_arcsec(0.0, 0.0625);
    EXPECT_NEAR(motion.increment_arcsec(month_s, month_s + 0.0625), first, 1e-4);
}

TEST(Motion, SampledMotionConservesTheAngleAtEveryRowBorder) {
    std::vector<double> rows;
    for (int k = 0; k < 500; ++k) rows.push_back(100.0 * std::sin(12.9898 * k * k));
    const Motion motion = Motion::from_increments(rows, 100.0);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double t0_s = static_cast<double>(k) / 100.0;
        const double t1_s = static_cast<double>(k + 1) / 100.0;
        ASSERT_NEAR(motion.increment_arcsec(t0_s, t1_s), rows[k], 1e-9) << "row " << k;
        const double parts =
            motion.increment_arcsec(t0_s, t0_s + 0.0025) + motion.increment_arcsec(t0_s + 0.0025, t1_s);
        ASSERT_NEAR(parts, rows[k], 1e-9) << "row " << k;
    }
    double all = 0.0;
    for (const double row : rows) all += row;
    EXPECT_NEAR(motion.increment_arcsec(0.0, 5.0), all, 1e-9);
    EXPECT_NEAR(motion.increment_arcsec(5.0, 0.0), -all, 1e-9);
}

TEST(Motion, SampledMotionIsExactOnAConstantRateFromTheFirstRowToTheLast) {
    const Motion motion = Motion::from_increments({8.0, 8.0, 8.0}, 100.0);
    for (int k = 0; k < 12; ++k) {
        EXPECT_NEAR(motion.increment_arcsec(k * 0.0025, (k + 1) * 0.0025), 2.0, 1e-12) << "quarter row " << k;
    }
}

TEST(Motion, SampledMotionIsExactOnConstantAcceleration) {
    // theta = t^2 in rows: increments 1, 3, 5, ...; inside, away from the ends.
    const Motion motion = Motion::from_increments({1.0, 3.0, 5.0, 7.0, 9.0}, 1.0);
    EXPECT_NEAR(motion.increment_arcsec(2.25, 2.75), 2.75 * 2.75 - 2.25 * 2.25, 1e-12);
}

TEST(Motion, TheRateOfSampledMotionIsContinuousAcrossRows) {
    const Motion motion = Motion::from_increments({1.0, -4.0, 7.0, 2.0, -3.0}, 1.0);
    for (const double border_s : {1.0, 2.0, 3.0, 4.0}) {
        const double before = motion.increment_arcsec(border_s - 1e-6, border_s) / 1e-6;
        const double after = motion.increment_arcsec(border_s, border_s + 1e-6) / 1e-6;
        EXPECT_NEAR(before, after, 1e-3) << "border at " << border_s;
    }
}

TEST(Motion, BeyondTheEndOfSampledMotionTheCaseRests) {
    const Motion motion = Motion::from_increments({1.0, 2.0, 4.0}, 10.0);
    EXPECT_DOUBLE_EQ(motion.duration_s(), 0.3);
    EXPECT_NEAR(motion.increment_arcsec(0.2, 5.0), 4.0, 1e-12);
    EXPECT_EQ(motion.increment_arcsec(0.4, 5.0), 0.0);
    EXPECT_EQ(motion.increment_arcsec(-2.0, -1.0), 0.0);
}

TEST(Motion, HoursOfFastRotationTakeNoDigitsFromAnIncrement) {
    // 400 deg/s in rows of 10 ms for four hours: the angle is 2e10 arcsec, of which a double keeps 4e-6.
    const Motion motion = Motion::from_increments(std::vector<double>(1440000, 14400.0), 100.0);
    EXPECT_NEAR(motion.increment_arcsec(14399.5, 14399.5 + 0.0078125), 14400.0 * 0.78125, 2e-6);
    EXPECT_NEAR(motion.increment_arcsec(14399.5, 14399.51), 14400.0, 2e-6);
}

TEST(Motion, StepsAddTheIntegralOfARateThatIsConstantFromStepToStep) {
    const auto steps = std::make_shared<std::vector<RateStep>>(std::vector<RateStep>{{1.0, 8.0}, {1.5, -4.0}});
    const Motion motion = Motion::with_steps(Motion::sines(16.0, {}), steps);
    EXPECT_EQ(motion.increment_arcsec(0.0, 1.0), 16.0);
    EXPECT_EQ(motion.increment_arcsec(0.75, 1.25), 8.0 + 2.0);
    EXPECT_EQ(motion.increment_arcsec(0.0, 3.0), 48.0 + 4.0 - 6.0);
    EXPECT_EQ(motion.increment_arcsec(3.0, 0.0), -46.0);
    steps->push_back({3.0, 0.0});
    EXPECT_EQ(motion.increment_arcsec(2.0, 4.0), 32.0 - 4.0);
}

TEST(Motion, AStepMayHaveASlope) {
    // From 1 s on t^2/2 of 8 arcsec/s^2, for 2 s; then 16 arcsec/s.
    const auto steps =
        std::make_shared<std::vector<RateStep>>(std::vector<RateStep>{{1.0, 0.0, 8.0}, {3.0, 16.0, 0.0}});
    const Motion motion = Motion::with_steps(Motion::rest(), steps);
    EXPECT_EQ(motion.increment_arcsec(0.0, 2.0), 4.0);
    EXPECT_EQ(motion.increment_arcsec(2.0, 3.0), 16.0 - 4.0);
    EXPECT_EQ(motion.increment_arcsec(0.0, 4.0), 16.0 + 16.0);
    EXPECT_EQ(motion.fastest_arcsec_s(), 16.0);
    EXPECT_EQ(Motion::with_steps(Motion::sines(-3.0, {}), steps).fastest_arcsec_s(), 19.0);
}

TEST(Motion, BeforeItsFirstStepAMotionIsItsBaseToTheLastBit) {
    const auto steps = std::make_shared<std::vector<RateStep>>(std::vector<RateStep>{{5.0, 1.0}});
    const Motion base = Motion::sines(0.1, {{12000.0, 7.03, 30.0}});
    const Motion motion = Motion::with_steps(base, steps);
    for (int k = 0; k < 1000; ++k)
        EXPECT_EQ(motion.increment_arcsec(k * 0.005, (k + 1) * 0.005),
                  base.increment_arcsec(k * 0.005, (k + 1) * 0.005));
    EXPECT_EQ(motion.duration_s(), base.duration_s());
}

TEST(Motion, NumbersThatAreNotFiniteAreRefused) {
    EXPECT_THROW((void)Motion::sines(not_a_number, {}), std::invalid_argument);
    EXPECT_THROW((void)Motion::sines(0.0, {{1.0, infinity, 0.0}}), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({1.0, not_a_number}, 100.0), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({}, 100.0), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({1.0}, 0.0), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({1.0}, not_a_number), std::invalid_argument);
}

}  // namespace zlg::twin::motion_test
