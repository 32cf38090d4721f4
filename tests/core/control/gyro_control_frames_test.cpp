// Single frames that were missed or are wrong: health bits, records, and the grid of switches.
#include "gyro_control_support.hpp"

namespace zlg::core::test {

TEST_P(EitherLoop, AMissedFrameCostsOneHalfAndNoCounts) {
    loop.ticks(50);
    const std::int8_t sign_before = loop.records.back().bias_sign;
    const std::uint64_t reference = loop.plant.counter;
    const HalfRecord missed = loop.half([](SensorFrame& f) {
                                      f = SensorFrame{};
                                      f.status = frame_missed;
                                      f.piezo_v = not_a_number;
                                      f.bias_sign = 0;
                                  })
                                  .record;
    EXPECT_FALSE(missed.valid);
    EXPECT_EQ(missed.counts, 0);
    EXPECT_EQ(missed.bias_sign, -sign_before);
    EXPECT_EQ(missed.mode, 1);
    EXPECT_TRUE(missed.loop_closed);
    EXPECT_EQ(missed.piezo_v, loop.records[99].piezo_v);
    EXPECT_EQ(missed.half, 100);
    EXPECT_EQ(loop.health.back(), health_frame_missed);
    const HalfRecord next = loop.half().record;
    EXPECT_TRUE(next.valid);
    EXPECT_EQ(next.span, 2);
    EXPECT_EQ(next.counts, static_cast<std::int64_t>(loop.plant.counter - reference));
    EXPECT_EQ(loop.health.back(), 0u);
    const std::uint64_t before = loop.plant.counter;
    const HalfRecord good = loop.half().record;
    EXPECT_TRUE(good.valid);
    EXPECT_EQ(good.span, 1);
    EXPECT_EQ(good.counts, static_cast<std::int64_t>(loop.plant.counter - before));
}

TEST_P(EitherLoop, FlagsNameWhatIsWrongWithAFrame) {
    const auto bits = [](auto spoil) {
        Loop loop{config_of(GetParam())};
        loop.ticks(50);
        const HalfRecord r = loop.half(spoil).record;
        EXPECT_TRUE(all_finite(r));
        return std::pair{loop.health.back(), r.valid};
    };
    using Seen = std::pair<std::uint32_t, bool>;
    EXPECT_EQ(bits([](SensorFrame& f) { f.sequence += 5; }), (Seen{health_sequence_error, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.bias_sign = 0; }), (Seen{health_sign_error, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.timer_ticks += 100; }), (Seen{health_timer_error, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.polarity = 0; }), (Seen{health_echo_error, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.loop_closed = false; }), (Seen{health_echo_error, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.n_light = 0; }), (Seen{health_light_unusable, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.n_light = 255; }), (Seen{health_light_unusable, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.light_b[3] = std::nanf(""); }), (Seen{health_light_unusable, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.light_b.fill(0.0f); }), (Seen{health_light_lost, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.piezo_v = not_a_number; }), (Seen{health_piezo_not_finite, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.piezo_v = 299.0; }), (Seen{health_piezo_near_range_end, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.temperature_c = -1.0 / 0.0; }), (Seen{health_temperature_not_finite, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.counter += 1u << 20; }), (Seen{health_counter_jump, false}));
    EXPECT_EQ(bits([](SensorFrame&) {}), (Seen{0u, true}));
}

TEST_P(EitherLoop, WithoutUsableLightOrASignNoDetuningIsRecordedAndLightCostsNoCounts) {
    for (void (*const spoil)(SensorFrame&) :
         {+[](SensorFrame& f) { f.light_a.fill(std::nanf("")); }, +[](SensorFrame& f) { f.bias_sign = 0; },
          +[](SensorFrame& f) { f.polarity = 0; }}) {
        Loop loop{config_of(GetParam())};
        loop.ticks(50);
        const HalfRecord r = loop.half([spoil](SensorFrame& f) {
                                     for (float& x : f.light_a) x *= 1.05f;
                                     spoil(f);
                                 })
                                 .record;
        if ((loop.health.back() & health_light_unusable) != 0) EXPECT_NEAR(static_cast<double>(r.counts), 200.0, 1.1);
        EXPECT_EQ(r.detuning_lambda, 0.0);
        EXPECT_EQ(r.detuning_sq_lambda2, 0.0);
    }
}

TEST_P(EitherLoop, SpoiltFramesInAndAroundASwitchDoNotMoveTheGrid) {
    const auto missed = [](SensorFrame& f) { f.status = frame_missed; };
    const auto not_finite = [](SensorFrame& f) {
        f.light_a.fill(std::nanf(""));
        f.piezo_v = f.temperature_c = not_a_number;
    };
    for (const bool all_missed : {true, false}) {
        Loop loop{config_of(GetParam())};
        loop.ticks(195);
        all_missed ? loop.ticks(12, missed) : loop.ticks(12, not_finite);
        loop.ticks(253);
        // Blind no switch begins: it comes with the first frame after it.
        const std::vector<std::pair<std::int64_t, int>> expected{{all_missed ? 416 : 400, 6}, {800, 6}};
        EXPECT_EQ(loop.open_runs(), expected);
        ASSERT_EQ(loop.events.size(), 2u);
        EXPECT_EQ(loop.events[0].has_half_wave, all_missed);  // else nothing was read before it
        EXPECT_TRUE(loop.events[1].has_half_wave);
        EXPECT_EQ(loop.plant.helicity(), 1);
        for (const HalfRecord& r : loop.records) ASSERT_TRUE(all_finite(r));
    }
}

// The frame tells what was in force, and the record obeys it.
TEST_P(EitherLoop, TheRecordHasTheModeThatTheFrameEchoes) {
    loop.ticks(50);
    const HalfRecord r = loop.half([](SensorFrame& f) { f.polarity = -1; }).record;
    EXPECT_EQ(r.mode, -1);
    EXPECT_EQ(loop.health.back() & health_echo_error, health_echo_error);
    EXPECT_EQ(loop.half().record.mode, 1);
}

// The stage stands still, so that the light of the open loop is that of the mode before; nothing but the missed frame
// is dark.
TEST_P(EitherLoop, AMissedFrameIsNoDarkness) {
    for (const bool missed : {false, true}) {
        Loop loop{config_of(GetParam())};
        loop.ticks(199);
        loop.plant.stage_stuck = true;
        for (int k = 0; k < 12; ++k) {
            const HalfRecord& r = loop.half([&](SensorFrame& f) {
                                          if (missed && k == 4) f.status |= frame_missed;
                                      })
                                      .record;
            if (!r.loop_closed) EXPECT_FALSE(r.lit) << "half " << k << (missed ? ", a frame missed" : "");
        }
        EXPECT_FALSE(loop.open_runs().empty());
    }
}

namespace {

// Control and a plant whose light has the noise that its monitor presumes.
Loop noisy_loop(LoopKind kind) {
    return Loop{config_with([kind](GyroControlConfig& c) {
        c.loop.kind = kind;
        c.limits.light_noise = Wavelengths{0.0021};
    })};
}

}  // namespace

// The mean of two halves is free of a faded beam where the bias was reversed between them, not over a frame that was
// missed.
TEST_P(EitherLoop, AMissedFrameLeavesTheNextHalfOfAFadedBeamWithoutADetuning) {
    Loop loop = noisy_loop(GetParam());
    std::mt19937 random{5};
    const auto even = [&random](SensorFrame& f) { add_noise(f, random, 0.001f); };
    const auto faded = [&even](SensorFrame& f) {
        even(f);
        for (float& x : f.light_a) x *= 0.95f;
    };
    // What the beams differ by from the start is learnt; here they are known to be equal.
    loop.ticks(100, even);
    EXPECT_EQ(loop.health.back() & health_light_unbalanced, 0u);
    loop.ticks(10, faded);
    EXPECT_NE(loop.health.back() & health_light_unbalanced, 0u);
    EXPECT_NE(loop.half(faded).record.detuning_lambda, 0.0);
    (void)loop.half([](SensorFrame& f) { f.status = frame_missed; });
    EXPECT_EQ(loop.half(faded).record.detuning_lambda, 0.0);
    EXPECT_NEAR(loop.half(faded).record.detuning_lambda, 0.0, 0.01);
    EXPECT_NE(loop.records.back().detuning_lambda, 0.0);
}

// Due at tick 200, where the light is noisy until tick 230.
TEST_P(EitherLoop, NoSwitchBeginsWhileTheLightIsNoisy) {
    Loop loop = noisy_loop(GetParam());
    std::mt19937 random{6};
    for (int tick = 0; tick < 260; ++tick) {
        const float part = tick >= 190 && tick < 230 ? 0.03f : 0.001f;
        loop.ticks(1, [&](SensorFrame& f) { add_noise(f, random, part); });
    }
    ASSERT_EQ(loop.open_runs().size(), 1u);
    EXPECT_GE(loop.open_runs()[0].first, 460);
    EXPECT_LE(loop.open_runs()[0].first, 464);
}

}  // namespace zlg::core::test
