#include "gyro_control_support.hpp"

namespace zlg::core::test::gyro_control_faults_test {

// The bias of the plant is 150 counts a half, its chi 3.6, its light without noise.
GyroControlConfig monitored(LoopKind kind) {
    GyroControlConfig c;
    c.loop.kind = kind;
    c.schedule.interval_ticks = 100'000;
    c.mode_switch.start_set_point = Volts{160.0};
    c.limits.bias_counts = 150.0;
    c.limits.coil_ratio = 1.0 / 300.0;
    c.limits.bias_chi = 3.6;
    c.limits.detuning_change_lambda2 = 1.0 / 540.0;
    c.limits.counts = 1253;
    return c;
}

// It has run for so many ticks, and nothing is recorded yet.
Loop running(LoopKind kind, int ticks = 200) {
    Loop gyro{monitored(kind)};
    gyro.ticks(ticks);
    gyro.records.clear();
    return gyro;
}

struct Faults : testing::TestWithParam<LoopKind> {
    Loop gyro = running(GetParam());
};
// A counter that loses or gains counts at random, in halves with the loop open too.
TEST_P(Faults, WhatAMonitorObjectsToIsNotValid) {
    constexpr std::uint32_t objections = health_bias_lost | health_helicity_reversed | health_counter_jump |
                                         health_counter_bit_stuck | health_frame_missed | health_sequence_error |
                                         health_sign_error;
    GyroControlConfig config = monitored(GetParam());
    config.schedule.interval_ticks = 40;
    Loop gyro{config};
    std::mt19937 random{7};
    std::uint64_t lost = 0;
    int objected = 0;
    int lost_bias = 0;
    gyro.ticks(15'000, [&](SensorFrame& frame) {
        const HalfRecord& last = gyro.out.record;
        if ((gyro.out.health & objections) != 0) {
            ++objected;
            lost_bias += (gyro.out.health & health_bias_lost) != 0;
            EXPECT_FALSE(last.valid) << "half " << last.half << ", health " << gyro.out.health;
        }
        // Most of all at the closing of the loop, where one half has none before it that could speak for it.
        const bool closes = frame.loop_closed && !last.loop_closed;
        if (random() % (closes ? 2 : 200) == 0) lost += random() % 600 - 300;
        frame.counter += lost;
    });
    EXPECT_GT(objected, 200);
    EXPECT_GT(lost_bias, 100);
}

TEST_P(Faults, NumbersThatFallBackALittleCostHalfASecond) {
    for (const std::uint32_t behind : {1u, 5u, 8u}) {
        Loop gyro = running(GetParam(), 100);
        gyro.ticks(1000, [&](SensorFrame& frame) { frame.sequence -= behind; });
        EXPECT_LT(gyro.invalid(), 210) << behind;
    }
}

// As `frame_late`: the frame of the half before, for ten seconds.
TEST_P(Faults, FramesThatAreLateAreNeverThoseOfTheirHalf) {
    Loop gyro = running(GetParam(), 100);
    SensorFrame before;
    bool first = true;
    gyro.ticks(2000, [&](SensorFrame& frame) {
        std::swap(frame, before);
        if (first) frame.status |= frame_missed;
        first = false;
    });
    EXPECT_EQ(gyro.invalid(), 4000);
}

// The plant turns 50 counts in a half. The first frame holds a half, where two have passed.
TEST_P(Faults, AFirstFrameThatIsLateHasNoCounts) {
    for (const int late : {1, 2, 5, 280}) {
        Loop gyro{monitored(GetParam())};
        SensorFrame before;
        int n = 0;
        gyro.ticks(400, [&](SensorFrame& frame) {
            if (n > late) return;
            std::swap(frame, before);
            if (n++ == 0) frame.status |= frame_missed;
        });
        int n_valid = 0;
        for (const HalfRecord& r : gyro.records) {
            n_valid += r.valid;
            const std::int64_t bias = r.span % 2 != 0 ? 150 * r.bias_sign * r.mode : 0;
            const std::int64_t turned = 50 * r.span;
            if (r.valid) EXPECT_LE(std::abs(r.counts - bias - turned), 5) << "half " << r.half << ", late " << late;
        }
        EXPECT_GT(n_valid, 790 - late) << late;
    }
}

