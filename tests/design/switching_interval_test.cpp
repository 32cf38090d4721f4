#include <zlg/design/error.hpp>
#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>

#include "magnetic_segments.hpp"
#include "paper_case.hpp"

namespace zlg::design::switching_interval_test {

// --- the paper's figures 4 and 5 -----------------------------------------------------------------------------------

struct Row {
    double thermal_arcsec_s;
    double run_s;
    double printed_s;
    double printed_arcsec_s;
    double corrected_s;
    double corrected_arcsec_s;
};

// Both readings of the paper's parameters: 0.7 as the thermal change itself, or per degree of 20.
constexpr std::array rows{
    Row{0.7, 600.0, 88.5, 0.276, 88.7, 0.276},    Row{0.7, 900.0, 106.2, 0.239, 106.7, 0.237},
    Row{0.7, 3600.0, 183.3, 0.160, 195.2, 0.152}, Row{0.7, 36000.0, 294.8, 0.121, 586.5, 0.084},
    Row{14.0, 600.0, 54.1, 0.422, 55.2, 0.412},   Row{14.0, 900.0, 57.5, 0.400, 59.8, 0.384},
    Row{14.0, 3600.0, 64.2, 0.365, 80.2, 0.299},  Row{14.0, 36000.0, 66.7, 0.353, 216.4, 0.142},
};

TEST(SwitchingInterval, TheMinimaOfThePapersFigures) {
    for (const Row& row : rows) {
        const DriftCase c = paper(row.thermal_arcsec_s, row.run_s);
        const Optimum printed = optimum(IntervalMethod::as_printed, c);
        const Optimum corrected = optimum(IntervalMethod::corrected, c);
        EXPECT_EQ(printed.status, OptimumStatus::inside);
        EXPECT_NEAR(printed.interval_s, row.printed_s, 0.05);
        EXPECT_NEAR(printed.drift_arcsec_s, row.printed_arcsec_s, 0.0005);
        EXPECT_NEAR(corrected.interval_s, row.corrected_s, 0.05);
        EXPECT_NEAR(corrected.drift_arcsec_s, row.corrected_arcsec_s, 0.0005);
    }
}

TEST(SwitchingInterval, TheMinimumOfThePrintedBudgetIsTheRootOfItsDerivative) {
    for (const Row& row : rows) {
        const DriftCase c = paper(row.thermal_arcsec_s, row.run_s);
        const double best_s = optimum(IntervalMethod::as_printed, c).interval_s;
        EXPECT_LT(derivative_as_printed_arcsec_s2(c, best_s * (1.0 - 1e-10)), 0.0);
        EXPECT_GT(derivative_as_printed_arcsec_s2(c, best_s * (1.0 + 1e-10)), 0.0);
    }
}

// L = sqrt(2 dP t/(|Om(t)| + |Om(0)|)), the minimum to first order in L/tau.
TEST(SwitchingInterval, TheWorstCaseHasItsMinimumNearTheFirstOrderFormula) {
    for (const Row& row : rows) {
        const DriftCase c = paper(row.thermal_arcsec_s, row.run_s);
        const double first_order_s =
            std::sqrt(2.0 * 10.0 * row.run_s / (0.7 + magnetic_rate_arcsec_s(c.gyro, row.run_s)));
        EXPECT_NEAR(optimum(IntervalMethod::worst_case, c).interval_s / first_order_s, 1.0, 0.002);
    }
}

TEST(SwitchingInterval, TheCorrectedDriftFallsToTheNonmagneticOneInALongRun) {
    for (const double thermal_arcsec_s : {0.7, 14.0}) {
        const auto excess = [&](double run_s) {
            return optimum(IntervalMethod::corrected, paper(thermal_arcsec_s, run_s)).drift_arcsec_s - 0.05;
        };
        EXPECT_LT(excess(1e9), 4e-4);
        EXPECT_GT(excess(1e9), 0.0);
        // Once the warm-up is forgotten, as the root of the run's length.
        EXPECT_NEAR(excess(1e13) / excess(1e11), 0.1, 0.003);
    }
}

TEST(SwitchingInterval, ThePrintedDriftStopsAtAFalseFloor) {
    EXPECT_NEAR(optimum(IntervalMethod::as_printed, paper(14.0, 5e5)).drift_arcsec_s - 0.05, 0.30, 0.005);
    EXPECT_NEAR(optimum(IntervalMethod::as_printed, paper(0.7, 5e5)).drift_arcsec_s - 0.05, 0.065, 0.0005);
}

TEST(SwitchingInterval, InAStillLongerRunThePrintedBudgetHasALowerMinimumThatNoGyroHas) {
    // For L >> tau printed (7) is (A tau/2 + dP)/L + L Om0/t.
    for (const double thermal_arcsec_s : {0.7, 14.0}) {
        const Optimum best = optimum(IntervalMethod::as_printed, paper(thermal_arcsec_s, 1e7));
        const double numerator_arcsec = thermal_arcsec_s * 1500.0 + 10.0;
        EXPECT_NEAR(best.interval_s, std::sqrt(numerator_arcsec * 1e7 / 0.7), 1e-3 * best.interval_s);
        EXPECT_NEAR(best.drift_arcsec_s - 0.05, 2.0 * std::sqrt(numerator_arcsec * 0.7 / 1e7), 1e-6);
    }
}

// --- against brute force ---------------------------------------------------------------------------------------------

using Real = long double;

// The budgets once more, in extended precision and as they are usually written.
struct Reference {
    Real om0, a, tau, dp, t;

