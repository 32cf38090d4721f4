// The closed loop of a gyro without faults: switches, half-wave voltage, detuning, counts.
#include "gyro_control_support.hpp"

namespace zlg::core::test {

INSTANTIATE_TEST_SUITE_P(GyroControl, EitherLoop, testing::Values(LoopKind::analog, LoopKind::digital));

TEST_P(EitherLoop, SwitchesOnTheGridForExactlyTheGap) {
    loop.ticks(1100);
    const std::vector<std::pair<std::int64_t, int>> expected{{400, 6}, {800, 6}, {1200, 6}, {1600, 6}, {2000, 6}};
    EXPECT_EQ(loop.open_runs(), expected);
    ASSERT_EQ(loop.events.size(), 5u);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(loop.events[k].outcome, SwitchOutcome::switched);
        EXPECT_EQ(loop.events[k].tick_opened, 200 * static_cast<std::int64_t>(k + 1));
    }
}

TEST_P(EitherLoop, HelicityAlternatesWithTheOpeningAndTheLaserFollows) {
    for (int half = 0; half < 2200; ++half) {
        const HalfRecord r = loop.half().record;
        const int n_openings = half / 400;
        EXPECT_EQ(r.mode, n_openings % 2 == 0 ? 1 : -1) << half;
        if (half % 400 > 20) {
            EXPECT_EQ(loop.plant.helicity(), r.mode) << half;
        }
    }
}

TEST_P(EitherLoop, TheHalfWaveVoltageIsLearntFromAFivePercentError) {
    GyroControlConfig c = config_of(GetParam());
    c.half_wave.half_wave = Volts{38.0};
    Loop loop{c};
    loop.ticks(210);
    EXPECT_NEAR(std::abs(loop.plant.miss_lambda), 0.025, 0.003);  // 2 V of 80 V per wavelength
    loop.ticks(1000);
    EXPECT_NEAR(half_wave(loop.state).value(), 40.0, 0.1);
    EXPECT_LT(sigma(loop.state.half_wave, Volts{40.0}).value(), 0.3);
    EXPECT_LT(std::abs(loop.plant.miss_lambda), 0.002);
    EXPECT_NEAR(loop.events.back().half_wave_v, 40.0, 0.1);
}

TEST_P(EitherLoop, DetuningDecaysToNothingBetweenSwitches) {
    GyroControlConfig c = config_of(GetParam());
    c.half_wave.half_wave = Volts{36.0};
    Loop loop{c};
    loop.ticks(230);
    EXPECT_LT(std::abs(loop.records.back().detuning_lambda), 1e-3);
    const HalfRecord& first_closed = loop.records[406];
    EXPECT_GT(std::abs(first_closed.detuning_lambda), 0.02);
    EXPECT_GE(first_closed.detuning_sq_lambda2, first_closed.detuning_lambda * first_closed.detuning_lambda);
}

TEST_P(EitherLoop, ASteadyDriftOfThePerimeterIsCarriedAndTheRangeIsKept) {
    for (int tick = 0; tick < 6000; ++tick) {
        loop.plant.drift_lambda += 3.0 / 6000.0;  // 240 V in all, against a range of 300 V
        loop.ticks(1);
        ASSERT_GE(loop.plant.voltage_v, 0.0);
        ASSERT_LE(loop.plant.voltage_v, 300.0);
    }
    EXPECT_EQ(loop.events.size(), 29u);
    for (const SwitchEvent& e : loop.events) EXPECT_EQ(e.outcome, SwitchOutcome::switched) << e.tick_opened;
    EXPECT_EQ(loop.open_runs().size(), 29u);
}

TEST_P(EitherLoop, CountsAddUpToTheCounterAcrossItsWrap) {
    const std::uint64_t start = std::numeric_limits<std::uint64_t>::max() - 500;
    Loop loop{config_of(GetParam()), start};
    loop.ticks(300);
    std::int64_t sum = 0;
    for (const HalfRecord& r : loop.records) sum += r.counts;
    EXPECT_EQ(start + static_cast<std::uint64_t>(sum), loop.plant.counter);
    EXPECT_NEAR(static_cast<double>(loop.records[10].counts), 50.0 + 150.0, 1.1);
    EXPECT_NEAR(static_cast<double>(loop.records[11].counts), 50.0 - 150.0, 1.1);
}

