#include <zlg/core/common/maths.hpp>

#include <zlg/design/error.hpp>
#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>

#include "paper_case.hpp"
#include "test.hpp"

namespace zlg::design::interval_formula_test {

using core::infinity;
constexpr std::array run_lengths_s{600.0, 900.0, 3600.0, 36000.0};

TEST(IntervalFormula, TheClosedFormOfThePapersGyro) {
    constexpr std::array expected_s{92.6, 113.4, 226.8};
    for (std::size_t i = 0; i < expected_s.size(); ++i) {
        EXPECT_NEAR(closed_form_interval_s(paper(0.7, run_lengths_s[i])), expected_s[i], 0.05);
    }
    EXPECT_NEAR(closed_form_interval_s(paper(0.7, 36000.0)), 717.0, 0.5);
    // sqrt(10 * 600/0.6) exactly, and the same for the drift of the other sign.
    DriftCase round = paper(0.0, 600.0);
    round.gyro.magnetic_arcsec_s = -0.6;
    EXPECT_DOUBLE_EQ(closed_form_interval_s(round), 100.0);
}

TEST(IntervalFormula, PrintedEquation9OfThePapersGyro) {
    constexpr std::array expected_s{92.7, 113.7, 232.2};
    for (std::size_t i = 0; i < expected_s.size(); ++i) {
        const Roots roots = roots_as_printed(paper(0.7, run_lengths_s[i]));
        EXPECT_EQ(roots.status, RootStatus::found);
        EXPECT_NEAR(roots.smaller_s, expected_s[i], 0.05);
    }
    const Roots none = roots_as_printed(paper(0.7, 36000.0));
    EXPECT_EQ(none.status, RootStatus::none);
    EXPECT_TRUE(std::isnan(none.smaller_s) && std::isnan(none.larger_s));
}

TEST(IntervalFormula, CorrectedEquation9OfThePapersGyro) {
    constexpr std::array expected_s{88.5, 106.2, 183.5, 297.5};
    for (std::size_t i = 0; i < expected_s.size(); ++i) {
        const Roots roots = corrected_roots(paper(0.7, run_lengths_s[i]));
        EXPECT_EQ(roots.status, RootStatus::found);
        EXPECT_NEAR(roots.smaller_s, expected_s[i], 0.05);
        EXPECT_GT(roots.larger_s, roots.smaller_s);
    }
}

TEST(IntervalFormula, PrintedEquation9HasARootJustUpToItsLongestRun) {
    EXPECT_NEAR(longest_run_as_printed_s(paper(14.0, 600.0).gyro, 10.0), 2033.0, 0.5);
    EXPECT_NEAR(longest_run_as_printed_s(paper(0.7, 600.0).gyro, 10.0), 14978.0, 0.5);
    EXPECT_EQ(longest_run_as_printed_s(paper(0.0, 600.0).gyro, 10.0), infinity);
    for (const double thermal_arcsec_s : {0.7, -14.0}) {
        const double longest_s = longest_run_as_printed_s(paper(thermal_arcsec_s, 600.0).gyro, 10.0);
        EXPECT_EQ(roots_as_printed(paper(thermal_arcsec_s, longest_s * (1.0 - 1e-9))).status, RootStatus::found);
        EXPECT_EQ(roots_as_printed(paper(thermal_arcsec_s, longest_s * (1.0 + 1e-9))).status, RootStatus::none);
    }
}

TEST(IntervalFormula, ForALongRunCorrectedEquation9NeedsAThermalChangeOf54SwitchErrors) {
    DriftCase c = paper(0.0, 1e12);
    c.gyro.magnetic_arcsec_s = 0.0;  // then the run drops out of the equation
    c.gyro.magnetic_thermal_arcsec_s = 54.0 * 10.0 / 3000.0 * (1.0 + 1e-9);
    EXPECT_EQ(corrected_roots(c).status, RootStatus::found);
    c.gyro.magnetic_thermal_arcsec_s = 54.0 * 10.0 / 3000.0 * (1.0 - 1e-9);
    EXPECT_EQ(corrected_roots(c).status, RootStatus::none);
}

TEST(IntervalFormula, TheRootsSatisfyTheirEquations) {
    std::mt19937_64 random{1};
    const auto decades = [&](double low, double high) {
        return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
    };
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
        const double om0 = decades(-2.0, 2.0), a = decades(-2.0, 2.0), tau = decades(2.0, 5.0), dp = decades(-1.0, 2.0),
                     t = decades(2.0, 6.0);
        const DriftCase c{{0.05, om0, a, tau}, dp, t};
        const Roots corrected = corrected_roots(c);
        const Roots printed = roots_as_printed(c);
        const double right = 2.0 * tau * tau * t * dp;
        if (corrected.status != RootStatus::none) {
            ++found;
            for (const double x : {corrected.smaller_s, corrected.larger_s}) {
                const double rising = (2.0 * tau * tau * om0 + a * tau * t) * x * x;
                EXPECT_NEAR((rising - 2.0 * a * t * x * x * x) / right, 1.0, 1e-11 * (1.0 + rising / right));
            }
        }
        if (printed.status != RootStatus::none) {
            ++found;
            for (const double x : {printed.smaller_s, printed.larger_s}) {
                const double rising = 2.0 * tau * tau * om0 * x * x;
                EXPECT_NEAR((rising - a * t * x * x * x) / right, 1.0, 1e-11 * (1.0 + rising / right));
            }
        }
        EXPECT_EQ(corrected.status == RootStatus::found, corrected.smaller_s <= t);
        EXPECT_EQ(printed.status == RootStatus::none, t > longest_run_as_printed_s(c.gyro, dp));
    }
    EXPECT_GT(found, 1000);
}