// A half that is not valid leaves its counts to the next one that is. Faults of readings, signs, stamps and light, at
// random, of a gyro that stays lit and locked.
TEST_P(Faults, NoCountIsLostWhateverTheMonitorsSay) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        Loop gyro{monitored(GetParam())};
        gyro.config.limits.light_noise = Wavelengths{0.0021};
        std::mt19937 random{seed};
        gyro.ticks(100, [&](SensorFrame& frame) { add_noise(frame, random, 0.001f); });
        gyro.records.clear();
        const std::uint64_t start = gyro.plant.counter;
        int spoilt = 0;
        std::vector<std::uint64_t> readings;
        const std::function<void(SensorFrame&)> faults[] = {
            [](SensorFrame& f) { f.status |= frame_missed; },
            [](SensorFrame& f) { f.bias_sign = 0; },
            [](SensorFrame& f) { f.polarity = 0; },
            [](SensorFrame& f) { f.timer_ticks += 5000; },
            [&](SensorFrame& f) { readings.back() = f.counter += 40 + random() % 400; },
            [&](SensorFrame& f) { add_noise(f, random, 0.05f); },
            [](SensorFrame& f) { f.sequence -= 3; }};
        gyro.ticks(3000, [&](SensorFrame& frame) {
            readings.push_back(frame.counter);
            add_noise(frame, random, 0.001f);
            if (readings.size() > 5900 || random() % 12 != 0) return;
            ++spoilt;
            faults[random() % 7](frame);
        });
        std::int64_t sum = 0;
        std::int64_t covered = 0;
        std::size_t n = 0;
        for (const HalfRecord& r : gyro.records) {
            ++n;
            if (!r.valid) continue;
            sum += r.counts;
            covered += r.span;
            ASSERT_EQ(covered, static_cast<std::int64_t>(n)) << "half " << r.half << ", seed " << seed;
            ASSERT_EQ(sum, static_cast<std::int64_t>(readings[n - 1] - start))
                << "half " << r.half << ", seed " << seed;
        }
        EXPECT_EQ(covered, 6000);
        EXPECT_GT(spoilt, 300);
    }
}

INSTANTIATE_TEST_SUITE_P(GyroControl, Faults, testing::Values(LoopKind::analog, LoopKind::digital));

TEST_P(Faults, AGoodRunHasNoneAndAllIsValid) {
    Loop gyro{monitored(GetParam())};
    gyro.ticks(30);
    gyro.seen = 0;
    gyro.ticks(2000);
    EXPECT_EQ(gyro.seen, 0u);
    EXPECT_EQ(gyro.invalid(), 0);
}

TEST_P(Faults, AModeHopIsFollowedByTheReferenceAndNoHalfOfItIsValid) {
    const double before_v = gyro.plant.voltage_v;
    gyro.plant.drift_lambda += 0.503;
    gyro.ticks(200);
    EXPECT_NE(gyro.seen & health_helicity_reversed, 0u);
    EXPECT_EQ(gyro.actuator.polarity, -1);
    EXPECT_EQ(gyro.plant.helicity(), -1);
    EXPECT_NEAR(gyro.plant.voltage_v, before_v, 1.0);
    EXPECT_TRUE(gyro.tracks());
    for (const HalfRecord& r : gyro.records) {
        ASSERT_TRUE(!r.valid || std::abs(r.bias_sign * r.mode * 150 + 50 - r.counts) < 3) << r.half;
    }
    EXPECT_LT(gyro.invalid(), 12);
}

TEST_P(Faults, NearAnEndOfTheRangeThePiezoIsLedAwayAndTheLockKept) {
    for (int tick = 0; tick < 2000; ++tick) {
        gyro.plant.drift_lambda -= 3.0 / 2000.0;  // 240 V upwards
        gyro.ticks(1);
        ASSERT_LT(gyro.plant.voltage_v, 297.0) << tick;
    }
    EXPECT_NE(gyro.seen & health_recentring, 0u);
    EXPECT_EQ(gyro.seen & health_relock_failed, 0u);
    gyro.ticks(50);
    EXPECT_TRUE(gyro.tracks());
    EXPECT_EQ(gyro.state.half_wave.weight, initial_state(gyro.config).half_wave.weight) << "it teaches nothing";
}

