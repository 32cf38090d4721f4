#include <zlg/core/compensation/magnetic_drift.hpp>

#include "support.hpp"

namespace zlg::core::magnetic_drift_test {

constexpr double tick_s = 0.05;  // long ticks: fewer of them

MagneticDriftConfig config_of(MagneticMethod method = MagneticMethod::estimate) { return {.method = method}; }

// Of a gyro whose drift may be ten times that of the paper's.
MagneticDriftConfig coarsely_calibrated() {
    MagneticDriftConfig c = config_of();
    c.presumed_sigma_arcsec_s = c.warming_sigma_arcsec_s = 10.0;
    return c;
}

constexpr CompensationConstants constants{
    .tick = Seconds{tick_s}, .scale = Arcsec{0.8}, .random_walk = ArcsecPerRootSecond{0.14}};

TEST(MagneticDrift, WhatIsNoNumberIsRefused) {
    EXPECT_TRUE(is_allowed(config_of()));
    for (const MagneticDriftConfig& bad :
         {MagneticDriftConfig{.method = MagneticMethod::none, .presumed_sigma_arcsec_s = not_a_number},
          MagneticDriftConfig{.presumed_arcsec_s = -1e7}, MagneticDriftConfig{.warming_sigma_arcsec_s = -1.0},
          MagneticDriftConfig{.thermal_time = Seconds{0.0}}})
        EXPECT_FALSE(is_allowed(bad));
}

// A tone has no field in it, however its periods lie to the switches: what is read is 20.06 Hz in whole counts.
TEST(MagneticDrift, OfATonePureNothingIsSubtracted) {
    constexpr CompensationConstants counted{.tick = Seconds{0.005}, .scale = Arcsec{3.263}};
    constexpr double turn = 2.0 * std::numbers::pi * 20.06 * 0.005;  // a tick
    constexpr double amplitude_counts = 12'000.0 / (2.0 * std::numbers::pi * 20.06) / 3.263;
    for (const int interval : {1600, 2000, 4000}) {
        for (int phase = 0; phase < 12; ++phase) {
            MagneticDriftState state;
            const auto reading = [&](int tick) {
                return std::floor(-amplitude_counts * std::cos(turn * tick + phase * std::numbers::pi / 6.0));
            };
            for (int tick = 0; tick < 120'000; ++tick) {
                const MagneticTick read{.measured = tick < interval || tick % interval >= 3,
                                        .mode = static_cast<std::int8_t>(tick / interval % 2 == 0 ? 1 : -1),
                                        .angle_arcsec = 3.263 * (reading(tick + 1) - reading(tick))};
                ASSERT_EQ(step(counted, config_of(), state, read), 0.0) << interval << " " << phase << " " << tick;
            }
        }
    }
}

// A gyro that switches every `interval_s`, the first time after half of that, on a base that moves.
struct Gyro {
    double interval_s = 45.0;
    std::function<double(double)> drift_arcsec_s = [](double) { return 0.7; };
    std::function<double(double)> base_arcsec_s = [](double) { return 0.05; };
    double walk_arcsec_sqrt_s = 0.14;
};

struct Outcome {
    MagneticDriftState state;
    double magnetic_arcsec = 0.0;  // in the measured ticks
    double subtracted_arcsec = 0.0;
    double worst_left_arcsec = 0.0;  // in the second half of the run
    double worst_without_arcsec = 0.0;
};

Outcome run(const Gyro& gyro, const MagneticDriftConfig& config, double length_s, std::uint64_t seed = 1) {
    std::mt19937_64 random{seed};
    std::normal_distribution<> normal;
    Outcome out;
    int gap = 0;
    std::int8_t mode = 1;
    double next_s = gyro.interval_s / 2.0;
    for (std::int64_t k = 0; static_cast<double>(k) * tick_s < length_s; ++k) {
        const double t_s = (static_cast<double>(k) + 0.5) * tick_s;
        if (t_s > next_s) {
            next_s += gyro.interval_s;
            mode = static_cast<std::int8_t>(-mode);
            gap = 3;
        }
        const double magnetic = mode * gyro.drift_arcsec_s(t_s) * tick_s;
        const double walk = gyro.walk_arcsec_sqrt_s * std::sqrt(tick_s) * normal(random);
        const bool measured = gap == 0;
        out.subtracted_arcsec +=
            step(constants, config, out.state, {measured, mode, gyro.base_arcsec_s(t_s) * tick_s + magnetic + walk});
        if (measured) out.magnetic_arcsec += magnetic;
        if (gap > 0) --gap;
        if (t_s < length_s / 2.0) continue;
        out.worst_without_arcsec = std::max(out.worst_without_arcsec, std::abs(out.magnetic_arcsec));
        out.worst_left_arcsec = std::max(out.worst_left_arcsec, std::abs(out.magnetic_arcsec - out.subtracted_arcsec));
    }
    return out;
}

TEST(MagneticDrift, AtRestTheDriftIsFoundAndItsSawtoothGone) {
    for (const double drift : {0.7, -0.7, 14.0}) {
        const Gyro gyro{.drift_arcsec_s = [=](double) { return drift; }};
        const Outcome got = run(gyro, coarsely_calibrated(), 3600.0);
        EXPECT_NEAR(got.state.estimate[of_drift], drift, 0.03);
        EXPECT_LT(std::sqrt(got.state.covariance[of_drift][of_drift]), 0.05);
        // The sawtooth alone: 0.7 arcsec/s for 22.5 s.
        EXPECT_LT(got.worst_left_arcsec, 0.1 * std::abs(drift) * 22.5);
    }
}

TEST(MagneticDrift, TheErrorOfTheStartDoesNotStayInTheAngle) {
    // A full first segment: without the correction of the past half a sawtooth, 15.75 arcsec, would stay for ever.
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Outcome got = run({}, config_of(), 1800.0 + 22.5, seed);
        sum += std::abs(got.magnetic_arcsec - got.subtracted_arcsec);
    }
    EXPECT_LT(sum / 4.0, 0.1 * 15.75);
}

