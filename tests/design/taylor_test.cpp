#include <zlg/design/taylor.hpp>

#include <zlg/design/error.hpp>

#include "substitution_support.hpp"

namespace zlg::design::taylor_test {

using std::numbers::pi;

constexpr Tone tone{12000.0, 20.0};

TEST(Taylor, TheSeriesFollowTheSineWithinTheirFirstNeglectedTerm) {
    for (const double x : {-0.006, -0.001, 0.0005, 0.002, 0.008}) {
        const double u = 2.0 * pi * tone.frequency_hz * x;
        EXPECT_LE(std::abs(series_at_zero(tone, x).sum() - 12000.0 * std::sin(u)),
                  12000.0 * std::pow(std::abs(u), 7) / 5040.0 + 1e-10);
        EXPECT_LE(std::abs(series_at_extremum(tone, x).sum() - 12000.0 * std::cos(u)),
                  12000.0 * std::pow(u, 6) / 720.0 + 1e-10);
    }
}

TEST(Taylor, ThePrintLacksAThirdOfTheCubicTerm) {
    const double x = 0.003;
    const double cubic = 12000.0 * std::pow(pi * 20.0 * x, 3);
    EXPECT_NEAR(series_at_zero_as_printed(tone, x).power[3], -cubic, 1e-10);
    EXPECT_NEAR(series_at_zero(tone, x).power[3], -4.0 / 3.0 * cubic, 1e-10);
    EXPECT_GT(std::abs(series_at_zero_as_printed(tone, x).sum() - 12000.0 * std::sin(2.0 * pi * 20.0 * x)),
              0.3 * cubic);
}

TEST(Taylor, AboveAnOrderLieTheTermsThatItCannotFollow) {
    const auto at_zero = series_at_zero(tone, 0.002);
    EXPECT_DOUBLE_EQ(at_zero.above(1), at_zero.power[3] + at_zero.power[5]);
    EXPECT_DOUBLE_EQ(at_zero.above(2), at_zero.above(1));
    const auto extremum = series_at_extremum(tone, 0.002);
    EXPECT_DOUBLE_EQ(extremum.above(1), extremum.power[2] + extremum.power[4]);
    EXPECT_DOUBLE_EQ(extremum.above(2), extremum.power[4]);
    EXPECT_EQ(extremum.above(5), 0.0);
}

// The captions name 0.1, 0.15 and 0.2 of a period for one, two and three ticks at nu T = 0.1.
TEST(Taylor, TheTimeOfTheFiguresIsHalfAGapAndATick) {
    const double part[] = {0.1, 0.15, 0.2};
    for (int n = 1; n <= 3; ++n) EXPECT_NEAR(figure_time_s(n, 0.005) * tone.frequency_hz, part[n - 1], 1e-15);
}

TEST(Taylor, HighestFrequenciesForTenArcseconds) {
    EXPECT_NEAR(highest_frequency_hz({Fit::interpolation, 0, 3}, 12000.0, 10.0), 4.4, 0.05);
    EXPECT_NEAR(highest_frequency_hz({Fit::interpolation, 1, 3}, 12000.0, 10.0), 4.4, 0.05);
    EXPECT_NEAR(highest_frequency_hz({Fit::interpolation, 2, 3}, 12000.0, 10.0), 15.3, 0.05);
}

TEST(Taylor, TheHighestFrequencyIsWhereTheErrorOfTheTicksMeetsTheLimit) {
    for (const int n : {1, 3, 7}) {
        for (int order = 0; order < 3; ++order) {
            const Substitution s{Fit::interpolation, order, n};
            const double f = highest_frequency_hz(s, 12000.0, 10.0);
            EXPECT_NEAR(std::abs(substitution_test::simulated_error(s, 1, n, 12000.0, f, 0.5 * pi)), 10.0, 1e-8);
            for (double below = 0.01 * f; below < f; below += 0.01 * f) {
                ASSERT_LE(std::abs(substitution_test::simulated_error(s, 1, n, 12000.0, below, 0.5 * pi)), 10.0 + 1e-8);
            }
        }
    }
}

TEST(Taylor, AMotionThatNeverReachesTheLimitHasTheWholeBand) {
    EXPECT_EQ(highest_frequency_hz({}, 1.0, 10.0), 100.0);
    EXPECT_NEAR(highest_frequency_hz({}, 12000.0, 0.0), 0.0, 1e-9);
}

TEST(Taylor, RefusesWhatIsOutOfRange) {
    EXPECT_THROW((void)series_at_zero(tone, std::nan("")), DesignError);
    EXPECT_THROW((void)series_at_zero(tone, 1.0).above(6), DesignError);
    EXPECT_THROW((void)highest_frequency_hz({}, 1.0, -1.0), DesignError);
    EXPECT_THROW((void)figure_time_s(0, 0.005), DesignError);
}

}  // namespace zlg::design::taylor_test