TEST_P(EitherLoop, AGoodRunIsHealthyOutsideItsSwitches) {
    loop.ticks(500);
    for (std::size_t half = 40; half < loop.health.size(); ++half) {
        const bool in_gap = !loop.records[half].loop_closed;
        const std::uint32_t ignored = in_gap ? health_light_lost : 0u;
        const std::uint32_t expected = half % 400 < 46 && half >= 400 ? health_switching : 0u;
        ASSERT_EQ(loop.health[half] & ~ignored, expected) << half;
        if (!in_gap) {
            ASSERT_TRUE(loop.records[half].valid) << half;
        }
    }
}

TEST_P(EitherLoop, OneBeamIsEnough) {
    loop.ticks(1100, [](SensorFrame& f) { f.has_light_b = false; });
    EXPECT_EQ(loop.events.size(), 5u);
    for (const SwitchEvent& e : loop.events) EXPECT_EQ(e.outcome, SwitchOutcome::switched);
    EXPECT_NEAR(half_wave(loop.state).value(), 40.0, 0.1);
}

TEST_P(EitherLoop, ACopyOfTheStateGoesOnLikeTheOriginal) {
    Loop loop{dithered(GetParam(), DitherMethod::random)};
    loop.ticks(199);
    GyroControlState copy = loop.state;
    for (int half = 0; half < 200; ++half) {
        SensorFrame frame;
        (void)loop.half([&frame](const SensorFrame& f) { frame = f; });
        const GyroControlOutput replayed = step(loop.config, copy, frame);
        ASSERT_EQ(replayed.actuator, loop.out.actuator);
        ASSERT_EQ(replayed.record, loop.out.record);
        ASSERT_EQ(copy, loop.state);
    }
}

TEST_P(EitherLoop, APointThatIsDueTooEarlyWaitsForTheLock) {
    GyroControlConfig c = config_of(GetParam());
    c.schedule.interval_ticks = 15;
    Loop loop{c};
    loop.ticks(60);
    // Twenty ticks in lock end with half 39; half 41 is the next that is followed by a new tick.
    EXPECT_EQ(loop.open_runs().at(0), (std::pair<std::int64_t, int>{42, 6}));
    EXPECT_EQ(loop.events.at(0).tick_opened, 21);
    EXPECT_EQ(loop.open_runs().size(), 2u);  // a switch lasts 23 ticks and a little: the grid's points merge
}

TEST_P(EitherLoop, TheLightLevelRestsWhileTheGyroSwitches) {
    loop.ticks(200);
    const double before = loop.state.detector.both.level;
    while (loop.state.mode_switch.phase != SwitchPhase::tracking) {
        (void)loop.half([](SensorFrame& f) { scale_light(f, 0.8f); });
    }
    EXPECT_NEAR(loop.state.detector.both.level, before, 1e-9 * before);
    EXPECT_EQ(loop.events.size(), 1u);
}

TEST(GyroControl, OnlyAHalfThatWasClosedByCommandAndEchoMovesTheDigitalLoop) {
    const auto detuned = [](SensorFrame& f) {
        for (float& x : f.light_a) x *= 1.02f;
    };
    Loop echo_open{config_of(LoopKind::digital)};
    echo_open.ticks(50);
    const double held_v = echo_open.actuator.set_point_v[0];
    (void)echo_open.half([&](SensorFrame& f) {
        detuned(f);
        f.loop_closed = false;
    });
    EXPECT_EQ(echo_open.actuator.set_point_v[0], held_v);
    (void)echo_open.half(detuned);
    EXPECT_NE(echo_open.actuator.set_point_v[0], held_v);

    Loop echo_closed{config_of(LoopKind::digital)};
    echo_closed.ticks(200);
    const double preset_v = echo_closed.actuator.set_point_v[0];
    echo_closed.ticks(3, [&](SensorFrame& f) {
        detuned(f);
        f.loop_closed = true;
    });
    EXPECT_TRUE(echo_closed.actuator.loop_closed);
    EXPECT_EQ(echo_closed.actuator.set_point_v[0], preset_v);
}

TEST(GyroControl, EitherBiasSignMayComeFirst) {
    Loop loop{config_of(LoopKind::analog)};
    for (int half = 0; half < 20; ++half) {
        const HalfRecord r =
            loop.half([](SensorFrame& f) { f.bias_sign = static_cast<std::int8_t>(-f.bias_sign); }).record;
        EXPECT_EQ(r.bias_sign, half % 2 == 0 ? -1 : 1);
        EXPECT_TRUE(r.valid);
    }
}

}  // namespace zlg::core::test
