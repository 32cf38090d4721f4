#include "relock_drift_support.hpp"

namespace zlg::core::relock_drift_support::drift_test {

// A bias so high that the rounding of counts is beyond the digits looked at.
constexpr double fine_bias_hz = 1e13;

Configured fine(RelockMethod method, double bias_hz = fine_bias_hz) {
    Configured setup = configured(method);
    setup.gyro.bias = Hertz{bias_hz};
    return setup;
}

// A loop that lets the detuning decay as dl0 exp(-t/tau), and what a gyro without noise would measure of it.
struct ExponentialLoop {
    double dl0_lambda = 0.22;
    double tau_ticks = 3.5;

    // Mean of dl^power over the half that starts at tick `start` of the decay.
    double mean(int power, double start) const {
        const double rate = power / tau_ticks;
        return std::pow(dl0_lambda, power) * std::exp(-rate * start) * (1.0 - std::exp(-0.5 * rate)) / (0.5 * rate);
    }

    Tick tick(const Configured& c, int i, int sign, double rotation_hz) const {
        Tick t{.sign = sign, .temperature_c = not_a_number};
        t.detuning_first_lambda = mean(1, i - 1);
        t.detuning_second_lambda = mean(1, i - 0.5);
        t.detuning_sq_first_lambda2 = mean(2, i - 1);
        t.detuning_sq_second_lambda2 = mean(2, i - 0.5);
        const double half_s = 0.5 * c.gyro.tick.value();
        const double f0 = c.gyro.bias.value();
        t.counts_first =
            std::llround(half_s * (rotation_hz + sign * f0 * (1.0 - c.gyro.chi * t.detuning_sq_first_lambda2)));
        t.counts_second =
            std::llround(half_s * (rotation_hz - sign * f0 * (1.0 - c.gyro.chi * t.detuning_sq_second_lambda2)));
        return t;
    }

