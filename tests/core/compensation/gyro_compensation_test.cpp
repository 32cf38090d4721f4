#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_test {

using namespace gyro_compensation_support;

constexpr double scale_arcsec = 3.263;
constexpr std::int64_t bias_counts = 150;  // 60 kHz over half a tick

bool has(std::uint32_t flags, AngleFlag flag) { return (flags & flag) != 0; }

GyroCompensationConfig config_of(RelockMethod relock, BridgeMethod bridge = BridgeMethod::quadratic) {
    GyroCompensationConfig config;
    config.relock.method = relock;
    config.bridge.method = bridge;
    return config;
}

// `rotation` counts a tick.
Halves plain_log(int n_ticks, std::int64_t rotation = 18) { return biased_halves(2 * n_ticks, rotation / 2); }

void open_loop(Halves& halves, int first_tick, int n_ticks) {
    for (int k = 2 * first_tick; k < 2 * (first_tick + n_ticks); ++k)
        halves[static_cast<unsigned>(k)].loop_closed = false;
}

Halves log_with_gap(int n_ticks) {
    Halves halves = plain_log(n_ticks);
    open_loop(halves, 10, 3);
    return halves;
}

TEST(GyroCompensation, TwoHalvesMakeATickAndTheBiasCancels) {
    for (const int first_sign : {1, -1})
        for (const int mode : {1, -1}) {
            Random random{1};
            Halves halves;
            std::int64_t expected[50];
            for (int k = 0; k < 100; ++k) {
                const auto sign = static_cast<std::int8_t>(k % 2 == 0 ? first_sign : -first_sign);
                const std::int64_t rotation = random.integer(-40, 40);
                std::int64_t& counts = expected[k / 2];
                counts = k % 2 == 0 ? rotation : counts + rotation;
                HalfRecord half{.half = k, .counts = rotation + sign * mode * bias_counts};
                half.bias_sign = sign;
                half.mode = static_cast<std::int8_t>(mode);
                halves.push_back(half);
            }
            const Delivered got = run(config_of(RelockMethod::none), halves);
            ASSERT_EQ(got.samples.size(), 50u);
            ASSERT_EQ(got.rows.size(), 50u);
            for (unsigned j = 0; j < 50; ++j) {
                const double angle = scale_arcsec * static_cast<double>(expected[j]);
                EXPECT_EQ(got.samples[j].sample.tick, static_cast<std::int64_t>(j));
                EXPECT_EQ(got.samples[j].sample.dtheta_arcsec, angle);
                EXPECT_EQ(got.rows[j].dtheta_final_arcsec, angle);
                EXPECT_EQ(got.rows[j].mode, mode);
                EXPECT_EQ(got.rows[j].flags, 0u);
            }
        }
}

TEST(GyroCompensation, AnOddLastHalfIsDropped) {
    Halves halves = plain_log(30);
    const Delivered even = run(config_of(RelockMethod::frequency), halves);
    halves.push_back(halves.front());
    const Delivered odd = run(config_of(RelockMethod::frequency), halves);
    EXPECT_EQ(odd.rows, even.rows);
    EXPECT_EQ(odd.samples.size(), 30u);
}

TEST(GyroCompensation, AnOpenLoopOrAnInvalidHalfMakesAGap) {
    for (const unsigned half : {20u, 21u})
        for (const bool loop : {true, false}) {
            Halves halves = plain_log(40);
            (loop ? halves[half].loop_closed : halves[half].valid) = false;
            halves[half].counts = 123'456;
            const Delivered got = run(config_of(RelockMethod::none), halves);
            for (unsigned k = 0; k < 40; ++k) {
                EXPECT_NEAR(got.rows[k].dtheta_final_arcsec, scale_arcsec * 18.0, 1e-10);
                EXPECT_EQ(has(got.rows[k].flags, flag_loop_unlocked), k == 10 && loop);
                EXPECT_EQ(has(got.rows[k].flags, flag_invalid), k == 10 && !loop);
                EXPECT_EQ(has(got.rows[k].flags, flag_interpolated), k == 10);
                EXPECT_FALSE(has(got.rows[k].flags, flag_switching));
            }
            EXPECT_EQ(got.gaps.size(), 1u);
        }
}

