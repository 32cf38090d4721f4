// Halves of a gap that were lit: what is read of them, and which are refused.

#include <zlg/core/compensation/lit_halves.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace lit_halves_test {

using namespace zlg::core;

constexpr double bias_counts = 150.0;  // 60 kHz, half of 5 ms
constexpr double scale = 3.263;
constexpr double motion_arcsec2 = 4.0;

// Ten ticks of a steady rate: a gap of five, of which the halves from the fourth on are lit, and five after it.
struct Scene {
    CompensationConstants gyro{};
    std::vector<HalfRecord> halves;

    Scene() {
        for (int h = 0; h < 20; ++h) {
            HalfRecord r;
            r.half = h;
            r.bias_sign = h % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
            r.loop_closed = h >= 10;
            r.lit = h >= 3;
            r.detuning_lambda = h < 10 ? 0.2 : 0.0;
            const double true_sq = r.detuning_lambda * r.detuning_lambda;
            r.detuning_sq_lambda2 = true_sq + 0.0033 * 0.0033;
            r.counts = std::llround(7.0 + r.bias_sign * bias_counts * (1.0 - 3.6 * true_sq));
            r.temperature_c = 20.0;
            halves.push_back(r);
        }
    }

    LitHalvesState run(double drift_arcsec = 0.0, double motion = motion_arcsec2, bool with_phase = false) const {
        LitHalvesState state;
        for (std::size_t t = 0; t <= 5; ++t) {
            const LitTick tick{.first = halves[2 * t],
                               .second = halves[2 * t + 1],
                               .tick = static_cast<std::int64_t>(t),
                               .bias_arcsec = scale * bias_counts,
                               .with_phase = with_phase};
            if (t < 5)
                add_gap_tick(gyro, state, tick, t == 0, motion);
            else
                end_gap(gyro, state, tick, motion, drift_arcsec);
        }
        return state;
    }
};

TEST(LitHalves, HaveTheirReadingAndTheFalseAngleOfTheirDetuning) {
    const LitHalvesState state = Scene{}.run();
    EXPECT_EQ(state.end_tick, 5);
    ASSERT_EQ(state.n, 7);
    const double unit = 3.6 * 60e3 * scale * 0.0025;
    for (int k = 0; k < 7; ++k) {
        const LitHalf& half = state.half[static_cast<unsigned>(k)];
        const int sign = (k + 3) % 2 == 0 ? 1 : -1;
        const double d = unit * 0.04;
        EXPECT_NEAR(half.correction_arcsec, sign * d, 1e-9);
        // 128.4 counts of bias, read as whole ones.
        EXPECT_NEAR(half.value_arcsec, scale * (std::round(7.0 + sign * 128.4) - sign * bias_counts), 1e-9);
        const double noise_sq = 0.0033 * 0.0033;
        EXPECT_NEAR(half.variance_arcsec2, unit * unit * (4.0 * 0.04 * noise_sq + 2.0 * noise_sq * noise_sq) / 16.0,
                    1e-12);
        EXPECT_NEAR(half.common_arcsec, sign * std::hypot(0.015 * d, unit * 2.0 * 0.2 * 0.002), 1e-9);
    }
}

// Detunings that the control has read through a curve have the noise that the curve has made larger.
TEST(LitHalves, TheNoiseIsThatBehindTheCurveOfTheControl) {
    Scene curved;
    curved.gyro.control_curve = discriminator_curve(std::vector{0.25}, std::vector{0.5});
    Scene noisy;
    noisy.gyro.light_noise = Wavelengths{2.0 * curved.gyro.light_noise.value()};
    ASSERT_EQ(curved.run().n, 7);
    for (unsigned k = 0; k < 7; ++k) {
        EXPECT_DOUBLE_EQ(curved.run().half[k].variance_arcsec2, noisy.run().half[k].variance_arcsec2);
        EXPECT_DOUBLE_EQ(curved.run().half[k].correction_arcsec, noisy.run().half[k].correction_arcsec);
    }
}

TEST(LitHalves, HalfOfTheDriftOfATickIsSubtracted) {
    const LitHalvesState plain = Scene{}.run();
    const LitHalvesState less = Scene{}.run(0.5);
    for (unsigned k = 0; k < 7; ++k) EXPECT_DOUBLE_EQ(less.half[k].value_arcsec, plain.half[k].value_arcsec - 0.25);
}

