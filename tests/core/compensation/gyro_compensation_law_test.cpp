// Laws of the whole compensation: on logs of a moving gyro that switches, on replayed logs, and on garbage.
#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_law_test {

using namespace gyro_compensation_support;

constexpr RelockMethod all_methods[] = {RelockMethod::none, RelockMethod::frequency, RelockMethod::detuning,
                                        RelockMethod::mean_square, RelockMethod::joint};

GyroCompensationConfig config_of(RelockMethod relock, BridgeMethod bridge = BridgeMethod::quadratic) {
    GyroCompensationConfig config;
    config.relock.method = relock;
    config.bridge.method = bridge;
    return config;
}

// Counts so fine that what is left of a false angle is not hidden by rounding.
GyroCompensationConfig finely_counted(RelockMethod relock, BridgeMethod bridge) {
    GyroCompensationConfig config = config_of(relock, bridge);
    config.gyro.bias = Hertz{1e12};
    config.gyro.scale = Arcsec{3.263 * 60e3 / 1e12};
    return config;
}

// Mean of exp(-t/decay_ticks) over a half that starts at `start` ticks.
double mean_decay(double start, double decay_ticks) {
    return std::exp(-start / decay_ticks) * (1.0 - std::exp(-0.5 / decay_ticks)) * 2.0 * decay_ticks;
}

