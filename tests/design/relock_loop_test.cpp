#include <zlg/design/relock_loop.hpp>

#include <zlg/design/error.hpp>

#include "test.hpp"

namespace zlg::design::relock_loop_test {

constexpr double none = RelockLoop::none;
constexpr double T = 0.005;

// No limiter, no slew, no lag: what each test then adds.
RelockLoop bare(double tau_s) {
    RelockLoop l;
    l.tau_s = tau_s;
    l.limit_lambda = l.slew_lambda_s = none;
    l.rc_s = 0.0;
    return l;
}

double at(const RelockTrace& trace, double t_s) {
    return trace.detuning_lambda.at(static_cast<std::size_t>(std::lround(t_s / trace.step_s)));
}

double total_arcsec(const std::vector<double>& drift_arcsec_s) {
    double sum = 0.0;
    for (const double d : drift_arcsec_s) sum += d * T;
    return sum;
}

TEST(RelockLoop, ABareIntegratorDecaysExponentially) {
    const double tau = 3.5 * T;
    const auto trace = simulate_relock(bare(tau), 0.1, 8);
    for (const double t : {0.0, 0.001, 0.01, 0.04}) EXPECT_NEAR(at(trace, t), 0.1 * std::exp(-t / tau), 1e-10);
    ASSERT_EQ(trace.half.size(), 16u);
    for (int h = 0; h < 16; ++h) {
        const double a = std::exp(-0.5 * h * T / tau), b = std::exp(-0.5 * (h + 1) * T / tau);
        const auto& got = trace.half[static_cast<std::size_t>(h)];
        EXPECT_NEAR(got.mean_lambda, 0.1 * 2.0 * tau / T * (a - b), 1e-10);
        EXPECT_NEAR(got.mean_square_lambda2, 0.01 * tau / T * (a * a - b * b), 1e-11);
    }
}

// The drift of tick i of an exponential loop: -chi f0 dl0^2 (tau/2T) q^(2(i-1)) (1-q)^2 with + in the first half.
TEST(RelockLoop, TheFalseDriftOfAnExponentialLoopIsThatOfTheCorrectedEquation) {
    const double tau = 3.5 * T, q = std::exp(-T / tau);
    const auto drift = false_drift_arcsec_s({}, simulate_relock(bare(tau), 0.2, 5), 1);
    for (int i = 1; i <= 5; ++i) {
        const double hz = -3.6 * 60e3 * 0.04 * tau / (2.0 * T) * std::pow(q, 2 * (i - 1)) * (1.0 - q) * (1.0 - q);
        EXPECT_NEAR(drift[static_cast<std::size_t>(i - 1)], 3.263 * hz, 1e-5);
    }
}

// tau RC s^2 + tau s + 1 = 0.
TEST(RelockLoop, AStageOfFirstOrderMakesTheSecondOrderDecay) {
    for (const double rc : {0.001, 0.004}) {  // over- and underdamped at tau = 6.5 ms
        RelockLoop l = bare(0.0065);
        l.rc_s = rc;
        const auto root = std::sqrt(std::complex<double>{1.0 - 4.0 * rc / 0.0065});
        const auto a = (-1.0 + root) / (2.0 * rc), b = (-1.0 - root) / (2.0 * rc);
        const auto trace = simulate_relock(l, 0.1, 6);
        for (const double t : {0.0005, 0.003, 0.011, 0.03}) {
            // dl(0) = miss, dl'(0) = 0.
            EXPECT_NEAR(at(trace, t), 0.1 * ((b * std::exp(a * t) - a * std::exp(b * t)) / (b - a)).real(), 1e-10);
        }
    }
}

TEST(RelockLoop, ASlewLimitOfTheStageHoldsTheMoveToALine) {
    RelockLoop l = bare(0.0005);
    l.rc_s = 0.001;
    l.slew_lambda_s = 10.0;
    const auto trace = simulate_relock(l, 0.4, 4);
    // The command outruns the stage by more than 10 RC from 26 us on until near the centre.
    const double a = at(trace, 0.002), b = at(trace, 0.012);
    EXPECT_NEAR((a - b) / 0.010, 10.0, 1e-3);
}

// Limiter, then integrator: a line of slope limit/tau to dl = limit, then an exponential.
TEST(RelockLoop, WithoutALagTheLimitedLoopIsALineWithAnExponentialTail) {
    RelockLoop l;
    l.rc_s = 0.0;
    l.slew_lambda_s = none;
    const double rate = 0.09 / 0.0065, change = (0.22 - 0.09) / rate;
    const auto trace = simulate_relock(l, 0.22, 4);
    const auto motion = [&](double t) {
        return t < change ? 0.22 - rate * t : 0.09 * std::exp(-(t - change) / 0.0065);
    };
    for (double t = 0.0; t < 0.02; t += 0.0005) EXPECT_NEAR(at(trace, t), motion(t), 1e-7);
    // Integral of the square up to t, by hand.
    const auto area = [&](double t) {
        const double line = (std::pow(0.22, 3) - std::pow(std::max(0.09, 0.22 - rate * t), 3)) / (3.0 * rate);
        return t < change ? line : line + 0.09 * 0.09 * 0.00325 * (1.0 - std::exp(-(t - change) / 0.00325));
    };
    const auto drift = false_drift_arcsec_s({}, trace, -1);
    const double expected[] = {4523, 2832, 885, 190};
    for (int i = 0; i < 4; ++i) {
        const double t = i * T;
        const double exact = 0.5 * 3.263 * 60e3 * 3.6 * (2.0 * area(t + 0.5 * T) - area(t) - area(t + T)) / (0.5 * T);
        EXPECT_NEAR(drift[static_cast<std::size_t>(i)], exact, 0.01);
        EXPECT_NEAR(exact, expected[i], 0.5);
    }
}

TEST(RelockLoop, TheLoopThatReproducesTheMeasuredTable) {
    const auto drift = false_drift_arcsec_s({}, simulate_relock({}, 0.22, 4), -1);
    const double expected[] = {4130, 3168, 1296, 218};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(drift[i], expected[i], 0.5);
    EXPECT_NEAR(total_arcsec(drift), 44.1, 0.05);
    // At half the miss the limiter hardly acts: not the same shape.
    const auto smaller = false_drift_arcsec_s({}, simulate_relock({}, 0.11, 4), -1);
    EXPECT_LT(smaller[1] / smaller[0], 0.5 * drift[1] / drift[0]);
}

TEST(RelockLoop, TheSignIsThatOfTheFirstHalfWhateverTheSignOfTheMiss) {
    const auto plus = simulate_relock({}, 0.22, 4), minus = simulate_relock({}, -0.22, 4);
    const auto a = false_drift_arcsec_s({}, plus, 1), b = false_drift_arcsec_s({}, plus, -1);
    const auto c = false_drift_arcsec_s({}, minus, 1);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_LT(a[i], 0.0);
        EXPECT_EQ(a[i], -b[i]);
        EXPECT_NEAR(a[i], c[i], 1e-9);
    }
}

