#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <zlg/design/error.hpp>
#include <zlg/design/growing_interval.hpp>
#include <zlg/design/switching_interval.hpp>

#include "magnetic_segments.hpp"
#include "paper_case.hpp"

namespace zlg::design {
namespace {

// With this growth L(t) is the best fixed interval of a run of length t whose first segment is half, for every t.
constexpr double growth_half_first = std::numbers::sqrt2;

// Excess of a drift over nm, as a multiple of the least that a fixed interval chosen for this very run has in the worst
// case, first segment full.
double excess_ratio(const DriftCase& task, double drift_arcsec_s) {
    const double nonmagnetic_arcsec_s = std::abs(task.gyro.nonmagnetic_arcsec_s);
    const double min_arcsec_s = optimum(IntervalMethod::worst_case, task).drift_arcsec_s;
    return (drift_arcsec_s - nonmagnetic_arcsec_s) / (min_arcsec_s - nonmagnetic_arcsec_s);
}

double growing_loss_ratio(const DriftCase& task, double growth) {
    return excess_ratio(task, growing_drift_arcsec_s(task, growth));
}

double fixed_loss_ratio(const DriftCase& task, double interval_s) {
    return excess_ratio(task, worst_case_drift_arcsec_s(task, interval_s));
}

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0.0;
};

// Over the paper's runs, 600 to 36 000 s, in equal ratios.
template <class F>
Range over_runs(const F& f) {
    Range range;
    for (int i = 0; i <= 60; ++i) {
        const double value = f(600.0 * std::pow(60.0, i / 60.0));
        range.least = std::min(range.least, value);
        range.greatest = std::max(range.greatest, value);
    }
    return range;
}

TEST(GrowingInterval, TheIntervalIsThatOfItsInstant) {
    EXPECT_NEAR(growing_interval_s(paper(0.0, 3500.0), growth_half_first), std::sqrt(2.0 * 10.0 * 3500.0 / 0.7), 1e-9);
    EXPECT_NEAR(growing_interval_s(paper(0.7, 3000.0), growth_best),
                2.0 * std::sqrt(10.0 * 3000.0 / (1.4 - 0.7 / std::exp(1.0))), 1e-9);
}

TEST(GrowingInterval, SwitchesAreTheIntegralOfTheirRate) {
    // A = 0: (2/g) sqrt(Om t/dP).
    EXPECT_NEAR(growing_switches(paper(0.0, 36000.0), growth_half_first), std::sqrt(2.0 * 0.7 * 36000.0 / 10.0), 1e-8);
    // Om = A t/tau, for a gyro that warms up slowly: integral of sqrt(A/(tau dP))/g is linear in t.
    const DriftCase slow{{0.0, 0.0, 1e6, 1e12}, 10.0, 3600.0};
    EXPECT_NEAR(growing_switches(slow, 2.0), 3600.0 * std::sqrt(1e-6 / 10.0) / 2.0, 1e-6);
}

// Once for real: switches at t, t + L(t), ..., the angle as the sum of its integrals.
TEST(GrowingInterval, TheBudgetIsThatOfARunMadeOfGrowingSegments) {
    for (const double thermal_arcsec_s : {0.0, 0.7}) {
        for (const double growth : {growth_half_first, growth_best}) {
            std::vector<double> segments{2.0};
            double t_s = segments.back();
            while (t_s < 30000.0) {
                segments.push_back(growing_interval_s(paper(thermal_arcsec_s, t_s), growth));
                t_s += segments.back();
            }
            const DriftCase c = paper(thermal_arcsec_s, t_s);
            const double angle = std::abs(end_error_arcsec(c.gyro, segments));
            const double drift = 0.05 + (angle + 10.0 * static_cast<double>(segments.size())) / t_s;
            EXPECT_NEAR((growing_drift_arcsec_s(c, growth) - 0.05) / (drift - 0.05), 1.0, 0.04);
        }
    }
}

TEST(GrowingInterval, OfAConstantDriftItLoses6PercentOrNothing) {
    for (const double at_s : {600.0, 3600.0, 36000.0}) {
        EXPECT_NEAR(growing_loss_ratio(paper(0.0, at_s), growth_half_first), 1.5 / std::sqrt(2.0), 1e-9);
        EXPECT_NEAR(growing_loss_ratio(paper(0.0, at_s), growth_best), 1.0, 1e-9);
    }
}

TEST(GrowingInterval, OfThePapersGyroItStaysWithin7To17PercentOfTheBestForEachRun) {
    const Range loss = over_runs([](double t) { return growing_loss_ratio(paper(0.7, t), growth_half_first); });
    EXPECT_NEAR(loss.least, 1.066, 0.001);
    EXPECT_NEAR(loss.greatest, 1.166, 0.001);
    const Range best = over_runs([](double t) { return growing_loss_ratio(paper(0.7, t), growth_best); });
    EXPECT_NEAR(best.least, 1.014, 0.001);
    EXPECT_NEAR(best.greatest, 1.113, 0.001);
}

TEST(GrowingInterval, UnderStrongWarmUpTheGainVanishes) {
    const Range loss = over_runs([](double t) { return growing_loss_ratio(paper(14.0, t), growth_half_first); });
    const Range fixed = over_runs([](double t) { return fixed_loss_ratio(paper(14.0, t), 110.0); });
    EXPECT_GT(loss.greatest, 1.3);
    EXPECT_LT(fixed.greatest, loss.greatest);
}

TEST(GrowingInterval, AFixedIntervalLosesMoreTheFartherTheRunIsFromItsOwn) {
    // (u + 1/u)/2 with u = L/L_opt: 90 s in a run of ten hours loses four times.
    EXPECT_NEAR(fixed_loss_ratio(paper(0.0, 36000.0), 90.0), 4.05, 0.005);
    EXPECT_NEAR(fixed_loss_ratio(paper(0.7, 36000.0), 90.0), 3.33, 0.005);
    // The best for an hour, in ten.
    const double hour_s = optimum(IntervalMethod::worst_case, paper(0.7, 3600.0)).interval_s;
    EXPECT_NEAR(fixed_loss_ratio(paper(0.7, 36000.0), hour_s), 1.67, 0.005);
    EXPECT_NEAR(fixed_loss_ratio(paper(0.7, 3600.0), hour_s), 1.0, 1e-12);
}

TEST(GrowingInterval, TheFixedIntervalThatLosesLeastOverAllRunsStillLosesHalf) {
    const auto min_loss = [](double thermal_arcsec_s) {
        double least = std::numeric_limits<double>::infinity();
        for (double interval_s = 100.0; interval_s < 500.0; interval_s *= 1.005) {
            least = std::min(least, over_runs([&](double t) {
                                        return fixed_loss_ratio(paper(thermal_arcsec_s, t), interval_s);
                                    }).greatest);
        }
        return least;
    };
    // At sqrt(L_opt(600) L_opt(36000)): u = 60^(1/4).
    EXPECT_NEAR(min_loss(0.0), (std::pow(60.0, 0.25) + std::pow(60.0, -0.25)) / 2.0, 0.005);
    EXPECT_NEAR(min_loss(0.7), 1.48, 0.005);
}

TEST(GrowingInterval, WithoutDriftThereIsNoSwitch) {
    DriftCase still = paper(0.0, 3600.0);
    still.gyro.magnetic_arcsec_s = 0.0;
    EXPECT_EQ(growing_interval_s(still, growth_best), std::numeric_limits<double>::infinity());
    EXPECT_EQ(growing_switches(still, growth_best), 0.0);
    EXPECT_EQ(growing_drift_arcsec_s(still, growth_best), 0.05);
}

TEST(GrowingInterval, WhatCannotBeIsRefused) {
    for (const double bad : {0.0, -1.0, std::nan("")}) {
        EXPECT_THROW((void)growing_interval_s(paper(0.7, 600.0), bad), DesignError);
        EXPECT_THROW((void)growing_switches(paper(0.7, 600.0), bad), DesignError);
        EXPECT_THROW((void)growing_drift_arcsec_s(paper(0.7, 600.0), bad), DesignError);
        EXPECT_THROW((void)growing_interval_s(paper(0.7, bad), growth_best), DesignError);
    }
}

}  // namespace
}  // namespace zlg::design