TEST(IntervalFormula, WithoutThermalChangeBothEquationsAreTheClosedForm) {
    const DriftCase cold = paper(0.0, 3600.0);
    for (const Roots& roots : {corrected_roots(cold), roots_as_printed(cold)}) {
        EXPECT_EQ(roots.status, RootStatus::found);
        EXPECT_NEAR(roots.smaller_s, std::sqrt(10.0 * 3600.0 / 0.7), 1e-10);
        EXPECT_EQ(roots.larger_s, infinity);
    }
    // A thermal change lost in rounding makes no difference.
    EXPECT_NEAR(corrected_roots(paper(1e-300, 3600.0)).smaller_s, std::sqrt(10.0 * 3600.0 / 0.7), 1e-10);
    // No drift, no root.
    DriftCase still = cold;
    still.gyro.magnetic_arcsec_s = 0.0;
    EXPECT_EQ(corrected_roots(still).status, RootStatus::none);
    EXPECT_EQ(roots_as_printed(still).status, RootStatus::none);
}

TEST(IntervalFormula, ARootLongerThanTheRunIsSaidToBe) {
    const Roots roots = corrected_roots(paper(0.7, 10.0));  // sqrt(10 * 10/0.7) = 12 s
    EXPECT_EQ(roots.status, RootStatus::beyond_run);
    EXPECT_NEAR(roots.smaller_s, 12.0, 0.1);
    EXPECT_EQ(roots_as_printed(paper(0.0, 10.0)).status, RootStatus::beyond_run);
}

TEST(IntervalFormula, TheRandomSignIntervalIsTheMinimumOfTheRmsBudget) {
    DriftCase c = paper(0.7, 3600.0);
    c.gyro.magnetic_thermal_arcsec_s = 0.0;
    const double best_s = random_sign_interval_s(c);
    EXPECT_NEAR(best_s, std::cbrt(100.0 * 3600.0 / 0.98), 1e-10);
    EXPECT_LT(random_sign_drift_arcsec_s(c, best_s), random_sign_drift_arcsec_s(c, 1.001 * best_s));
    EXPECT_LT(random_sign_drift_arcsec_s(c, best_s), random_sign_drift_arcsec_s(c, 0.999 * best_s));
}

TEST(IntervalFormula, TheRandomSignIntervalKnowsTheWarming) {
    const DriftCase c = paper(0.7, 3600.0);
    const double om_arcsec_s = 0.5 * (0.7 + magnetic_rate_arcsec_s(c.gyro, 3600.0));
    EXPECT_NEAR(random_sign_interval_s(c), std::cbrt(100.0 * 3600.0 / (2.0 * om_arcsec_s * om_arcsec_s)), 1e-10);
    const double end_arcsec_s = 0.5 * magnetic_rate_arcsec_s(c.gyro, 3600.0);
    EXPECT_NEAR(random_sign_interval_s(c, FirstSegment::half),
                std::cbrt(100.0 * 3600.0 / (2.0 * end_arcsec_s * end_arcsec_s)), 1e-10);
}

// A greatest switch error of 10 arcsec is three standard deviations of independent ones.
TEST(IntervalFormula, ThePapersRuleCosts2_9To5_6TimesWhereSwitchErrorsAreIndependent) {
    constexpr std::array expected{2.85, 5.58};
    constexpr std::array ends_s{600.0, 36000.0};
    for (std::size_t i = 0; i < ends_s.size(); ++i) {
        DriftCase c = paper(0.7, ends_s[i]);
        c.gyro.magnetic_thermal_arcsec_s = 0.0;
        c.gyro.nonmagnetic_arcsec_s = 0.0;
        const double rule_s = closed_form_interval_s(c);
        c.switch_error_arcsec = 10.0 / 3.0;
        const double cost =
            random_sign_drift_arcsec_s(c, rule_s) / random_sign_drift_arcsec_s(c, random_sign_interval_s(c));
        EXPECT_NEAR(cost, expected[i], 0.01);
    }
}

TEST(IntervalFormula, WithoutDriftTheFormulasAreInfinite) {
    DriftCase still = paper(0.0, 3600.0);
    still.gyro.magnetic_arcsec_s = 0.0;
    EXPECT_EQ(closed_form_interval_s(still), infinity);
    EXPECT_EQ(random_sign_interval_s(still), infinity);
}

TEST(IntervalFormula, ACaseThatCannotBeIsRefused) {
    DriftCase c = paper(0.7, 3600.0);
    c.switch_error_arcsec = 0.0;
    EXPECT_THROW((void)closed_form_interval_s(c), DesignError);
    EXPECT_THROW((void)random_sign_interval_s(c), DesignError);
    EXPECT_THROW((void)corrected_roots(c), DesignError);
    EXPECT_THROW((void)roots_as_printed(c), DesignError);
    EXPECT_THROW((void)longest_run_as_printed_s(c.gyro, std::nan("")), DesignError);
    EXPECT_THROW((void)longest_run_as_printed_s({.thermal_time_s = -1.0}, 10.0), DesignError);
}

}  // namespace zlg::design::interval_formula_test