// Also where the helicity changes within a tick of the gap: it is said in that tick.
TEST(GyroCompensation, ASwitchIsSaidAndReported) {
    for (const std::size_t first : {22u, 23u}) {
        Halves halves = log_with_gap(40);
        for (std::size_t k = first; k < halves.size(); ++k) halves[k].mode = -1;
        const Delivered got = run(config_of(RelockMethod::none), halves);
        for (unsigned k = 0; k < 40; ++k) {
            EXPECT_EQ(has(got.rows[k].flags, flag_switching), k == 11 || k == 12) << k;
            EXPECT_EQ(got.rows[k].mode, k < 11 ? 1 : -1);
        }
        ASSERT_EQ(got.gaps.size(), 1u);
        EXPECT_EQ(got.gaps[0].first_tick, 10);
        EXPECT_EQ(got.gaps[0].n_ticks, 3);
        EXPECT_TRUE(got.gaps[0].mode_changed);
        EXPECT_EQ(got.gaps[0].mode_after, -1);
        EXPECT_EQ(got.gaps[0].sign_after, -1);
    }
}

TEST(GyroCompensation, ATickWhoseHalvesDifferInHelicityIsOfUnknownSigma) {
    Halves halves = plain_log(40);
    for (std::size_t k = 21; k < halves.size(); ++k) halves[k].mode = -1;
    const Delivered got = run(config_of(RelockMethod::none), halves);
    for (unsigned k = 0; k < 40; ++k) {
        EXPECT_EQ(has(got.rows[k].flags, flag_mode_mixed), k == 10);
        EXPECT_EQ(std::isinf(got.rows[k].sigma_arcsec), k == 10);
    }
    EXPECT_TRUE(got.gaps.empty());
}

TEST(GyroCompensation, CountsBeyondBeliefAreAGap) {
    constexpr std::int64_t limit = std::int64_t{1} << 52;
    for (const std::int64_t wild :
         {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(), limit + 1, -limit - 1})
        for (const unsigned half : {20u, 21u}) {
            Halves halves = plain_log(40);
            halves[half].counts = wild;
            const Delivered got = run(config_of(RelockMethod::frequency), halves);
            for (unsigned k = 0; k < 40; ++k) {
                EXPECT_EQ(has(got.rows[k].flags, flag_invalid), k == 10);
                EXPECT_NEAR(got.rows[k].dtheta_final_arcsec, scale_arcsec * 18.0, 1e-10);
            }
            EXPECT_NEAR(got.samples.back().angle_arcsec, 40.0 * 18.0 * scale_arcsec, 1e-9);
        }
    Halves halves = plain_log(40);
    halves[20].counts = limit;
    halves[21].counts = -limit;
    EXPECT_EQ(run(config_of(RelockMethod::none), halves).rows[10].dtheta_final_arcsec, 0.0);
}

TEST(GyroCompensation, WithoutDetuningTheTicksToBeCorrectedSaySo) {
    for (const auto method : {RelockMethod::detuning, RelockMethod::mean_square}) {
        Halves halves = log_with_gap(60);
        const Delivered got = run(config_of(method), halves);
        for (unsigned k = 0; k < 60; ++k) {
            EXPECT_EQ(has(got.rows[k].flags, flag_relock_uncorrected), k >= 13 && k < 33) << k;
            EXPECT_FALSE(has(got.rows[k].flags, flag_relock_corrected));
            EXPECT_NEAR(got.rows[k].dtheta_final_arcsec, scale_arcsec * 18.0, 1e-10);
        }
    }
}

TEST(GyroCompensation, TickOneOfFrequencyWithoutATickTwoIsNotCorrected) {
    // Deficits of 2000, 1200 and 800 Hz: five, three and two counts a half.
    for (const int second_gap : {14, 100}) {
        Halves halves = log_with_gap(second_gap == 14 ? 40 : 14);
        if (second_gap == 14) open_loop(halves, 14, 2);
        halves[26].counts -= 5;
        halves[27].counts += 5;
        const Delivered got = run(config_of(RelockMethod::frequency), halves);
        EXPECT_TRUE(has(got.rows[13].flags, flag_relock_uncorrected)) << second_gap;
        EXPECT_FALSE(has(got.rows[13].flags, flag_relock_corrected));
        EXPECT_EQ(got.rows[13].dtheta_final_arcsec, scale_arcsec * 18.0);
        EXPECT_EQ(got.rows[13].relock_arcsec, 0.0);
    }
}