TEST(MagneticDrift, AWarmingGyroIsFollowed) {
    const Gyro gyro{.interval_s = 90.0,
                    .drift_arcsec_s = [](double t) { return 0.7 + 14.0 * (1.0 - std::exp(-t / 3000.0)); }};
    const Outcome got = run(gyro, coarsely_calibrated(), 3600.0);
    EXPECT_NEAR(got.state.estimate[of_drift], 0.7 + 14.0 * (1.0 - std::exp(-1.2)), 0.1);
    EXPECT_NEAR(got.state.estimate[of_trend], 14.0 / 3000.0 * std::exp(-1.2), 5e-4);
    EXPECT_LT(got.worst_left_arcsec, 0.05 * got.worst_without_arcsec);
}

TEST(MagneticDrift, AWarmingThatIsOverSoonIsFollowedToo) {
    // All that is presumed is true: the angle is that of the law itself, 0.7 + 2 (1 - exp(-t/tau)), in one mode.
    for (const double tau_s : {0.2, 3.0, 60.0, 3000.0}) {
        MagneticDriftConfig config = config_of();
        config.presumed_arcsec_s = 0.7;
        config.warming_arcsec_s = 2.0;
        config.presumed_sigma_arcsec_s = config.warming_sigma_arcsec_s = 1e-9;
        config.thermal_time = Seconds{tau_s};
        MagneticDriftState state;
        constexpr int n_ticks = 1 + 11 * 1024;  // predictions come with the first one, and every 1024
        for (int k = 0; k < n_ticks; ++k) EXPECT_TRUE(std::isfinite(step(constants, config, state, {true, 1, 0.0})));
        const double end_s = n_ticks * tick_s;
        const double expected = 2.7 * end_s - 2.0 * tau_s * (1.0 - std::exp(-end_s / tau_s));
        EXPECT_NEAR(state.estimate[of_angle], expected, 1e-9 * expected) << tau_s;
        EXPECT_NEAR(state.estimate[of_drift], 2.7 - 2.0 * std::exp(-end_s / tau_s), 1e-9) << tau_s;
    }
}

TEST(MagneticDrift, SteadyRotationAndVibrationAreNoDrift) {
    const auto base = [](double t) { return 15.0 + 12000.0 * std::sin(2.0 * std::numbers::pi * 3.03 * t); };
    const Outcome got = run({.base_arcsec_s = base}, config_of(), 3600.0);
    EXPECT_NEAR(got.state.estimate[of_drift], 0.7, 0.03);
    const double base_sigma = std::sqrt(got.state.covariance[of_base][of_base]);
    EXPECT_LT(base_sigma, 0.05);
    EXPECT_NEAR(got.state.estimate[of_base], 15.0, 2.0 * base_sigma);
    EXPECT_GT(got.state.trust, 0.95);
}

