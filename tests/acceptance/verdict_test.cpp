#include <zlg/acceptance/verdict.hpp>

#include <zlg/chance/draw.hpp>

#include "test.hpp"

namespace zlg::verdict_test {

using namespace acceptance;

Value student(double value, double uncertainty, double degrees) {
    return {.name = "bias.deg_h",
            .determined = true,
            .value = value,
            .uncertainty = uncertainty,
            .degrees = degrees,
            .hours = 1.0};
}

Limit at_most(double max) { return {.name = "bias.deg_h", .min = {}, .max = max}; }

// Quantiles of printed tables: t(0.95; 5) = 2.015, t(0.95; infinity) = 1.645.
TEST(Verdict, the_guard_band_is_the_quantile_of_student_times_the_uncertainty) {
    EXPECT_EQ(judge(student(1.0 - 2.02, 1.0, 5.0), at_most(1.0), 0.05).verdict, Verdict::pass);
    EXPECT_EQ(judge(student(1.0 - 2.01, 1.0, 5.0), at_most(1.0), 0.05).verdict, Verdict::undecided);
    EXPECT_EQ(judge(student(1.0 + 2.02, 1.0, 5.0), at_most(1.0), 0.05).verdict, Verdict::fail);
    EXPECT_EQ(judge(student(1.0 - 1.65, 1.0, INFINITY), at_most(1.0), 0.05).verdict, Verdict::pass);
    EXPECT_EQ(judge(student(1.0 - 1.64, 1.0, INFINITY), at_most(1.0), 0.05).verdict, Verdict::undecided);
}

TEST(Verdict, both_limits_share_one_risk) {
    const Limit narrow{.name = "bias.deg_h", .min = -1.0, .max = 1.0};
    // In the middle of limits at two standard uncertainties 4.6 % lie beyond; at 1.9 of them 5.7 %.
    EXPECT_EQ(judge(student(0.0, 0.5, INFINITY), narrow, 0.05).verdict, Verdict::pass);
    EXPECT_EQ(judge(student(0.0, 1.0 / 1.9, INFINITY), narrow, 0.05).verdict, Verdict::undecided);
    EXPECT_NEAR(judge(student(0.0, 0.5, INFINITY), narrow, 0.05).risk, 0.0455, 1e-4);
}

// chi-square(0.05; 10) = 3.940: the upper bound of a standard deviation s of 10 degrees is s sqrt(10/3.940) = 1.593 s.
TEST(Verdict, a_standard_deviation_has_the_bounds_of_chi_square) {
    Value s = student(1.0, 0.22, 10.0);
    s.law = Law::chi;
    EXPECT_EQ(judge(s, at_most(1.594), 0.05).verdict, Verdict::pass);
    EXPECT_EQ(judge(s, at_most(1.592), 0.05).verdict, Verdict::undecided);
    // chi-square(0.95; 10) = 18.307: the lower bound is 0.739 s.
    EXPECT_EQ(judge(s, at_most(0.738), 0.05).verdict, Verdict::fail);
    EXPECT_EQ(judge(s, at_most(0.740), 0.05).verdict, Verdict::undecided);
}

// However far the limit is, and however well the value is known.
TEST(Verdict, a_limit_may_be_as_far_as_it_likes) {
    for (const double degrees : {1.0, 10.0, 4000.0, 1e6, 1e12})
        for (const double far : {1e-300, 1e-9, 1e-4, 1e4, 1e9, 1e300}) {
            Value v = student(1.0, 0.1, degrees);
            v.law = Law::chi;
            EXPECT_EQ(judge(v, at_most(far), 0.05).verdict, far > 1.0 ? Verdict::pass : Verdict::fail)
                << degrees << far;
            v.law = Law::poisson;
            v.value = degrees;
            if (far <= 1e-4 || far > 1e12)
                EXPECT_EQ(judge(v, at_most(far), 0.05).verdict, far > 1.0 ? Verdict::pass : Verdict::fail) << far;
        }
}

// No event in T: the rate is below ln(20)/T = 2.996/T at 95 %.
TEST(Verdict, no_event_is_no_proof_of_none) {
    Value none{.name = "alarms.per_h",
               .determined = true,
               .value = 0.0,
               .uncertainty = 1.0,
               .law = Law::poisson,
               .hours = 1.0};
    EXPECT_EQ(judge(none, at_most(3.0), 0.05).verdict, Verdict::pass);
    EXPECT_EQ(judge(none, at_most(2.99), 0.05).verdict, Verdict::undecided);
}

TEST(Verdict, what_is_counted_is_compared) {
    Value gap{.name = "gap.ticks", .determined = true, .value = 3.0, .uncertainty = 0.0, .law = Law::without_error};
    EXPECT_EQ(judge(gap, at_most(3.0), 0.05).verdict, Verdict::pass);
    EXPECT_EQ(judge(gap, at_most(2.0), 0.05).verdict, Verdict::fail);
}

TEST(Verdict, no_magnitude_is_below_nothing) {
    const Limit band{.name = "bias_hysteresis.deg_h", .min = 0.0, .max = 1.0};
    Value width = student(0.01, 0.1, 10.0);
    EXPECT_EQ(judge(width, band, 0.05).verdict, Verdict::undecided) << "a bias has either sign";
    width.name = "bias_hysteresis.deg_h";
    EXPECT_EQ(judge(width, band, 0.05).verdict, Verdict::pass);
    width.value = width.uncertainty = 0.0;
    EXPECT_EQ(judge(width, band, 0.05).verdict, Verdict::pass);
    EXPECT_EQ(judge(width, Limit{.name = width.name, .min = 0.5, .max = 1.0}, 0.05).verdict, Verdict::fail);
    // What is counted may be at either limit.
    width = {.name = "switches_withheld.count", .determined = true, .value = 2.0, .law = Law::without_error};
    EXPECT_EQ(judge(width, Limit{.name = width.name, .min = 2.0, .max = 2.0}, 0.05).verdict, Verdict::pass);
    width = {.name = "alarms.per_h", .determined = true, .value = 0.0, .law = Law::poisson, .hours = 10.0};
    EXPECT_EQ(judge(width, band, 0.05).verdict, Verdict::pass);
}

// L times the time: u_L = u/sqrt(L), and the value is normal about the present one with s^2 = u^2 - u_L^2, so that the
// chance is Phi((d - k u_L)/s) + Phi((-d - k u_L)/s), k = 1.645; it is known to 1 %.
TEST(Verdict, the_chance_of_a_verdict_is_even_after_the_hours) {
    for (const double distance : {0.8225, -0.8225, 1.6, 0.2, 0.0}) {
        const Judged open = judge(student(1.0 - distance, 1.0, INFINITY), at_most(1.0), 0.05);
        ASSERT_EQ(open.verdict, Verdict::undecided);
        ASSERT_TRUE(open.more_hours);
        const double longer = 1.0 + *open.more_hours;
        const double guard = 1.6449 / std::sqrt(longer), s = std::sqrt(1.0 - 1.0 / longer);
        const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
        EXPECT_NEAR(below((distance - guard) / s) + below((-distance - guard) / s), 0.5, 0.011) << distance;
    }
}

// Simulated, wherever the truth lies.
TEST(Verdict, half_of_the_values_are_decided_then) {
    chance::Draw draw{1, chance::Cause::test};
    int n = 0, decided = 0;
    for (int k = 0; k < 4000; ++k) {
        const double truth = draw.within(-5.0, 5.0), value = truth + draw.normal();
        const Judged open = judge(student(value, 1.0, INFINITY), at_most(0.0), 0.05);
        if (open.verdict != Verdict::undecided) continue;
        const double longer = 1.0 + open.more_hours.value();
        // The mean of one record of length 1 and another one of length longer - 1.
        const double all = (value + (longer - 1.0) * (truth + draw.normal() / std::sqrt(longer - 1.0))) / longer;
        ++n;
        const Judged later = judge(student(all, 1.0 / std::sqrt(longer), INFINITY), at_most(0.0), 0.05);
        decided += later.verdict != Verdict::undecided ? 1 : 0;
    }
    EXPECT_NEAR(decided, 0.5 * n, 3.3 * std::sqrt(0.25 * n)) << n;
}

TEST(Verdict, slow_noise_is_decided_by_no_time) {
    Value v = student(0.5, 1.0, INFINITY);
    v.longer = Longer::helps_not;
    const Judged open = judge(v, at_most(1.0), 0.05);
    EXPECT_EQ(open.verdict, Verdict::undecided);
    EXPECT_FALSE(open.more_hours);
}

TEST(Verdict, without_a_limit_there_is_none_and_what_is_open_stays_open) {
    EXPECT_FALSE(judge(student(0.0, 1.0, 5.0), std::nullopt, 0.05).verdict);
    EXPECT_EQ(judge(not_determined("bias.deg_h", "no log"), at_most(1.0), 0.05).verdict, Verdict::not_determined);
}

TEST(Verdict, the_risk_of_a_unit_is_that_of_any_limit) {
    Judged a, b;
    a.risk = 0.01;
    b.risk = 0.02;
    EXPECT_NEAR(unit_risk({a, b}), 1.0 - 0.99 * 0.98, 1e-15);
}

}  // namespace zlg::verdict_test
