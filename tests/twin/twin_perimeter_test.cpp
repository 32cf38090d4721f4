// The twin's perimeter: the piezo's move, the light between modes, the miss at closing.

#include "quiet_gyro.hpp"

namespace zlg::twin::twin_perimeter_test {

TEST(TwinPerimeter, AMoveOfOneHalfWaveIsSlewLimitedAndTakesTenMilliseconds) {
    TwinConfig config = held_gyro();
    config.piezo.rc_s = 1e-6;
    Twin twin{config, Motion::rest()};
    const std::vector<TwinHalf> halves = advance(twin, frame(false, -1, 190.0), 5);
    for (std::size_t h = 0; h < 4; ++h) {
        EXPECT_NEAR(halves[h].truth.perimeter_v, 150.0 + 10.0 * static_cast<double>(h + 1), 0.005);
    }
    EXPECT_NEAR(halves[4].truth.perimeter_v, 190.0, 1e-4);
}

TEST(TwinPerimeter, TheLagTakesOverWhereItsCurrentFallsBelowTheLimit) {
    Twin twin{held_gyro(), Motion::rest()};
    const std::vector<TwinHalf> halves = advance(twin, frame(false, -1, 190.0), 6);
    // 4 V/ms until 4 V are missing, at 9 ms; then exponential with 1 ms.
    EXPECT_NEAR(halves[2].truth.perimeter_v, 180.0, 1e-4);
    EXPECT_NEAR(halves[3].truth.perimeter_v, 190.0 - 4.0 * std::exp(-1.0), 1e-4);
    EXPECT_NEAR(halves[5].truth.perimeter_v, 190.0 - 4.0 * std::exp(-6.0), 1e-4);
}

TEST(TwinPerimeter, TheHalfWaveVoltageFollowsTheTemperature) {
    for (const double per_c : {0.0, 2e-3, -2e-3}) {
        TwinConfig config = quiet_gyro();
        config.perimeter.miss_lambda = 0.0;
        config.piezo.half_wave_temperature_coefficient_per_c = per_c;
        config.drift.thermal_time_s = 0.2;
        Twin twin{config, Motion::rest()};
        // Ten time constants: 20 C warmer, to 1e-3 C.
        const double before_v = advance(twin, frame(true, 1), 800).back().truth.perimeter_v;
        advance(twin, frame(false, -1, 190.0), 20);
        const double after_v = advance(twin, frame(true, -1, 190.0), 100).back().truth.perimeter_v;
        EXPECT_NEAR(after_v - before_v, 40.0 * (1.0 + per_c * 20.0), 0.003) << per_c;
    }
}

TEST(TwinPerimeter, SetPointsHaveTheStepsAndTheRangeOfTheirConverter) {
    TwinConfig config = held_gyro();
    config.piezo.dac_bits = 8;
    Twin twin{config, Motion::rest()};
    const double step_v = 300.0 / 256.0;
    const double settled_v = advance(twin, frame(false, 1, 100.3), 60).back().truth.perimeter_v;
    EXPECT_NEAR(settled_v, std::round(100.3 / step_v) * step_v, 1e-9);
    EXPECT_NEAR(advance(twin, frame(false, 1, 5000.0), 100).back().truth.perimeter_v, 300.0, 1e-9);
    EXPECT_NEAR(advance(twin, frame(false, 1, -5000.0), 100).back().truth.perimeter_v, 0.0, 1e-9);
}

TEST(TwinPerimeter, SetPointsFollowOneAnotherEquallySpaced) {
    TwinConfig config = held_gyro();
    config.piezo.rc_s = 1e-6;
    config.piezo.slew_v_s = 1e9;
    config.gyro.light_samples = 6;
    Twin twin{config, Motion::rest()};
    core::ActuatorFrame actuator = frame(true, 1);
    actuator.n_set_points = 3;
    actuator.set_point_v = {154.0, 146.0, 158.0};
    const core::SensorFrame sensor = twin.advance(actuator).sensor;
    const std::array<double, 6> detuning = {0.05, 0.05, -0.05, -0.05, 0.1, 0.1};
    for (std::size_t k = 0; k < 6; ++k) {
        const double a = static_cast<double>(sensor.light_a[k]);
        const double b = static_cast<double>(sensor.light_b[k]);
        EXPECT_NEAR((a - b) / (a + b), 0.332 * detuning[k], 2e-6) << "sample " << k;
    }
}

// Five set-points over twelve steps: their borders fall inside steps.
TEST(TwinPerimeter, ASetPointMayChangeBetweenTheStepsOfTheModel) {
    TwinConfig config = held_gyro();
    config.piezo.slew_v_s = 1e9;
    config.gyro.light_samples = 6;
    config.perimeter.tau_s = 1.0;
    config.gyro.tick_s = 0.0024;
    Twin twin{config, Motion::rest()};
    core::ActuatorFrame actuator = frame(true, 1);
    actuator.n_set_points = 5;
    actuator.set_point_v = {154.0, 146.0, 158.0, 149.0, 160.0};
    double expected_v = 150.0;
    for (std::size_t k = 0; k < 5; ++k) {
        const double target_v = actuator.set_point_v[k];
        expected_v = target_v + (expected_v - target_v) * std::exp(-0.0012 / 5.0 / config.piezo.rc_s);
    }
    EXPECT_NEAR(twin.advance(actuator).truth.perimeter_v, expected_v, 2e-5);
}

TEST(TwinPerimeter, LightTellsTheDetuningWithTheSignOfBiasAndHelicity) {
    Twin twin{held_gyro(), Motion::rest()};
    const auto expect_ratio = [&](const core::ActuatorFrame& actuator, double expected) {
        for (const TwinHalf& half : advance(twin, actuator, 2)) {
            const double a = static_cast<double>(half.sensor.light_a[0]);
            const double b = static_cast<double>(half.sensor.light_b[0]);
            EXPECT_NEAR(half.sensor.bias_sign * (a - b) / (a + b), expected, 1e-6);
            EXPECT_TRUE(half.truth.lit);
        }
    };
    advance(twin, frame(true, 1, 158.0), 20);
    expect_ratio(frame(true, 1, 158.0), 0.332 * 0.1);
    advance(twin, frame(true, 1, 198.0), 20);
    expect_ratio(frame(true, 1, 198.0), -0.332 * 0.1);
}

TEST(TwinPerimeter, LightIsOneWayBetweenTheModesAndTwoWayAgainInTheNext) {
    Twin twin{held_gyro(), Motion::rest()};
    const std::vector<TwinHalf> halves = advance(twin, frame(false, -1, 190.0), 6);
    int dark = 0;
    for (const TwinHalf& half : halves) {
        for (std::size_t k = 0; k < 16; ++k) {
            const float least = std::min(half.sensor.light_a[k], half.sensor.light_b[k]);
            if (least == 0.0f) {
                ++dark;
                EXPECT_FALSE(half.truth.lit);
                EXPECT_GT(std::max(half.sensor.light_a[k], half.sensor.light_b[k]), 900.0f);
            }
        }
    }
    // 0.02 wavelength at 0.05 per ms is 0.4 ms of samples 0.156 ms apart.
    EXPECT_GE(dark, 2);
    EXPECT_LE(dark, 3);
    EXPECT_TRUE(halves[0].truth.lit);
    EXPECT_TRUE(halves[5].truth.lit);
    EXPECT_NEAR(halves[5].truth.detuning_end_lambda, 0.0, 1e-3);
}

TEST(TwinPerimeter, WithoutTwoWayLightTheCounterShowsGarbageWithinTheBias) {
    TwinConfig config = held_gyro();
    config.gyro.bias_hz = 1e9;
    Twin twin{config, Motion::rest()};
    TwinHalf before = advance(twin, frame(true, 1, 170.0), 40).back();
    double largest = 0.0;
    for (int h = 0; h < 100; ++h) {
        const TwinHalf after = twin.advance(frame(true, 1, 170.0));
        EXPECT_FALSE(after.truth.lit);
        EXPECT_EQ(after.truth.false_relock_arcsec, 0.0);
        largest = std::max(largest, std::abs(static_cast<double>(count_between(before, after))));
        before = after;
    }
    // The mean of 16 uniform numbers in +-1 has sigma 0.144; the largest of 100 is near 2.5 sigma.
    EXPECT_GT(largest, 0.2 * 2.5e6);
    EXPECT_LT(largest, 0.8 * 2.5e6);
}

TEST(TwinPerimeter, AHeldDetuningLowersTheMeanBiasByChiTimesItsSquare) {
    TwinConfig config = held_gyro();
    config.gyro.bias_hz = 1e12;
    Twin twin{config, Motion::rest()};
    const TwinHalf before = advance(twin, frame(true, 1, 158.0), 41).back();
    const TwinHalf after = twin.advance(frame(true, 1, 158.0));
    EXPECT_EQ(after.sensor.bias_sign, -1);
    const double lost = 3.6 * 0.01;
    EXPECT_NEAR(static_cast<double>(count_between(before, after)), -2.5e9 * (1.0 - lost), 2e3);
    EXPECT_NEAR(after.truth.false_relock_arcsec, 2.5e9 * lost * config.gyro.scale_arcsec, 1e-5 * 2.5e9 * lost);
}

TEST(TwinPerimeter, TheBeamThatStaysInTheOverlapIsTheOneThatWasStronger) {
    Twin twin{held_gyro(), Motion::rest()};
    advance(twin, frame(true, 1, 150.0 + 0.245 * 80.0), 40);
    for (const TwinHalf& half : advance(twin, frame(true, 1, 150.0 + 0.245 * 80.0), 2)) {
        const float difference = half.sensor.light_a[7] - half.sensor.light_b[7];
        EXPECT_GT(difference * static_cast<float>(half.sensor.bias_sign), 900.0f);
    }
}

TEST(TwinPerimeter, WithoutTwoWayLightRotationIsNotCounted) {
    TwinConfig config = held_gyro();
    config.gyro.bias_hz = 0.0;
    config.drift.nonmagnetic_arcsec_s = 1e5;
    Twin twin{config, Motion::sines(1e5, {})};
    const TwinHalf before = advance(twin, frame(true, 1, 170.0), 40).back();
    const TwinHalf after = advance(twin, frame(true, 1, 170.0), 10).back();
    EXPECT_EQ(count_between(before, after), 0);
    EXPECT_NEAR(after.truth.dtheta_arcsec, 1e5 * 0.0025, 1e-9);
}

// The open loop arrives where the closed one begins.
double missed_by(Twin& twin, int polarity, double target_v) {
    return advance(twin, frame(false, polarity, target_v), 16).back().truth.detuning_end_lambda;
}

// The loop closed until it holds the mode; what is set beside it is what a processor's own loop would add.
TwinHalf held(Twin& twin, int polarity, double set_point_v) {
    return advance(twin, frame(true, polarity, set_point_v), 200).back();
}

TEST(TwinPerimeter, EverySwitchOutOfAModeThatIsHeldHasTheMissAskedForShortOfTheTarget) {
    for (const Loop loop : {Loop::analog, Loop::exponential, Loop::digital}) {
        TwinConfig config = quiet_gyro();
        config.perimeter.loop = loop;
        config.perimeter.miss_lambda = 0.17;
        config.perimeter.expansion_lambda_per_c = 0.01;
        config.drift.thermal_time_s = 1e4;
        Twin twin{config, Motion::rest()};
        int polarity = 1;
        double from_v = 150.0;
        for (const double target_v : {190.0, 150.0, 110.0, 150.0, 190.0, 230.0, 268.0, 228.0, 190.0}) {
            polarity = -polarity;
            const double expected = target_v > from_v ? -0.17 : 0.17;
            EXPECT_NEAR(missed_by(twin, polarity, target_v), expected, 1e-4) << "to " << target_v << " V";
            const double first = twin.advance(frame(true, polarity, target_v)).truth.detuning_end_lambda;
            EXPECT_LE(std::abs(first), 0.17 + 2e-5);
            EXPECT_GT(std::abs(first), 0.11);
            const TwinHalf half = held(twin, polarity, target_v - 80.0 * expected);
            EXPECT_NEAR(half.truth.detuning_end_lambda, 0.0, 2e-3) << "to " << target_v << " V";
            EXPECT_NEAR(std::abs(std::remainder((half.truth.perimeter_v - 150.0) / 80.0, 1.0)),
                        polarity > 0 ? 0.0 : 0.5, 0.01);
            from_v = target_v;
        }
    }
}

// The mode ahead is not caught: the reference is against it, so that the processor sees no lock and goes back.
TEST(TwinPerimeter, TheWayBackAndTheSecondAttemptHaveNoMissAndTheNextSwitchHasOneAgain) {
    for (const Loop loop : {Loop::analog, Loop::exponential, Loop::digital}) {
        TwinConfig config = quiet_gyro();
        config.perimeter.loop = loop;
        config.perimeter.miss_lambda = 0.2;
        Twin twin{config, Motion::rest()};
        held(twin, 1, 150.0);
        EXPECT_NEAR(missed_by(twin, -1, 190.0), -0.2, 1e-3);
        twin.advance(frame(true, -1, 190.0));
        EXPECT_NEAR(missed_by(twin, 1, 150.0), 0.0, 1e-3) << "the way back";
        EXPECT_NEAR(held(twin, 1, 150.0).truth.detuning_end_lambda, 0.0, 1e-3);
        EXPECT_NEAR(missed_by(twin, -1, 190.0), 0.0, 1e-3) << "the second attempt";
        EXPECT_NEAR(twin.advance(frame(true, -1, 190.0)).truth.detuning_end_lambda, 0.0, 1e-3);
        held(twin, -1, 190.0);
        EXPECT_NEAR(missed_by(twin, 1, 150.0), 0.2, 1e-3) << "the next switch";
    }
}

TEST(TwinPerimeter, ASearchHasNoMiss) {
    TwinConfig config = held_gyro();
    config.perimeter.miss_lambda = 0.2;
    Twin twin{config, Motion::rest()};
    held(twin, 1, 150.0);
    EXPECT_NEAR(missed_by(twin, -1, 190.0), -0.2, 1e-3);
    advance(twin, frame(true, -1, 190.0), 4);
    for (const double place_v : {20.0, 60.0, 100.0, 140.0}) {
        for (const int polarity : {1, -1}) {
            const double at_v = advance(twin, frame(false, polarity, place_v), 60).back().truth.perimeter_v;
            EXPECT_NEAR(at_v, place_v, 0.01);
            EXPECT_NEAR(advance(twin, frame(true, polarity, place_v), 4).back().truth.perimeter_v, place_v, 0.01);
        }
    }
}

TEST(TwinPerimeter, TheInjectedErrorOfAnExternalLoopStaysUntilTheNextOpening) {
    TwinConfig config = held_gyro();
    config.perimeter.miss_lambda = 0.2;
    Twin twin{config, Motion::rest()};
    advance(twin, frame(false, -1, 190.0), 6);
    advance(twin, frame(true, -1, 190.0), 10);
    EXPECT_NEAR(advance(twin, frame(true, -1, 190.0), 100).back().truth.detuning_end_lambda, -0.2, 1e-3);
    // The processor's own correction acts beside it.
    EXPECT_NEAR(advance(twin, frame(true, -1, 206.0), 100).back().truth.detuning_end_lambda, 0.0, 1e-3);
}

TEST(TwinPerimeter, WithoutAnInjectedMissTheLoopClosesWhereTheVoltageIs) {
    TwinConfig config = quiet_gyro();
    config.perimeter.miss_lambda = 0.0;
    config.perimeter.tau_s = 1e9;
    config.piezo.dac_bits = 24;
    const TwinHalf half = relocked(config, 186.0, 1).back();
    const double settled_v = 186.0 - 4.0 * std::exp(-(15.0 - 8.0));
    EXPECT_NEAR(half.truth.detuning_end_lambda, (settled_v - 190.0) / 80.0, 1e-6);
}

// 80 V hold one wavelength: modes of helicity -1 at both ends, +1 in the middle. A block that is longer or shorter by
// 0.06 takes the place short of the mode ahead out of the range.
TEST(TwinPerimeter, WhereTheMissLiesOutOfRangeTheNextModeOfThatHelicityTakesIt) {
    for (const double longer : {0.06, -0.06}) {
        TwinConfig config = quiet_gyro();
        config.piezo.range_max_v = 80.0;
        config.perimeter.tau_s = 1e9;
        config.perimeter.miss_lambda = 0.02;
        config.perimeter.expansion_lambda_per_c = longer / config.gyro.temperature_rise_c;
        config.drift.thermal_time_s = 0.01;
        Twin twin{config, Motion::rest()};
        EXPECT_NEAR(advance(twin, frame(true, 1), 100).back().truth.detuning_end_lambda, longer, 1e-4);
        advance(twin, frame(false, -1, longer > 0.0 ? 0.0 : 80.0), 12);
        const TwinHalf half = advance(twin, frame(true, -1), 1).back();
        EXPECT_NEAR(half.truth.perimeter_v, longer > 0.0 ? 76.8 : 3.2, 1e-3);
        EXPECT_NEAR(half.truth.detuning_end_lambda, longer > 0.0 ? 0.02 : -0.02, 1e-5);
    }
}

TEST(TwinPerimeter, TheMissIsAimedAnewWhenTheReferenceTurnsAfterTheOpening) {
    TwinConfig config = quiet_gyro();
    config.perimeter.tau_s = 1e9;
    Twin twin{config, Motion::rest()};
    advance(twin, frame(false, 1, 150.0), 2);
    EXPECT_NEAR(advance(twin, frame(false, -1, 110.0), 16).back().truth.detuning_end_lambda, 0.22, 1e-3);
    EXPECT_NEAR(advance(twin, frame(true, -1), 1).back().truth.detuning_end_lambda, 0.22, 1e-5);
}

TEST(TwinPerimeter, AnExternalMoveInSeveralStepsKeepsItsMissToo) {
    TwinConfig config = held_gyro();
    config.perimeter.miss_lambda = 0.2;
    Twin twin{config, Motion::rest()};
    advance(twin, frame(false, -1, 160.0), 2);
    advance(twin, frame(false, -1, 190.0), 12);
    for (const TwinHalf& half : advance(twin, frame(true, -1, 190.0), 10)) {
        EXPECT_NEAR(half.truth.perimeter_v, 190.0 - 16.0, 1e-3);
    }
}

TEST(TwinPerimeter, AClosingBeforeTheMoveIsDoneStillHasTheMissOfTheModeAhead) {
    for (const Loop loop : {Loop::analog, Loop::digital}) {
        TwinConfig config = quiet_gyro();
        config.perimeter.loop = loop;
        config.perimeter.tau_s = 1e9;
        config.perimeter.miss_lambda = 0.2;
        Twin twin{config, Motion::rest()};
        // 10 V of the 40 V to the mode ahead.
        advance(twin, frame(false, -1, 190.0), 1);
        for (const TwinHalf& half : advance(twin, frame(true, -1, 190.0), 10)) {
            EXPECT_NEAR(half.truth.perimeter_v, 190.0 - 16.0, 1e-3);
        }
    }
}

}  // namespace zlg::twin::twin_perimeter_test