TEST(MagneticDrift, ItStandsBackWhereTheBaseMoves) {
    const auto sways = {std::pair{10.0, 0.05},         std::pair{10.0, 0.011},       std::pair{0.5, 1.0 / 90.0},
                        std::pair{10.0, 1.0 / 90.0},   std::pair{25.0, 1.0 / 90.0},  std::pair{100.0, 1.0 / 90.0},
                        std::pair{1000.0, 1.0 / 90.0}, std::pair{25.0, 1.01 / 90.0}, std::pair{10.0, 0.003},
                        std::pair{100.0, 0.02}};
    for (const auto& [amplitude, frequency_hz] : sways)
        for (const double phase : {0.0, 1.0, 2.0, 3.0}) {
            const auto base = [amplitude = amplitude, frequency_hz = frequency_hz, phase](double t) {
                return amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * t + phase);
            };
            const Outcome got = run({.base_arcsec_s = base}, config_of(), 3600.0);
            EXPECT_LE(got.worst_left_arcsec, 1.05 * got.worst_without_arcsec)
                << amplitude << " arcsec/s at " << frequency_hz << " Hz";
        }
}

// Turns its sign at the middle of every gap but the first half interval: the times of the switches of `Gyro`.
double square_wave(double amplitude, double interval_s, double late_s, double t_s) {
    const auto n = static_cast<std::int64_t>(std::floor((t_s - late_s) / interval_s + 0.5));
    return n % 2 == 0 ? amplitude : -amplitude;
}

TEST(MagneticDrift, ARotationThatJumpsWithTheSwitchesIsBoundedByWhatIsPresumed) {
    for (const double interval_s : {20.0, 45.0, 150.0})
        for (const double amplitude : {-1000.0, -30.0, -5.0, -2.0, 0.5, 2.0, 5.0, 30.0, 1000.0}) {
            const auto base = [=](double t) { return square_wave(amplitude, interval_s, 0.0, t); };
            const Outcome got = run({.interval_s = interval_s, .base_arcsec_s = base}, config_of(), 3600.0);
            // Three standard deviations of 1 and of 0.7 by warming, and of the random walk.
            const bool within = std::abs(0.7 + amplitude) < 3.0 * std::sqrt(1.0 + 0.7 * 0.7 + 0.04);
            if (!within) {
                EXPECT_LE(got.worst_left_arcsec, 1.05 * got.worst_without_arcsec) << amplitude;
            }
        }
}

TEST(MagneticDrift, ACalibrationThatIsContradictedIsNotOverruled) {
    // Whether the calibration is wrong or the base moves in step, is not known.
    MagneticDriftConfig c = config_of();
    c.presumed_arcsec_s = -2.0;
    c.presumed_sigma_arcsec_s = c.warming_sigma_arcsec_s = 0.05;
    const Outcome got = run({}, c, 3600.0);
    EXPECT_EQ(got.state.trust, 0.0);
    EXPECT_LE(got.worst_left_arcsec, 1.01 * got.worst_without_arcsec);
    // One that is right bounds a rotation in step to what it leaves open.
    c.presumed_arcsec_s = 0.7;
    const auto base = [=](double t) { return square_wave(2.0, 45.0, 0.0, t); };
    const Outcome in_step = run({.base_arcsec_s = base}, c, 3600.0);
    EXPECT_EQ(in_step.state.trust, 0.0);
}

TEST(MagneticDrift, ATurnDoesNotShakeWhatIsKnown) {
    const auto base = [](double t) { return t > 2000.0 && t < 2010.0 ? 9.0 * 3600.0 : 0.05; };
    const Outcome got = run({.base_arcsec_s = base}, config_of(), 3600.0);
    EXPECT_NEAR(got.state.estimate[of_drift], 0.7, 0.05);
    EXPECT_LT(got.worst_left_arcsec, 3.0);
}

TEST(MagneticDrift, ACalibrationActsAtOnceAndIsCorrected) {
    MagneticDriftConfig c = config_of();
    c.presumed_arcsec_s = 0.6;
    c.presumed_sigma_arcsec_s = 0.05;
    c.warming_sigma_arcsec_s = 0.0;
    MagneticDriftState s;
    // 1 - 16 (0.05/0.6)^2 of it.
    EXPECT_NEAR(step(constants, c, s, {true, 1, 0.0}), (1.0 - 16.0 / 144.0) * 0.6 * tick_s, 1e-6);
    for (int k = 1; k < 1024; ++k) (void)step(constants, c, s, {true, 1, 0.0});
    EXPECT_NEAR(s.trust, 1.0 - 16.0 / 144.0, 1e-3);
    EXPECT_NEAR(run({}, c, 1800.0).state.estimate[of_drift], 0.7, 0.03);
}