TEST(RelockLoop, TheTotalFalseAngleHardlyDependsOnTheLoop) {
    const double g = bias_deficit_arcsec_s({}, 0.22);
    EXPECT_NEAR(g, 34100, 50);
    const double law = false_angle_law_arcsec(g, T);
    EXPECT_NEAR(law, 42.6, 0.05);
    RelockLoop slow = bare(0.05), lagged = slow, limited = slow;
    lagged.rc_s = 0.02;
    limited.limit_lambda = 0.05;
    for (const RelockLoop& l : {slow, lagged, limited}) {
        EXPECT_NEAR(total_arcsec(false_drift_arcsec_s({}, simulate_relock(l, 0.22, 200), -1)), law, 0.01 * law);
    }
    EXPECT_NEAR(total_arcsec(false_drift_arcsec_s({}, simulate_relock({}, 0.22, 40), -1)), law, 0.05 * law);
}

TEST(RelockLoop, TheFalseAngleOfAnExponentialIsTheSumOfItsTicks) {
    for (const double tau : {T, 3.5 * T, 20.0 * T}) {
        const auto drift = false_drift_arcsec_s({}, simulate_relock(bare(tau), 0.2, 400), -1);
        const double g = bias_deficit_arcsec_s({}, 0.2);
        const double x = T / (2.0 * tau);
        EXPECT_NEAR(total_arcsec(drift), false_angle_law_arcsec(g, T) * std::tanh(x) / x, 1e-6);
    }
}

TEST(RelockLoop, RelockTakesTheTimeOfTheLineAndTheTail) {
    EXPECT_NEAR(relock_time_s(bare(0.0065), 0.22, 0.01, 20), 0.0065 * std::log(22.0), 1e-9);
    RelockLoop l;
    l.rc_s = 0.0;
    EXPECT_NEAR(relock_time_s(l, 0.22, 0.01, 20), 0.0065 * (13.0 / 9.0 + std::log(9.0)), 1e-7);
    EXPECT_EQ(relock_time_s(l, 0.005, 0.01, 5), 0.0);
    EXPECT_EQ(relock_time_s(l, 0.22, 0.01, 2), none);
}

TEST(RelockLoop, AnOvershootCountsUntilItIsOver) {
    RelockLoop l = bare(0.001);
    l.rc_s = 0.004;  // underdamped: zeta = 1/4, w = 500
    const double w = 500.0, z = 0.25, wd = w * std::sqrt(1.0 - z * z);
    const double last = relock_time_s(l, 0.2, 0.02, 20);
    const auto dl = [&](double t) {
        return 0.2 * std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
    };
    EXPECT_NEAR(std::abs(dl(last)), 0.02, 1e-6);
    for (double t = last + 1e-5; t < 0.08; t += 1e-5) ASSERT_LT(std::abs(dl(t)), 0.02);
}

TEST(RelockLoop, RefusesWhatIsOutOfRange) {
    const double nan = std::nan("");
    EXPECT_THROW((void)simulate_relock({}, nan, 4), DesignError);
    EXPECT_THROW((void)simulate_relock({}, 0.6, 4), DesignError);
    EXPECT_THROW((void)simulate_relock({}, 0.2, 0), DesignError);
    EXPECT_THROW((void)simulate_relock(bare(0.0), 0.2, 4), DesignError);
    EXPECT_THROW((void)simulate_relock(bare(1e-12), 0.2, 4), DesignError);
    EXPECT_THROW((void)relock_time_s({}, 0.2, nan, 4), DesignError);
    EXPECT_THROW((void)false_drift_arcsec_s({}, {}, 0), DesignError);
    EXPECT_THROW((void)bias_deficit_arcsec_s({0.0}, 0.1), DesignError);
    EXPECT_THROW((void)false_angle_law_arcsec(nan, T), DesignError);
}

}  // namespace zlg::design::relock_loop_test