    // Closed form of the false angle: -chi f0 dl0^2 (tau/2T) q^(2(i-1)) (1-q)^2, a rate in counts/s.
    double false_angle_arcsec(const Configured& c, int i, int sign) const {
        const double q = std::exp(-1.0 / tau_ticks);
        const double rate_hz = -c.gyro.chi * c.gyro.bias.value() * dl0_lambda * dl0_lambda * 0.5 * tau_ticks *
                               std::pow(q, 2 * (i - 1)) * (1.0 - q) * (1.0 - q);
        return sign * c.gyro.scale.value() * c.gyro.tick.value() * rate_hz;
    }
};

constexpr double rotation_hz = 3677.5;

// The false angle that is known of tick i, at once or one tick later.
double corrected_arcsec(const Configured& config, RelockDriftState& state, const ExponentialLoop& loop, int i,
                        int sign) {
    const RelockDriftOutput out = step(config, state, loop.tick(config, i, sign, rotation_hz));
    EXPECT_TRUE(out.due);
    EXPECT_FALSE(out.first_due && i != 2);
    if (!out.waiting) {
        EXPECT_TRUE(out.tick.known);
        return out.tick.value_arcsec;
    }
    RelockDriftState ahead = state;
    const RelockDriftOutput next = step(config, ahead, loop.tick(config, i + 1, sign, rotation_hz));
    EXPECT_TRUE(next.first_due && next.first.known);
    return next.first.value_arcsec;
}

// chi (x^2 + b x^4), either sign of either: means over halves of a loop that hardly moves within one.
TEST(RelockDrift, TermsBeyondTheSquareAddTheFallOfTheirMeans) {
    const ExponentialLoop slow{.tau_ticks = 60.0};
    for (const double chi : {3.6, -0.4})
        for (const double b : {-20.0, 30.0}) {
            Configured setup = fine(RelockMethod::mean_square);
            setup.gyro.chi = chi;
            setup.gyro.bend.term[0] = b;
            setup.gyro.light_noise = Wavelengths{0.0};
            RelockDriftState state;
            enter_gap(state);
            const auto fall = [&](int power) { return slow.mean(power, 0.5) - slow.mean(power, 0.0); };
            const double expected = 0.5 * chi * setup.gyro.bias.value() * setup.gyro.scale.value() *
                                    setup.gyro.tick.value() * (fall(2) + b * fall(4));
            EXPECT_NEAR(corrected_arcsec(setup, state, slow, 1, 1) / expected, 1.0, 1e-4) << chi << ' ' << b;
        }
}

// The bias lacks chi (dl - c)^2 of itself: what the centre adds is linear in the mean.
TEST(RelockDrift, ACentreOfTheBiasMovesTheFalseAngleByTheMeans) {
    for (const RelockMethod method : {RelockMethod::detuning, RelockMethod::mean_square})
        for (const double centre : {-0.1, 0.03})
            for (const double dl0 : {0.22, -0.1}) {
                const ExponentialLoop loop{dl0, 3.5};
                Configured config = fine(method);
                config.gyro.centre = Wavelengths{centre};
                RelockDriftState state;
                enter_gap(state);
                for (int i = 1; i <= 5; ++i) {
                    const double loss = loop.mean(2, i - 0.5) - loop.mean(2, i - 1) -
                                        2.0 * centre * (loop.mean(1, i - 0.5) - loop.mean(1, i - 1));
                    const double expected = config.gyro.scale.value() * config.gyro.tick.value() * 0.5 *
                                            config.gyro.chi * config.gyro.bias.value() * loss;
                    EXPECT_NEAR(corrected_arcsec(config, state, loop, i, 1) / expected, 1.0, 1e-9)
                        << centre << ' ' << dl0 << ", tick " << i;
                }
            }
}

// The bias reverses linearly within t_e about each border of a half, so that it weighs the square by a trapezoid:
// `joint` takes that, of a detuning that changes evenly without an error. The paper's method takes the squares as they
// are.
TEST(RelockDrift, JointWeighsTheSquareAsABiasDoesThatReversesSlowly) {
    constexpr double q = 0.03;  // t_e/T
    struct Half {
        double from_lambda, to_lambda;
    };
    constexpr Half first{0.2, 0.14}, second{0.14, 0.12};
    const auto weighed = [](const Half& half, double edge) {
        double sum = 0.0, weights = 0.0;
        for (int k = 0; k < 100000; ++k) {
            const double x = (k + 0.5) / 100000.0 * 0.5;  // of a tick, within its half
            const double to_border = std::min(x, 0.5 - x);
            const double weight = to_border < 0.5 * edge ? to_border / (0.5 * edge) : 1.0;
            sum += weight * std::pow(half.from_lambda + 2.0 * x * (half.to_lambda - half.from_lambda), 2);
            weights += weight;
        }
        return sum / weights;
    };
    const auto mean = [](const Half& half) { return 0.5 * (half.from_lambda + half.to_lambda); };
    for (const RelockMethod method : {RelockMethod::joint, RelockMethod::mean_square}) {
        Configured setup = fine(method);
        setup.gyro.plateau_ratio = 1.0 / (1.0 - q);
        setup.gyro.light_noise = Wavelengths{0.0};
        RelockDriftState state;
        enter_gap(state);
        const Tick tick{.detuning_first_lambda = mean(first),
                        .detuning_second_lambda = mean(second),
                        .detuning_sq_first_lambda2 = weighed(first, 0.0),
                        .detuning_sq_second_lambda2 = weighed(second, 0.0),
                        .temperature_c = not_a_number};
        const double edge = method == RelockMethod::joint ? q : 0.0;
        const double fall = weighed(second, edge) - weighed(first, edge);
        const double found = step(setup, state, tick).tick.value_arcsec;
        EXPECT_NEAR(found / (arcsec_per_lambda2(setup.gyro, setup.gyro.bias) * fall), 1.0, 1e-9);
    }
}

TEST(RelockDrift, EveryMethodFindsTheFalseAngleOfAnExponentialLoop) {
    for (const RelockMethod method : all_methods)
        for (const double dl0 : {0.22, -0.22, 0.05, -0.05})
            for (const double tau_ticks : {1.3, 3.5})
                for (const int sign : {1, -1}) {
                    const ExponentialLoop loop{dl0, tau_ticks};
                    const Configured config = fine(method);
                    RelockDriftState state;
                    enter_gap(state);
                    for (int i = 1; i <= 8; ++i) {
                        const double expected = loop.false_angle_arcsec(config, i, sign);
                        const double found = corrected_arcsec(config, state, loop, i, sign);
                        // A third of a count, for what rounding leaves of it.
                        EXPECT_NEAR(found, expected, 1.0 + 1e-7 * std::fabs(expected)) << dl0 << ' ' << i;
                        // What is left of the counts is the rotation.
                        const Tick tick = loop.tick(config, i, sign, rotation_hz);
                        const auto counts = static_cast<double>(tick.counts_first + tick.counts_second);
                        EXPECT_NEAR(3.263 * (counts - rotation_hz * 0.005), found, 4.0 + 2e-6 * std::fabs(found));
                    }
                }
}

TEST(RelockDrift, FalseAnglesOfConsecutiveSwitchesHaveOppositeSigns) {
    for (const double dl0 : {0.2, -0.2})
        for (const RelockMethod method : all_methods) {
            const ExponentialLoop loop{dl0, 3.5};
            const Configured config = fine(method);
            RelockDriftState state;
            enter_gap(state);
            EXPECT_LT(corrected_arcsec(config, state, loop, 1, 1), 0.0);
            enter_gap(state);
            EXPECT_GT(corrected_arcsec(config, state, loop, 1, -1), 0.0);
        }
}

TEST(RelockDrift, DetuningIsEquation13InItsLongForm) {
    Random random{1};
    const Configured c = fine(RelockMethod::detuning, 60e3);
    for (int trial = 0; trial < 10'000; ++trial) {
        const long double first = random.uniform(-0.3, 0.3);
        const long double rho = random.uniform(0.01, 0.999);
        RelockDriftState state{.armed = true};
        const Tick tick{.sign = 1,
                        .detuning_first_lambda = static_cast<double>(first),
                        .detuning_second_lambda = static_cast<double>(first * rho)};
        const FalseAngle angle = step(c, state, tick).tick;
        const long double tau_by_tick = -1.0L / (2.0L * std::log(rho));
        const long double start = first * std::log(rho) / (rho - 1.0L);
        const long double rate = -3.6L * 60e3L * start * start * 0.5L * tau_by_tick * std::pow(1.0L - rho * rho, 2.0L);
        const double expected = static_cast<double>(3.263L * 0.005L * rate);
        // Near a ratio of 1 the rounding of the second detuning is what counts.
        ASSERT_TRUE(angle.known);
        ASSERT_NEAR(angle.value_arcsec, expected,
                    std::fabs(expected) * (1e-14 + 1e-15 / static_cast<double>(1.0L - rho)));
    }
}

TEST(RelockDrift, MeanSquareIsExactForALoopThatSlews) {
    // dl = 0.22 - 0.0616 t/T until 0.05, then held: no exponential anywhere.
    const auto dl = [](long double t) { return std::fmax(0.22L - 0.0616L * t, 0.05L); };
    const auto integral_of_square = [&](long double from, long double to) {
        const long double knee = (0.22L - 0.05L) / 0.0616L;
        const auto ramp = [&](long double a, long double b) {
            return (dl(a) * dl(a) + dl(a) * dl(b) + dl(b) * dl(b)) * (b - a) / 3.0L;
        };
        if (from < knee && knee < to) return ramp(from, knee) + ramp(knee, to);
        return ramp(from, to);
    };
    const Configured c = fine(RelockMethod::mean_square, 60e3);
    RelockDriftState state{.armed = true};
    for (int i = 1; i <= 5; ++i) {
        const long double first = integral_of_square(i - 1.0L, i - 0.5L);
        const long double second = integral_of_square(i - 0.5L, i);
        const Tick tick{.sign = -1,
                        .detuning_sq_first_lambda2 = static_cast<double>(2.0L * first),
                        .detuning_sq_second_lambda2 = static_cast<double>(2.0L * second)};
        const FalseAngle angle = step(c, state, tick).tick;
        // Counts of bias of the tick: -f0 T integral(1 - chi dl^2) in the first half, the opposite in the second.
        const long double counts = 60e3L * 0.005L * 3.6L * (first - second);
        EXPECT_TRUE(angle.known);
        EXPECT_NEAR(angle.value_arcsec, static_cast<double>(3.263L * counts), 1e-11);
    }
}

// Without a temperature the reference is taken.
TEST(RelockDrift, TemperatureMovesTheBiasByItsLaw) {
    for (const RelockMethod method : all_methods)
        for (const double temperature_c : {-40.0, 20.0, 60.0, not_a_number, infinite}) {
            const ExponentialLoop loop;
            const double above_c = std::isfinite(temperature_c) ? temperature_c - 25.0 : 0.0;
            const Configured warm = fine(method, fine_bias_hz * (1.0 - 5e-4 * above_c));
            Configured config = fine(method);
            config.gyro.temperature_coefficient_per_c = -5e-4;
            config.gyro.reference_temperature = Celsius{25.0};
            RelockDriftState state{.armed = true};
            FalseAngle angle;
            for (int i = 1; i <= 2; ++i) {
                Tick tick = loop.tick(warm, i, 1, 0.0);
                tick.temperature_c = temperature_c;
                angle = step(config, state, tick).tick;
            }
            const double expected = loop.false_angle_arcsec(warm, 2, 1);
            EXPECT_NEAR(angle.value_arcsec, expected, 2e-6 * std::fabs(expected));
        }
}

}  // namespace zlg::core::relock_drift_support::drift_test