TEST(LitHalves, OnlyThoseThatReachTheEndOfTheGapAreUsed) {
    const std::vector<std::function<void(HalfRecord&)>> damages{
        [](HalfRecord& h) { h.lit = false; },
        [](HalfRecord& h) { h.valid = false; },
        [](HalfRecord& h) { h.span = 2; },
        [](HalfRecord& h) { h.loop_closed = true; },
        [](HalfRecord& h) { h.detuning_sq_lambda2 = 0.0; },
        [](HalfRecord& h) { h.detuning_sq_lambda2 = std::nan(""); },
    };
    for (const auto& damage : damages) {
        Scene scene;
        damage(scene.halves[5]);
        EXPECT_EQ(scene.run().n, 4);
    }
    // A shifted reversal changes the length of the halves on both of its sides.
    Scene shifted;
    shifted.halves[5].edge_offset_ticks = 20;
    EXPECT_EQ(shifted.run().n, 3);
    Scene dark_at_last;
    dark_at_last.halves[9].lit = false;
    EXPECT_EQ(dark_at_last.run().n, 0);
    Scene other_mode;
    for (std::size_t h = 0; h < 6; ++h) other_mode.halves[h].mode = -1;
    EXPECT_EQ(other_mode.run().n, 4);
    EXPECT_EQ(Scene{}.run(0.0, motion_arcsec2, true).n, 0);  // by phase, of which there is none
}

// Good halves of the other mode, whose bias has the other sign, are of the angle before the switch.
TEST(LitHalves, ThoseOfAnotherModeAreNotUsed) {
    Scene scene;
    for (std::size_t h = 0; h < 6; ++h) {
        HalfRecord& r = scene.halves[h];
        r.mode = -1;
        r.counts = 14 - r.counts;
    }
    EXPECT_EQ(scene.run().n, 4);
}

// By phase all from the fourth on are read to parts of a count, but the fourth begins in the dark: it is the first half of the
// row until the end of the gap, and no point then.
TEST(LitHalves, ByPhaseTheOneThatComesOutOfTheDarkIsNoPoint) {
    Scene scene;
    for (std::size_t h = 3; h < 20; ++h) scene.halves[h].fringe = 1000.0f;
    LitHalvesState state;
    Border start;
    for (std::size_t t = 0; t <= 5; ++t) {
        const LitTick tick{.first = scene.halves[2 * t],
                           .second = scene.halves[2 * t + 1],
                           .start = start,
                           .tick = static_cast<std::int64_t>(t),
                           .bias_arcsec = scale * bias_counts,
                           .with_phase = true};
        start = border_of(tick.second);
        if (t < 5)
            add_gap_tick(scene.gyro, state, tick, t == 0, motion_arcsec2);
        else
            end_gap(scene.gyro, state, tick, motion_arcsec2, 0.0);
        EXPECT_EQ(state.n, t == 0 ? 0 : t < 5 ? static_cast<int>(2 * t - 1) : 6) << t;
    }
    EXPECT_EQ(state.half[0].value_arcsec, state.half[2].value_arcsec);
}

TEST(LitHalves, CountsThatContradictTheirNeighboursAreRefusedWithAllBefore) {
    for (std::size_t bad = 3; bad < 10; ++bad) {
        Scene scene;
        scene.halves[bad].counts += 30;  // 98 arcsec
        EXPECT_EQ(scene.run().n, static_cast<int>(9 - bad)) << bad;
    }
}

// What neither the motion nor the tolerance tells from it is not seen: three counts are 9.8 arcsec, 2 % of the bias.
TEST(LitHalves, WhatIsLessThanAPartOfTheBiasIsNotSeen) {
    Scene scene;
    scene.halves[5].counts += 3;
    EXPECT_EQ(scene.run().n, 7);
    Scene rough;
    rough.halves[5].counts += 30;
    EXPECT_EQ(rough.run(0.0, 1e4).n, 7);
}

// A manoeuvre of 10 deg/s in 50 ms changes the half-ticks by 4.5 arcsec from one to the next.
TEST(LitHalves, AManoeuvreIsNoContradiction) {
    Scene scene;
    double more = 0.0;
    for (std::size_t h = 4; h < 20; ++h) scene.halves[h].counts += std::llround((more += 4.5) / scale);
    EXPECT_EQ(scene.run().n, 7);
}

TEST(LitHalves, BeforeTheBiasIsKnownThereAreNone) {
    Scene scene;
    LitHalvesState state;
    const LitTick tick{.first = scene.halves[6], .second = scene.halves[7], .tick = 3};
    add_gap_tick(scene.gyro, state, tick, false, motion_arcsec2);
    EXPECT_EQ(state.n, 0);
}

TEST(LitHalves, TheSecondDifferenceOfAWhiteMotionHasSixTimesItsVariance) {
    CompensationConstants gyro{.scale = Arcsec{1e-9}, .random_walk = ArcsecPerRootSecond{0.0}};
    OptimalBridgeConfig config{.learns = false, .halves = true};
    config.prior_arcsec2[0] = 5.0;
    const MotionMomentsState none;
    EXPECT_NEAR(second_difference_arcsec2(MotionCovariance{gyro, config, none, fast_memory}), 30.0, 1e-9);
}

}  // namespace lit_halves_test
