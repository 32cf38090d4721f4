#include <zlg/core/common/maths.hpp>

#include <zlg/design/drift_budget.hpp>
#include <zlg/design/error.hpp>

#include "magnetic_segments.hpp"
#include "paper_case.hpp"

namespace zlg::design::drift_budget_test {

using core::not_a_number;

double uniform(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
}

DriftCase random_case(std::mt19937_64& random) {
    return {.gyro = {.nonmagnetic_arcsec_s = uniform(random, -1.0, 1.0),
                     .magnetic_arcsec_s = uniform(random, -20.0, 20.0),
                     .magnetic_thermal_arcsec_s = uniform(random, -20.0, 20.0),
                     .thermal_time_s = std::pow(10.0, uniform(random, 2.0, 5.0))},
            .switch_error_arcsec = uniform(random, 0.1, 100.0),
            .run_s = std::pow(10.0, uniform(random, 2.0, 6.0))};
}

TEST(DriftBudget, ACaseThatCannotBeIsRefusedByEveryBudget) {
    const auto refused = [](const DriftCase& c, double interval_s) {
        EXPECT_THROW((void)corrected_terms(c, interval_s), DesignError);
        EXPECT_THROW((void)terms_as_printed(c, interval_s), DesignError);
        EXPECT_THROW((void)derivative_as_printed_arcsec_s2(c, interval_s), DesignError);
        EXPECT_THROW((void)worst_case_drift_arcsec_s(c, interval_s), DesignError);
        EXPECT_THROW((void)drift_bound_arcsec_s(c, interval_s), DesignError);
        EXPECT_THROW((void)independent_switch_drift_arcsec_s(c, interval_s), DesignError);
        EXPECT_THROW((void)random_sign_drift_arcsec_s(c, interval_s), DesignError);
    };
    const DriftCase good = paper(0.7, 600.0);
    for (const double bad : {0.0, -1.0, not_a_number, std::numeric_limits<double>::infinity()}) {
        refused(good, bad);
        DriftCase c = good;
        c.switch_error_arcsec = bad;
        refused(c, 60.0);
        c = good;
        c.run_s = bad;
        refused(c, 60.0);
        c = good;
        c.gyro.thermal_time_s = bad;
        refused(c, 60.0);
    }
    refused(good, 600.1);
    EXPECT_NO_THROW((void)worst_case_drift_arcsec_s(good, 600.0));
}

TEST(DriftBudget, TheRunMeanIsThatOfTheSumOfSegmentsOverAnEvenNumberOfThem) {
    for (const double interval_s : {6.0, 60.0, 300.0}) {
        const auto segments = segments_s(interval_s, FirstSegment::full, 600.0);
        ASSERT_EQ(segments.size() % 2, 0U);
        const GyroDrift gyro = paper(14.0, 600.0).gyro;
        EXPECT_NEAR(quasi_nonmagnetic_arcsec_s(gyro, 600.0, interval_s), -end_error_arcsec(gyro, segments) / 600.0,
                    1e-12);
    }
}

TEST(DriftBudget, ThePrintedQuasiNonmagneticDriftIsThatOfTheFirstPairOfSegments) {
    const GyroDrift gyro = paper(14.0, 600.0).gyro;
    for (const double interval_s : {10.0, 90.0, 2000.0}) {
        const double pair_arcsec = magnetic_integral_arcsec(gyro, interval_s, 2.0 * interval_s) -
                                   magnetic_integral_arcsec(gyro, 0.0, interval_s);
        EXPECT_NEAR(quasi_nonmagnetic_as_printed_arcsec_s(gyro, interval_s), pair_arcsec / (2.0 * interval_s), 1e-12);
        // A run of just that pair has the same mean.
        EXPECT_NEAR(quasi_nonmagnetic_arcsec_s(gyro, 2.0 * interval_s, interval_s), pair_arcsec / (2.0 * interval_s),
                    1e-12);
    }
}

TEST(DriftBudget, TheTermsAreThoseOfTheFormulaAndAddUp) {
    const DriftTerms terms = corrected_terms(paper(0.7, 3600.0), 120.0);
    EXPECT_DOUBLE_EQ(terms.nonmagnetic_arcsec_s, 0.05);
    // 0.7 * 3000/3600 * tanh(0.02) * (1 - exp(-1.2))
    EXPECT_NEAR(terms.quasi_nonmagnetic_arcsec_s, 0.5833333333333 * 0.01999733375993 * 0.69880578808780, 1e-13);
    EXPECT_NEAR(terms.sawtooth_arcsec_s, 0.7 / 30.0, 1e-15);
    EXPECT_NEAR(terms.switch_errors_arcsec_s, 1.0 / 12.0, 1e-15);
    EXPECT_NEAR(terms.total_arcsec_s(), 0.05 + 0.00815165 + 0.02333333 + 0.08333333, 2e-8);
    const DriftTerms printed = terms_as_printed(paper(0.7, 3600.0), 120.0);
    // 0.7 * 3000/240 * (1 - exp(-0.04))^2
    EXPECT_NEAR(printed.quasi_nonmagnetic_arcsec_s, 8.75 * 0.03921056084768 * 0.03921056084768, 1e-13);
    EXPECT_DOUBLE_EQ(printed.sawtooth_arcsec_s, terms.sawtooth_arcsec_s);
    EXPECT_DOUBLE_EQ(printed.switch_errors_arcsec_s, terms.switch_errors_arcsec_s);
}

TEST(DriftBudget, TheWorstCaseIsTheEndErrorAtOddSwitches) {
    for (const double thermal_arcsec_s : {0.0, 0.7, 14.0}) {
        for (const double interval_s : {60.0, 400.0, 5000.0}) {
            DriftCase c = paper(thermal_arcsec_s, 7.0 * interval_s);
            const auto segments = segments_s(interval_s, FirstSegment::full, c.run_s);
            ASSERT_EQ(segments.size(), 7U);
            const double expected = 0.05 + (std::abs(end_error_arcsec(c.gyro, segments)) + 7.0 * 10.0) / c.run_s;
            EXPECT_NEAR(worst_case_drift_arcsec_s(c, interval_s), expected, 1e-12);
            // {(A + Om0) L - A tau tanh(L/2tau)(1 + exp(-t/tau))}/t
            const double closed = (thermal_arcsec_s + 0.7) * interval_s - thermal_arcsec_s * 3000.0 *
                                                                              std::tanh(interval_s / 6000.0) *
                                                                              (1.0 + std::exp(-c.run_s / 3000.0));
            EXPECT_NEAR(worst_case_drift_arcsec_s(c, interval_s), 0.05 + closed / c.run_s + 10.0 / interval_s, 1e-12);
        }
    }
}

TEST(DriftBudget, TheWorstCaseIsTheLargerOfEvenAndOddForDriftsOfEitherSign) {
    std::mt19937_64 random{3};
    for (int i = 0; i < 1000; ++i) {
        const DriftCase c = random_case(random);
        const double interval_s = c.run_s * uniform(random, 0.01, 1.0);
        const auto [nm, om0, a, tau] = c.gyro;
        const double left = std::exp(-c.run_s / tau);
        const double tanh = std::tanh(interval_s / (2.0 * tau));
        const double even = std::abs(a * tau * tanh * (1.0 - left));
        const double odd = std::abs((a + om0) * interval_s - a * tau * tanh * (1.0 + left));
        const double expected = std::abs(nm) + std::fmax(even, odd) / c.run_s + c.switch_error_arcsec / interval_s;
        EXPECT_NEAR(worst_case_drift_arcsec_s(c, interval_s) / expected, 1.0, 1e-12);
    }
}

TEST(DriftBudget, AHalfFirstSegmentHasTheWorstEndThatItsSumsHave) {
    std::mt19937_64 random{4};
    for (int i = 0; i < 200; ++i) {
        DriftCase c = random_case(random);
        const double interval_s = uniform(random, 1.0, 10000.0);
        for (const int n : {6, 7}) {
            c.run_s = (n - 0.5) * interval_s;
            const double angle = angle_after_segments_arcsec(c.gyro, interval_s, FirstSegment::half, n);
            const double residue = start_residue_arcsec(c.gyro, interval_s, FirstSegment::half);
            // At the same instant the other parity would end on the other side of the residue.
            const double mirrored = 2.0 * residue - angle;
            const double magnetic = std::fmax(std::abs(angle), std::abs(mirrored)) / c.run_s;
            const double switches = c.switch_error_arcsec / interval_s;
            EXPECT_NEAR(worst_case_drift_arcsec_s(c, interval_s, FirstSegment::half),
                        std::abs(c.gyro.nonmagnetic_arcsec_s) + magnetic + switches, 1e-10);
        }
    }
}

TEST(DriftBudget, AHalfFirstSegmentHalvesTheMagneticPartOfAColdGyro) {
    const DriftCase c = paper(0.0, 36000.0);
    EXPECT_NEAR(worst_case_drift_arcsec_s(c, 90.0) - 0.05 - 10.0 / 90.0, 0.7 * 90.0 / 36000.0, 1e-14);
    EXPECT_NEAR(worst_case_drift_arcsec_s(c, 90.0, FirstSegment::half) - 0.05 - 10.0 / 90.0, 0.35 * 90.0 / 36000.0,
                1e-14);
}

TEST(DriftBudget, TheCorrectedBudgetIsTheWorstCaseToFirstOrderOfTheInterval) {
    // What is left is of third order: a tenth of the interval, a thousandth of the difference.
    const DriftCase c = paper(14.0, 3600.0);
    const auto difference = [&](double interval_s) {
        return worst_case_drift_arcsec_s(c, interval_s) - corrected_terms(c, interval_s).total_arcsec_s();
    };
    EXPECT_GT(std::abs(difference(1000.0)), 1e-4);
    EXPECT_NEAR(difference(100.0) / difference(1000.0), 1e-3, 1e-4);
    // The printed budget differs at first order.
    const double printed = terms_as_printed(c, 100.0).total_arcsec_s() - corrected_terms(c, 100.0).total_arcsec_s();
    EXPECT_GT(printed, 1000.0 * std::abs(difference(100.0)));
}

TEST(DriftBudget, TheDerivativeIsThatOfThePrintedBudget) {
    std::mt19937_64 random{5};
    for (int i = 0; i < 1000; ++i) {
        const DriftCase c = random_case(random);
        const double interval_s = c.run_s * uniform(random, 0.001, 0.99);
        const auto drift = [&](double length_s) { return terms_as_printed(c, length_s).total_arcsec_s(); };
        const auto central = [&](double step_s) {
            return (drift(interval_s + step_s) - drift(interval_s - step_s)) / (2.0 * step_s);
        };
        const double step_s = 1e-3 * interval_s;
        const double expected = (4.0 * central(step_s / 2.0) - central(step_s)) / 3.0;
        EXPECT_NEAR(derivative_as_printed_arcsec_s2(c, interval_s), expected, 1e-10 * drift(interval_s) / interval_s);
    }
}

TEST(DriftBudget, NoRunAtASwitchExceedsTheBoundForSwitchErrorsOfOneSign) {
    for (const double thermal_arcsec_s : {0.0, 0.7, 14.0}) {
        for (int n = 1; n < 60; ++n) {
            const double interval_s = 60.0;
            DriftCase c = paper(thermal_arcsec_s, n * interval_s);
            c.gyro.nonmagnetic_arcsec_s = 0.0;
            const double angle = angle_after_segments_arcsec(c.gyro, interval_s, FirstSegment::full, n);
            EXPECT_LE((std::abs(angle) + 10.0 * n) / c.run_s, drift_bound_arcsec_s(c, interval_s) + 1e-12);
        }
    }
    // It is reached by a drift that does not change.
    const DriftCase cold = paper(0.0, 660.0);
    EXPECT_NEAR(drift_bound_arcsec_s(cold, 60.0), 0.05 + (0.7 * 60.0 + 11.0 * 10.0) / 660.0, 1e-14);
    // The drift is that at the end of the run: 0.7 + 0.7 (1 - 1/e).
    const DriftCase warm = paper(0.7, 3000.0);
    EXPECT_NEAR(drift_bound_arcsec_s(warm, 60.0), 0.05 + 0.02 * 1.1424843911799 + 1.0 / 6.0, 1e-12);
}

TEST(DriftBudget, IndependentSwitchErrorsAddAsARandomWalk) {
    const DriftCase c = paper(0.7, 3600.0);
    std::mt19937_64 random{6};
    std::normal_distribution<double> switch_arcsec{0.0, 10.0};
    double squares = 0.0;
    constexpr int runs = 20000;
    for (int i = 0; i < runs; ++i) {
        double angle = 0.0;
        for (int k = 0; k < 40; ++k) angle += switch_arcsec(random);
        squares += angle * angle;
    }
    const double rms = std::sqrt(squares / runs) / 3600.0;
    EXPECT_NEAR(independent_switch_drift_arcsec_s(c, 90.0) / rms, 1.0, 0.02);  // four standard deviations
    EXPECT_NEAR(independent_switch_drift_arcsec_s(c, 90.0), 10.0 / std::sqrt(3600.0 * 90.0), 1e-15);
    // Warming from 0.7 to 0.7 + 0.7 (1 - e^-1.2) arcsec/s: the worst end as the worst-case budget has it.
    const double worst_end = worst_case_drift_arcsec_s(c, 90.0) - 0.05 - 10.0 / 90.0;
    EXPECT_NEAR(random_sign_drift_arcsec_s(c, 90.0), 0.05 + std::hypot(worst_end, 10.0 / std::sqrt(324000.0)), 1e-14);
    DriftCase cold = c;
    cold.gyro.magnetic_thermal_arcsec_s = 0.0;
    EXPECT_NEAR(random_sign_drift_arcsec_s(cold, 90.0), 0.05 + std::sqrt(0.0175 * 0.0175 + 100.0 / 324000.0), 1e-14);
}

TEST(DriftBudget, ABudgetIsAMagnitude) {
    std::mt19937_64 random{7};
    for (int i = 0; i < 200; ++i) {
        const DriftCase c = random_case(random);
        DriftCase mirrored = c;
        mirrored.gyro.nonmagnetic_arcsec_s *= -1.0;
        mirrored.gyro.magnetic_arcsec_s *= -1.0;
        mirrored.gyro.magnetic_thermal_arcsec_s *= -1.0;
        const double interval_s = 0.3 * c.run_s;
        EXPECT_EQ(corrected_terms(c, interval_s).total_arcsec_s(),
                  corrected_terms(mirrored, interval_s).total_arcsec_s());
        EXPECT_EQ(terms_as_printed(c, interval_s).total_arcsec_s(),
                  terms_as_printed(mirrored, interval_s).total_arcsec_s());
        EXPECT_EQ(worst_case_drift_arcsec_s(c, interval_s), worst_case_drift_arcsec_s(mirrored, interval_s));
        EXPECT_EQ(drift_bound_arcsec_s(c, interval_s), drift_bound_arcsec_s(mirrored, interval_s));
        EXPECT_EQ(random_sign_drift_arcsec_s(c, interval_s), random_sign_drift_arcsec_s(mirrored, interval_s));
        const DriftTerms terms = corrected_terms(c, interval_s);
        EXPECT_GE(terms.nonmagnetic_arcsec_s, 0.0);
        EXPECT_GE(terms.quasi_nonmagnetic_arcsec_s, 0.0);
        EXPECT_GE(terms.sawtooth_arcsec_s, 0.0);
        EXPECT_EQ(derivative_as_printed_arcsec_s2(c, interval_s),
                  derivative_as_printed_arcsec_s2(mirrored, interval_s));
    }
}

}  // namespace zlg::design::drift_budget_test