TEST(MagneticDrift, WatchingLearnsTheSameAndLeavesTheAngleAlone) {
    const Outcome watching = run({}, config_of(MagneticMethod::watch), 1800.0);
    const Outcome acting = run({}, config_of(), 1800.0);
    EXPECT_EQ(watching.subtracted_arcsec, 0.0);
    EXPECT_EQ(watching.state.estimate, acting.state.estimate);
    EXPECT_NEAR(remaining_arcsec_s(config_of(MagneticMethod::watch), watching.state), 0.7, 0.05);
    EXPECT_LT(remaining_arcsec_s(config_of(), acting.state), 0.1);
    EXPECT_EQ(remaining_arcsec_s(config_of(), {}), 0.0);
}

TEST(MagneticDrift, ItsSigmaIsTrue) {
    double squares = 0.0;
    constexpr int n = 40;
    for (std::uint64_t seed = 1; seed <= n; ++seed) {
        const Outcome got = run({}, config_of(), 900.0, seed);
        const double error = got.state.estimate[of_drift] - 0.7;
        squares += error * error / got.state.covariance[of_drift][of_drift];
    }
    // On the safe side: the scatter of a base that does not move is known to be small only after many segments.
    EXPECT_LT(squares / n, 1.3);
    EXPECT_GT(squares / n, 0.005);
}

TEST(MagneticDrift, NothingThatIsReadMakesTheStateNotFinite) {
    std::mt19937_64 random{5};
    const double values[] = {0.0, not_a_number, std::numeric_limits<double>::infinity(), -1e300, 1e6, -4e5,
                             3.0, 1e-300};
    MagneticDriftState s;
    for (int k = 0; k < 400000; ++k) {
        const auto kind = random();
        const bool wild = kind % 997 == 0 || (k / 50000) % 2 == 1;
        const double angle = wild ? values[random() % std::size(values)] : 0.01;
        const auto mode = static_cast<std::int8_t>(k / 500 % 2 == 0 ? 1 : -1);
        ASSERT_TRUE(std::isfinite(step(constants, config_of(), s, {k % 500 > 3, mode, angle})));
        for (const double x : s.estimate) ASSERT_TRUE(std::isfinite(x));
        for (unsigned i = 0; i < magnetic_states; ++i) {
            ASSERT_GE(s.covariance[i][i], 0.0) << k;
            for (const double x : s.covariance[i]) ASSERT_TRUE(std::isfinite(x));
        }
        ASSERT_TRUE(std::isfinite(s.scatter_arcsec_s));
        ASSERT_TRUE(std::isfinite(s.trust) && s.trust >= 0.0 && s.trust <= 1.0);
    }
}

// Of an angle that comes evenly, a leap of n ticks is n steps.
TEST(MagneticDrift, ALeapIsSoManySteps) {
    MagneticDriftState lived, leapt;
    const auto live = [&](MagneticDriftState& state, int ticks, std::int8_t mode, double arcsec) {
        double sum = 0.0;
        for (int k = 0; k < ticks; ++k)
            sum += step(constants, config_of(), state, {.measured = mode != 0, .mode = mode, .angle_arcsec = arcsec});
        return sum;
    };
    std::int8_t mode = 1;
    for (int segment = 0; segment < 8; ++segment, mode = static_cast<std::int8_t>(-mode)) {
        const double tick_arcsec = tick_s * (0.2 + mode * (0.9 + 0.02 * segment));
        for (MagneticDriftState* state : {&lived, &leapt}) live(*state, 40, mode, tick_arcsec);
        for (const int ticks : {1, 700, 1023, 1024, 1025, 3000}) {
            const double steps = live(lived, ticks, mode, tick_arcsec);
            EXPECT_NEAR(leap(constants, config_of(), leapt, ticks, ticks * tick_arcsec), steps,
                        1e-9 + 1e-6 * std::abs(steps));
        }
        for (MagneticDriftState* state : {&lived, &leapt}) live(*state, 3, 0, 0.0);
    }
    EXPECT_GT(lived.trust, 0.5);
    EXPECT_NEAR(leapt.trust, lived.trust, 1e-6);
    for (unsigned i = 0; i < magnetic_parts; ++i)
        EXPECT_NEAR(leapt.estimate[i], lived.estimate[i], 1e-7 * (1.0 + std::abs(lived.estimate[i])));
    EXPECT_NEAR(leapt.subtracted_arcsec, lived.subtracted_arcsec, 1e-6);
}

}  // namespace zlg::core::magnetic_drift_test