TEST_P(Faults, LightThatIsNotANumberCostsEightHalvesAndMovesNothing) {
    gyro.ticks(400, [](SensorFrame& f) { f.light_a.fill(std::nanf("")); });
    EXPECT_LE(gyro.invalid(), 8);
    EXPECT_NE(gyro.seen & health_light_contradicted, 0u);
    gyro.ticks(50);
    EXPECT_EQ(gyro.invalid(), 0);
    EXPECT_TRUE(gyro.tracks());
}

TEST_P(Faults, ALaserThatDiedIsBackAtOnceWhenItIsLit) {
    for (const int dark_ticks : {5, 50, 300}) {
        Loop gyro = running(GetParam());
        gyro.plant.lamp_on = false;
        gyro.records.clear();
        // A dark counter counts what it likes.
        gyro.ticks(dark_ticks, [](SensorFrame& f) { f.light_a[3] = 0.0f; });
        EXPECT_EQ(gyro.invalid(), 2 * dark_ticks);
        gyro.plant.lamp_on = true;
        gyro.ticks(200);
        gyro.records.clear();
        gyro.ticks(50);
        EXPECT_EQ(gyro.invalid(), 0) << dark_ticks;
        EXPECT_TRUE(gyro.tracks());
    }
}

TEST_P(Faults, LightThatStaysFaintIsTheNewLevelOnceTheBeatHasProvedIt) {
    const auto faint = [](SensorFrame& f) { scale_light(f, 0.3f); };
    gyro.ticks(100, faint);
    EXPECT_LE(gyro.invalid(), 8);
    gyro.seen = 0;
    gyro.ticks(100, faint);
    EXPECT_EQ(gyro.seen & (health_light_lost | health_light_contradicted), 0u);
    EXPECT_EQ(gyro.invalid(), 0);
}

TEST_P(Faults, ARepeatedFrameIsTakenAsMissed) {
    SensorFrame last;
    gyro.ticks(1, [&](SensorFrame& f) { last = f; });
    gyro.records.clear();
    const double held_v = gyro.actuator.set_point_v[0];
    gyro.ticks(10, [&](SensorFrame& f) { f = last; });
    EXPECT_EQ(gyro.actuator.set_point_v[0], held_v);
    for (const HalfRecord& r : gyro.records) EXPECT_TRUE(!r.valid && r.counts == 0);
    EXPECT_EQ(gyro.invalid(), 20);
    const std::uint64_t held = last.counter;
    gyro.ticks(10);
    EXPECT_EQ(gyro.records[0].span, 21);
    std::int64_t counts = 0;
    for (const HalfRecord& r : gyro.records) counts += r.counts;
    EXPECT_EQ(counts, static_cast<std::int64_t>(gyro.plant.counter - held));
    EXPECT_EQ(gyro.invalid(), 0);
}

TEST_P(Faults, ALostCurrentAndAnUnevenOneAreNotValid) {
    for (const double other : {0.0, 0.98}) {
        Loop gyro = running(GetParam());
        gyro.ticks(50, [&](SensorFrame& f) { f.coil_current_a = f.bias_sign > 0 ? 1.0 : -other; });
        EXPECT_GE(gyro.invalid(), 98) << other;
        gyro.ticks(50);
        gyro.records.clear();
        gyro.ticks(50);
        EXPECT_EQ(gyro.invalid(), 0) << other;
    }
}

TEST_P(Faults, APushOfThePerimeterCostsOneTick) {
    gyro.plant.drift_lambda += 0.1;
    gyro.ticks(100);
    EXPECT_NE(gyro.seen & health_detuning_unsteady, 0u);
    const int invalid = gyro.invalid();
    EXPECT_TRUE(invalid >= 1 && invalid <= 2) << invalid;
}

TEST_P(Faults, MoreCountsThanAnyRateAreNotValid) {
    gyro.plant.rate_counts = 2000.0;
    gyro.ticks(50);
    EXPECT_EQ(gyro.invalid(), 100);
    EXPECT_NE(gyro.seen & health_rate_over_range, 0u);
    gyro.plant.rate_counts = 0.0;
    gyro.ticks(2);
    gyro.records.clear();
    gyro.ticks(50);
    EXPECT_EQ(gyro.invalid(), 0);
}

}  // namespace zlg::core::test::gyro_control_faults_test