TEST(GyroCompensation, TickOneOfFrequencyIsCorrectedInItsRowAndPaidBackByTheLump) {
    for (const std::int64_t ticks : {1, 20}) {
        GyroCompensationConfig config = config_of(RelockMethod::frequency);
        config.relock.ticks = ticks;
        Halves halves = log_with_gap(40);
        for (const auto& [tick, lost] : {std::pair{13u, 10}, {14u, 5}}) {
            halves[2 * tick].counts -= lost;
            halves[2 * tick + 1].counts += lost;
        }
        const Delivered got = run(config, halves);
        const double q = std::sqrt(0.5);
        const double first = -scale_arcsec * 20.0 * (1.0 - q) / (1.0 + q);
        const double second = ticks == 1 ? 0.0 : 0.5 * first;
        const double rotation = scale_arcsec * 18.0;
        EXPECT_TRUE(has(got.rows[13].flags, flag_relock_corrected));
        EXPECT_FALSE(has(got.rows[13].flags, flag_relock_uncorrected));
        EXPECT_NEAR(got.rows[13].relock_arcsec, first, 1e-10);
        EXPECT_NEAR(got.rows[13].dtheta_final_arcsec, rotation - first, 1e-10);
        EXPECT_EQ(got.rows[13].dtheta_arcsec, rotation);
        EXPECT_EQ(has(got.rows[14].flags, flag_relock_corrected), ticks > 1);
        EXPECT_NEAR(got.rows[14].dtheta_final_arcsec, rotation - second, 1e-10);
        double delivered = 0.0;
        double final_sum = 0.0;
        for (unsigned k = 0; k <= 15; ++k) {
            delivered += got.rows[k].dtheta_arcsec;
            final_sum += got.rows[k].dtheta_final_arcsec;
        }
        EXPECT_NEAR(delivered, final_sum, 1e-9);
    }
}

TEST(GyroCompensation, CountsOfAGapNeverEnterTheAngle) {
    Halves halves = log_with_gap(40);
    for (unsigned k = 20; k < 26; ++k) halves[k].counts = 1'000'000'007;
    GyroCompensationState state;
    for (const HalfRecord& half : halves) (void)step(config_of(RelockMethod::none), state, half);
    EXPECT_EQ(state.angle.counts, 37 * 18);
    EXPECT_NEAR(state.angle.remainder_arcsec.value(), 3 * 18 * scale_arcsec, 1e-10);
}

// Detunings of 0.2 and 0.1 in the first tick after a gap, at a temperature that is known for its middle only.
TEST(GyroCompensation, TheCorrectionTakesTheTemperatureOfTheMiddleAndAddsItsVariance) {
    GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    config.gyro.temperature_coefficient_per_c = -1e-3;
    Halves halves = log_with_gap(40);
    halves[26].detuning_sq_lambda2 = 0.04;
    halves[27].detuning_sq_lambda2 = 0.01;
    halves[26].temperature_c = 50.0;
    halves[27].temperature_c = -50.0;
    const AngleRow row = run(config, halves).rows[13];
    const double arcsec_by_square = scale_arcsec * 0.005 * 0.5 * 3.6 * 60e3 * (1.0 - 0.03);
    EXPECT_NEAR(row.relock_arcsec, -0.03 * arcsec_by_square, 1e-10);
    EXPECT_NEAR(row.dtheta_final_arcsec, 18.0 * scale_arcsec + 0.03 * arcsec_by_square, 1e-10);
    // Both means hold the variance s^2 of a sample; 16 samples a half.
    const double s2 = 0.0033 * 0.0033;
    const double variance_of_squares = (4.0 * (0.05 - 2.0 * s2) * s2 + 4.0 * s2 * s2) / 16.0;
    const double variance = scale_arcsec * scale_arcsec / 6.0 + 0.14 * 0.14 * 0.005 +
                            arcsec_by_square * arcsec_by_square * variance_of_squares;
    EXPECT_NEAR(row.sigma_arcsec, std::sqrt(variance), 1e-10);
}

TEST(GyroCompensation, CheckPassesOnWhatItsPartsRefuse) {
    EXPECT_EQ(check(GyroCompensationConfig{}), GyroCompensationFault::none);
    GyroCompensationConfig config;
    config.gyro.chi = not_a_number;
    EXPECT_EQ(check(config), GyroCompensationFault::relock);
    config = {};
    config.bridge.points_after = 0;
    EXPECT_EQ(check(config), GyroCompensationFault::bridge);
    for (const double bad : {-0.1, not_a_number, infinite}) {
        config = {};
        config.gyro.random_walk = ArcsecPerRootSecond{bad};
        EXPECT_EQ(check(config), GyroCompensationFault::random_walk);
    }
    config.gyro.random_walk = ArcsecPerRootSecond{0.0};
    EXPECT_EQ(check(config), GyroCompensationFault::none);
    config.gyro.timer = Hertz{0.0};
    EXPECT_EQ(check(config), GyroCompensationFault::edges);
    config = {};
    config.gyro.plateau_ratio = 3.0;
    EXPECT_EQ(check(config), GyroCompensationFault::edges);
    EXPECT_EQ(check({.relock = {.ticks = 0}}), GyroCompensationFault::none);
    EXPECT_EQ(check({.relock = {.ticks = -1}}), GyroCompensationFault::relock);
}

}  // namespace zlg::core::gyro_compensation_test