// A gyro at a constant rate that switches every `interval` ticks; its loop is exponential with tau = 3.5 ticks.
Halves switching_log(const GyroCompensationConfig& config, std::int8_t first_sign, int interval, int n_ticks,
                     double miss, double rotation_arcsec) {
    constexpr int gap = 3;
    Halves halves;
    Recorder recorder{config, first_sign, 1};
    for (int k = 0; k < n_ticks; ++k) {
        const int since = k % interval - gap;  // ticks since the loop was closed
        if (k >= interval && since == -gap) recorder.flip();
        for (int h = 0; h < 2; ++h) {
            const double start = since + 0.5 * h;
            const bool decays = k >= interval && since >= 0;
            HalfRecord half =
                recorder.half(0.5 * rotation_arcsec, decays ? miss * miss * mean_decay(start, 1.75) : 0.0);
            half.detuning_lambda = decays ? miss * mean_decay(start, 3.5) : 0.0;
            half.loop_closed = k < interval || since >= 0;
            halves.push_back(half);
        }
    }
    return halves;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

void expect_same(const AngleRow& a, const AngleRow& b) {
    ASSERT_EQ(a.tick, b.tick);
    ASSERT_EQ(a.flags, b.flags);
    ASSERT_EQ(a.mode, b.mode);
    ASSERT_TRUE(same_bits(a.dtheta_arcsec, b.dtheta_arcsec) &&
                same_bits(a.dtheta_final_arcsec, b.dtheta_final_arcsec) && same_bits(a.sigma_arcsec, b.sigma_arcsec) &&
                same_bits(a.relock_arcsec, b.relock_arcsec));
}

HalfRecord wild_half(Random& random) {
    const auto wild = [&] {
        const double some[] = {not_a_number, infinite, -infinite, 0.0, 0.1, -0.1, 1e308, 5e-324};
        const int pick = random.index(0, 15);
        return pick < 8 ? some[pick] : std::bit_cast<double>(random.bits());
    };
    HalfRecord half;
    half.half = static_cast<std::int64_t>(random.bits());
    half.counts = static_cast<std::int64_t>(random.bits()) >> random.index(0, 63);
    half.detuning_lambda = wild();
    half.detuning_sq_lambda2 = wild();
    half.piezo_v = wild();
    half.temperature_c = wild();
    half.bias_sign = static_cast<std::int8_t>(random.bits());
    half.mode = static_cast<std::int8_t>(random.bits());
    half.loop_closed = random.chance(0.9);
    half.valid = random.chance(0.95);
    return half;
}

// Rows of a thousand ticks of garbage and of the log after them.
Delivered after_garbage(const GyroCompensationConfig& config, std::uint64_t seed, const Halves& halves) {
    Random random{seed};
    Halves all;
    for (int k = 0; k < 2'000; ++k) all.push_back(wild_half(random));
    all.insert(all.end(), halves.begin(), halves.end());
    return run(config, all);
}

TEST(GyroCompensationLaw, EveryMethodGivesTheRotationOfASwitchingGyro) {
    for (const RelockMethod method : {RelockMethod::frequency, RelockMethod::detuning, RelockMethod::mean_square})
        for (const std::int8_t first_sign : {std::int8_t{1}, std::int8_t{-1}})
            for (const double miss : {0.22, -0.22}) {
                const GyroCompensationConfig config = finely_counted(method, BridgeMethod::quadratic);
                const double rotation = 37.2;
                const Delivered got = run(config, switching_log(config, first_sign, 60, 600, miss, rotation));
                for (const AngleRow& row : got.rows) {
                    const bool relock = row.tick >= 60 && row.tick % 60 >= 3 && row.tick % 60 < 23;
                    // Of some 40 arcsec after each switch; what comes after the 20th tick is left as it is.
                    ASSERT_NEAR(row.dtheta_final_arcsec, rotation, relock ? 2e-5 : 5e-4)
                        << "method " << static_cast<int>(method) << " tick " << row.tick;
                    ASSERT_EQ((row.flags & flag_relock_corrected) != 0, relock) << row.tick;
                    ASSERT_EQ((row.flags & flag_relock_uncorrected), 0u) << row.tick;
                }
                ASSERT_EQ(got.gaps.size(), 9u);
                for (std::size_t k = 1; k < got.gaps.size(); ++k)
                    EXPECT_EQ(got.gaps[k].sign_after, -got.gaps[k - 1].sign_after);
                EXPECT_NEAR(got.samples.back().angle_arcsec, 600.0 * rotation, 1e-2);
            }
}

TEST(GyroCompensationLaw, UncorrectedFalseAnglesAlternateAndHaveThePredictedSize) {
    const GyroCompensationConfig config = finely_counted(RelockMethod::none, BridgeMethod::none);
    const Delivered got = run(config, switching_log(config, 1, 60, 600, 0.22, 0.0));
    for (int gap = 1; gap < 10; ++gap) {
        double sum = 0.0;
        for (int k = 3; k < 60; ++k) sum += got.rows[static_cast<unsigned>(60 * gap + k)].dtheta_final_arcsec;
        // Sum over i of -(chi f0 dl0^2 tau/2T) q^(2(i-1)) (1-q)^2, with tau = 3.5 T.
        const double q = std::exp(-1.0 / 3.5);
        const double size = 3.263 * 0.005 * 3.6 * 60e3 * 0.0484 * 1.75 * (1.0 - q) / (1.0 + q);
        EXPECT_NEAR(sum, gap % 2 == 1 ? size : -size, 1e-4) << gap;
    }
}

TEST(GyroCompensationLaw, TheAccumulatedAngleIsTheSumOfWhatWasDelivered) {
    for (const RelockMethod method : all_methods) {
        Random random{1};
        const GyroCompensationConfig config = config_of(method);
        Halves halves = switching_log(config, 1, 40, 50'000, 0.22, 41.7);
        for (HalfRecord& half : halves) half.valid = !random.chance(0.005);
        const Delivered got = run(config, halves);
        Quad sum = 0;
        double worst = 0.0;
        for (const CompensationOutput& out : got.samples) {
            sum += out.sample.dtheta_arcsec;
            worst = std::fmax(worst, static_cast<double>(magnitude(sum - Quad{out.angle_arcsec})));
        }
        EXPECT_LE(worst, 1e-9);
    }
}

TEST(GyroCompensationLaw, AfterGarbageGoodRecordsGiveGoodRowsAgain) {
    for (const RelockMethod method : all_methods) {
        const GyroCompensationConfig config = config_of(method);
        const Halves halves = switching_log(config, 1, 60, 600, 0.22, 32.63);
        const Delivered got = after_garbage(config, 5, halves);
        const Delivered alone = run(config, halves);
        // From the second interval on nothing of the garbage is within reach of any fit. A correction may still pay
        // back what rounding left of it.
        for (std::size_t k = 60; k < 600; ++k) {
            AngleRow row = got.rows[1000 + k];
            row.tick -= 1000;
            if (row.flags & flag_correction) row.dtheta_arcsec = alone.rows[k].dtheta_arcsec;
            expect_same(row, alone.rows[k]);
        }
    }
}

// What learns has learnt of garbage; it must find back to a rate that does not change.
TEST(GyroCompensationLaw, WhatHasLearntOfGarbageFindsBack) {
    for (const RelockMethod method : {RelockMethod::mean_square, RelockMethod::joint}) {
        const GyroCompensationConfig config = config_of(method, BridgeMethod::automatic);
        const Delivered got = after_garbage(config, 6, switching_log(config, 1, 100, 12'000, 0.22, 32.63));
        double worst = 0.0;
        for (std::size_t k = 1'000 + 10'000; k < got.rows.size(); ++k)
            worst = std::fmax(worst, std::fabs(got.rows[k].dtheta_final_arcsec - 32.63));
        EXPECT_LT(worst, 2.0 * 3.263) << static_cast<int>(method);
    }
}

// A mean square of the detuning that is finite, and whose false angle is too, but no sum of such angles.
TEST(GyroCompensationLaw, OneImpossibleDetuningDoesNotSpoilTheRest) {
    GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    config.gyro.light_noise = Wavelengths{0.0};
    Halves clean = switching_log(config, 1, 60, 600, 0.22, 32.63);
    // The tick is the last before another gap, so that the extrapolation multiplies it.
    for (unsigned k = 2 * 67; k < 2 * 83; ++k) clean[k].valid = false;
    for (const double impossible : {1e10, 1e100, 1e300, 1e303, 1.6e303, 1e304, 1e308}) {
        Halves halves = clean;
        halves[2 * 66].detuning_sq_lambda2 = impossible;
        const Delivered got = run(config, halves);
        const Delivered expected = run(config, clean);
        for (std::size_t k = 0; k < 600; ++k) {
            ASSERT_TRUE(std::isfinite(got.rows[k].dtheta_arcsec) && std::isfinite(got.rows[k].dtheta_final_arcsec))
                << impossible << " tick " << k;
            ASSERT_TRUE(std::isfinite(got.samples[k].angle_arcsec)) << impossible << " tick " << k;
            if (k < 120) continue;
            ASSERT_EQ(got.rows[k].dtheta_final_arcsec, expected.rows[k].dtheta_final_arcsec);
        }
    }
}

}  // namespace zlg::core::gyro_compensation_law_test