    Real corrected(Real x) const {
        return std::abs(a) * tau / t * std::tanh(x / 2 / tau) * (1 - std::exp(-t / tau)) + x * std::abs(om0) / t +
               dp / x;
    }
    Real as_printed(Real x) const {
        const Real warmed = -std::expm1(-x / tau);
        return std::abs(a) * tau / 2 / x * warmed * warmed + x * std::abs(om0) / t + dp / x;
    }
    Real worst_case(Real x) const {
        const Real tanh = a * tau * std::tanh(x / 2 / tau);
        const Real left = std::exp(-t / tau);
        const Real odd = std::abs((a + om0) * x - tanh * (1 + left));
        return std::fmax(odd, std::abs(tanh * (1 - left))) / t + dp / x;
    }
};

struct Least {
    Real at;
    Real value;
};

// Golden section in the logarithm, started from the best of 2000 points.
template <class F> Least brute_force(const F& f, Real low, Real high) {
    constexpr int n = 2000;
    const auto point = [&](int i) { return low * std::exp(std::log(high / low) * static_cast<Real>(i) / n); };
    int best = 0;
    Real best_value = f(low);
    for (int i = 1; i <= n; ++i) {
        const Real value = f(point(i));
        if (value < best_value) best = i, best_value = value;
    }
    Real left = std::log(point(std::max(0, best - 1)));
    Real right = std::log(point(std::min(n, best + 1)));
    constexpr Real golden = 1 / std::numbers::phi_v<Real>;
    for (int i = 0; i < 70; ++i) {
        const Real a = right - golden * (right - left);
        const Real b = left + golden * (right - left);
        if (f(std::exp(a)) < f(std::exp(b)))
            right = b;
        else
            left = a;
    }
    const Real at = std::exp((left + right) / 2);
    return {at, f(at)};
}

void expect_least(const Optimum& found, const Least& expected, const DriftCase& c) {
    const auto [nm, om0, a, tau] = c.gyro;
    const double excess = found.drift_arcsec_s - std::abs(nm);
    EXPECT_NEAR(found.interval_s / static_cast<double>(expected.at), 1.0, 1e-6)
        << "Om0 " << om0 << " A " << a << " tau " << tau << " dP " << c.switch_error_arcsec << " t " << c.run_s;
    EXPECT_NEAR(excess / static_cast<double>(expected.value), 1.0, 1e-9);
}

TEST(SwitchingInterval, BruteForceFindsTheSameMinimaForAThousandGyros) {
    std::mt19937_64 random{1};
    const auto decades = [&](double low, double high) {
        return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
    };
    const auto sign = [&] { return std::bernoulli_distribution(0.5)(random) ? 1.0 : -1.0; };
    int whole_run = 0;
    for (int i = 0; i < 1000; ++i) {
        const double om0 = sign() * decades(-2.0, 2.0), a = sign() * decades(-2.0, 2.0), tau = decades(2.0, 5.0),
                     dp = decades(-1.0, 2.0), t = decades(1.0, 6.0);
        const DriftCase c{{0.0, om0, a, tau}, dp, t};
        const Reference r{om0, a, tau, dp, t};
        const Real low = 1e-4L, high = t;
        const Optimum corrected = optimum(IntervalMethod::corrected, c);
        expect_least(corrected, brute_force([&](Real x) { return r.corrected(x); }, low, high), c);
        expect_least(optimum(IntervalMethod::worst_case, c),
                     brute_force([&](Real x) { return r.worst_case(x); }, low, high), c);
        expect_least(optimum(IntervalMethod::as_printed, c),
                     brute_force([&](Real x) { return r.as_printed(x); }, low, high), c);
        whole_run += corrected.status == OptimumStatus::whole_run;
        EXPECT_EQ(corrected.status == OptimumStatus::whole_run, corrected.interval_s == t);
    }
    EXPECT_GT(whole_run, 10);
    EXPECT_LT(whole_run, 500);
}

TEST(SwitchingInterval, WithoutThermalChangeEveryWorstCaseMethodIsTheClosedFormToEightDigits) {
    const DriftCase cold = paper(0.0, 3600.0);
    const double expected_s = std::sqrt(10.0 * 3600.0 / 0.7);
    for (const auto method : {IntervalMethod::corrected, IntervalMethod::worst_case, IntervalMethod::as_printed,
                              IntervalMethod::closed_form}) {
        const Optimum best = optimum(method, cold);
        EXPECT_NEAR(best.interval_s / expected_s, 1.0, 1e-12) << name(method);
        EXPECT_NEAR(best.drift_arcsec_s, 0.05 + 2.0 * std::sqrt(0.7 * 10.0 / 3600.0), 1e-14) << name(method);
    }
}

// --- first segment half, other methods -------------------------------------------------------------------------------

TEST(SwitchingInterval, AHalfFirstSegmentLengthensTheBestIntervalAndLowersTheDriftBySqrt2) {
    const DriftCase cold = paper(0.0, 36000.0);
    const Optimum full = worst_case_optimum(cold, FirstSegment::full);
    const Optimum half = worst_case_optimum(cold, FirstSegment::half);
    EXPECT_NEAR(half.interval_s / full.interval_s, std::numbers::sqrt2, 1e-12);
    EXPECT_NEAR((full.drift_arcsec_s - 0.05) / (half.drift_arcsec_s - 0.05), std::numbers::sqrt2, 1e-12);
    // Of a gyro that warms up strongly the start counts for little: there is nearly nothing to gain.
    const DriftCase warm = paper(14.0, 36000.0);
    const double gain = (worst_case_optimum(warm, FirstSegment::full).drift_arcsec_s - 0.05) /
                        (worst_case_optimum(warm, FirstSegment::half).drift_arcsec_s - 0.05);
    EXPECT_GT(gain, 1.0);
    EXPECT_LT(gain, 1.03);
}

TEST(SwitchingInterval, AHalfFirstSegmentHasTheMinimumOfItsOwnBudget) {
    for (const double thermal_arcsec_s : {-14.0, -0.3, 0.7, 14.0}) {
        const DriftCase c = paper(thermal_arcsec_s, 3600.0);
        const double best_s = worst_case_optimum(c, FirstSegment::half).interval_s;
        const auto drift = [&](Real x) {
            return static_cast<Real>(worst_case_drift_arcsec_s(c, static_cast<double>(x), FirstSegment::half));
        };
        EXPECT_NEAR(best_s / static_cast<double>(brute_force(drift, 1.0L, 3600.0L).at), 1.0, 1e-6);
    }
}

TEST(SwitchingInterval, TheClosedFormReportsItsOwnBudget) {
    const DriftCase c = paper(0.7, 3600.0);
    const Optimum closed = optimum(IntervalMethod::closed_form, c);
    EXPECT_NEAR(closed.interval_s, 226.8, 0.05);
    EXPECT_NEAR(closed.drift_arcsec_s, 0.05 + closed.interval_s * 0.7 / 3600.0 + 10.0 / closed.interval_s, 1e-14);
}

// The sum of the integrals over all segments, at ends anywhere within the last two intervals, beside independent switch
// errors: the least rms over a grid of intervals.
TEST(SwitchingInterval, TheExpectedOptimumCostsLittleMoreThanTheLeastRmsOverAllEnds) {
    struct Draw {
        double om0, a, tau_s, error, run_s;
        FirstSegment first;
    };
    for (const Draw& d : {Draw{0.7, 0.7, 3000.0, 1.2, 3600.0, FirstSegment::full},
                          Draw{0.0, 3.0, 900.0, 2.0, 1800.0, FirstSegment::full},
                          Draw{-2.0, 5.0, 600.0, 1.0, 1200.0, FirstSegment::full},
                          Draw{14.0, 14.0, 3000.0, 6.0, 600.0, FirstSegment::half},
                          Draw{5.0, 0.0, 3000.0, 0.7, 600.0, FirstSegment::half},
                          Draw{0.1, 0.0, 3000.0, 0.5, 7200.0, FirstSegment::full}}) {
        const GyroDrift gyro{0.0, d.om0, d.a, d.tau_s};
        const auto rms_arcsec = [&](double interval_s) {
            double sum_sq = 0.0;
            constexpr int n_ends = 40;
            for (int k = 0; k < n_ends; ++k) {
                const double end_s = d.run_s - 2.0 * interval_s * (k + 0.5) / n_ends;
                const auto segments = segments_s(interval_s, d.first, end_s);
                const double angle = end_error_arcsec(gyro, segments);
                sum_sq += angle * angle + d.error * d.error * static_cast<double>(segments.size() - 1);
            }
            return std::sqrt(sum_sq / n_ends);
        };
        double least = rms_arcsec(d.run_s / 3.0);
        for (double interval_s = d.run_s / 3.0; interval_s > 1e-3 * d.run_s; interval_s *= 0.95)
            least = std::min(least, rms_arcsec(interval_s));
        const DriftCase task{.gyro = gyro, .switch_error_arcsec = d.error, .run_s = d.run_s};
        const Optimum expected = expected_optimum(task, d.first);
        EXPECT_LT(rms_arcsec(expected.interval_s), 1.03 * least) << d.om0 << ' ' << d.a;
        EXPECT_NEAR(rms_arcsec(expected.interval_s) / d.run_s / expected.drift_arcsec_s, 1.0, 0.05);
    }
}

// --- edges -----------------------------------------------------------------------------------------------------------

TEST(SwitchingInterval, InAShortRunNoSwitchPays) {
    for (const auto method : interval_methods) {
        const Optimum best = optimum(method, paper(0.7, 3.0));
        EXPECT_EQ(best.status, OptimumStatus::whole_run) << name(method);
        EXPECT_EQ(best.interval_s, 3.0) << name(method);
        EXPECT_EQ(best.drift_arcsec_s, drift_arcsec_s(method, paper(0.7, 3.0), 3.0)) << name(method);
    }
}

TEST(SwitchingInterval, WithoutMagneticDriftNoSwitchPays) {
    DriftCase still = paper(0.0, 3600.0);
    still.gyro.magnetic_arcsec_s = 0.0;
    for (const auto method : interval_methods) {
        const Optimum best = optimum(method, still);
        EXPECT_EQ(best.status, OptimumStatus::no_magnetic_drift) << name(method);
        EXPECT_EQ(best.interval_s, 3600.0) << name(method);
    }
    // The formulas that know no warm-up see none where only the warm-up is.
    still.gyro.magnetic_thermal_arcsec_s = 14.0;
    EXPECT_EQ(optimum(IntervalMethod::closed_form, still).status, OptimumStatus::no_magnetic_drift);
    EXPECT_EQ(optimum(IntervalMethod::worst_case, still).status, OptimumStatus::inside);
}

TEST(SwitchingInterval, AKinkOfTheWorstCaseIsAMinimumToo) {
    // K[Om](680 s) changes its sign at an interval of 399.03 s, and |K| falls before it and rises after.
    const DriftCase c{{0.0, 1.0, -2.0, 1000.0}, 108.0, 680.0};
    const Optimum best = optimum(IntervalMethod::worst_case, c);
    EXPECT_NEAR(best.interval_s, 399.0348162, 1e-6);
    EXPECT_NEAR(kernel_arcsec(c.gyro, best.interval_s, 680.0), 0.0, 1e-11);
    const Reference r{1.0L, -2.0L, 1000.0L, 108.0L, 680.0L};
    expect_least(best, brute_force([&](Real x) { return r.worst_case(x); }, 0.1L, 680.0L), c);
}

TEST(SwitchingInterval, WhatCannotBeIsRefused) {
    DriftCase c = paper(0.7, 3600.0);
    c.switch_error_arcsec = 0.0;
    for (const auto method : interval_methods) EXPECT_THROW((void)optimum(method, c), DesignError) << name(method);
    EXPECT_THROW((void)worst_case_optimum(c, FirstSegment::half), DesignError);
    EXPECT_THROW((void)drift_arcsec_s(IntervalMethod::corrected, paper(0.7, 60.0), 61.0), DesignError);
    // Numbers that leave the range of numbers.
    DriftCase huge = paper(0.7, 3600.0);
    huge.gyro.magnetic_arcsec_s = 1e307;
    huge.switch_error_arcsec = 1e-300;
    EXPECT_THROW((void)optimum(IntervalMethod::corrected, huge), DesignError);
    // A value that is no method.
    EXPECT_THROW((void)optimum(static_cast<IntervalMethod>(99), paper(0.7, 600.0)), DesignError);
    EXPECT_THROW((void)drift_arcsec_s(static_cast<IntervalMethod>(99), paper(0.7, 600.0), 60.0), DesignError);
}

}  // namespace zlg::design::switching_interval_test
