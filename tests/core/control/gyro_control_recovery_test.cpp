// Recovery from darkness, from a stage that does not move, and from frames of garbage.
#include "gyro_control_support.hpp"

namespace zlg::core::test {

namespace {

// Garbage of the kinds that electronics produce: plain noise of bits, and frames that are nearly right.
class Garbage {
public:
    SensorFrame frame(std::int64_t half) {
        SensorFrame f;
        f.sequence = coin() ? static_cast<std::uint32_t>(half) : static_cast<std::uint32_t>(random_());
        f.timer_ticks = coin() ? static_cast<std::uint64_t>(half) * 25000 : random_();
        f.counter = random_();
        f.bias_sign = coin() ? static_cast<std::int8_t>(half % 2 == 0 ? 1 : -1) : static_cast<std::int8_t>(random_());
        f.polarity = coin() ? static_cast<std::int8_t>(coin() ? 1 : -1) : static_cast<std::int8_t>(random_());
        f.loop_closed = coin();
        f.has_light_b = coin();
        f.n_light = coin() ? 16 : static_cast<std::uint8_t>(random_());
        const int kind = static_cast<int>(random_() % 4);
        for (float& x : f.light_a) x = light(kind);
        for (float& x : f.light_b) x = light(kind);
        f.piezo_v = any_double();
        f.temperature_c = any_double();
        f.coil_current_a = any_double();
        f.status = random_() % 8 == 0 ? static_cast<std::uint32_t>(random_()) : 0u;
        return f;
    }

private:
    bool coin() { return random_() % 2 == 0; }
    float light(int kind) {
        if (kind == 0) return std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
        if (kind == 1) return static_cast<float>(random_() % 3) * 1e38f;
        const float noise = static_cast<float>(random_() % 1000) * 1e-3f;
        return kind == 2 ? 1000.0f + noise : 1000.0f - 900.0f * noise;
    }
    double any_double() {
        return coin() ? std::bit_cast<double>(random_()) : 300.0 * static_cast<double>(random_() % 1000) * 1e-3;
    }

    std::mt19937_64 random_{20};
};

bool is_sign(int x) { return x == 1 || x == -1; }

void expect_sane(const GyroControlOutput& out, const GyroControlState& s) {
    ASSERT_TRUE(all_finite(out.record));
    ASSERT_TRUE(is_sign(out.actuator.polarity) && is_sign(out.record.mode) && is_sign(out.record.bias_sign));
    ASSERT_TRUE(out.actuator.n_set_points == 1 || out.actuator.n_set_points == 16);
    for (std::size_t k = 0; k < out.actuator.n_set_points; ++k) {
        ASSERT_TRUE(out.actuator.set_point_v[k] >= 0.0 && out.actuator.set_point_v[k] <= 300.0);
    }
    for (const double x : s.half_wave.weight) ASSERT_TRUE(std::isfinite(x));
    for (const double x : s.half_wave.play) ASSERT_TRUE(std::isfinite(x));
    for (const double x : s.mode_switch.readings.voltage_v) ASSERT_TRUE(std::isfinite(x));
    ASSERT_TRUE(s.loop.slew_ratio >= 0.25 && s.loop.slew_ratio <= 4.0);
    ASSERT_TRUE(half_wave(s) >= Volts{20.0} && half_wave(s) <= Volts{80.0});
    ASSERT_TRUE(s.half_wave.length_variance_lambda2 > 0.0 && s.half_wave.length_variance_lambda2 < 0.25);
    ASSERT_TRUE(s.mode_switch.set_point_v >= 0.0 && s.mode_switch.set_point_v <= 300.0);
    const auto &both = s.detector.both, &single = s.detector.single;
    for (const double x : {out.event.half_wave_v, s.piezo_v, s.temperature_c, s.mean_temperature_c, both.level,
                           both.candidate, single.level, single.candidate, s.detector.mean_a,
                           s.mode_switch.detuning_lambda, s.mode_switch.good_v, s.bias_monitor.bias_counts,
                           s.light_monitor.last_lambda, s.coil_monitor.odd, s.coil_monitor.even, s.coil_monitor.spread})
        ASSERT_TRUE(std::isfinite(x));
}

}  // namespace

TEST_P(EitherLoop, ADarkSecondIsSurvived) {
    loop.ticks(100);
    loop.plant.lamp_on = false;
    loop.ticks(200);  // the first switch falls into the dark
    loop.plant.lamp_on = true;
    loop.ticks(650);
    EXPECT_TRUE(loop.tracks());
    EXPECT_EQ(loop.plant.helicity(), loop.actuator.polarity);
    EXPECT_LT(std::abs(loop.records.back().detuning_lambda), 1e-3);
    EXPECT_TRUE(loop.records.back().valid);
    EXPECT_EQ(loop.events.back().outcome, SwitchOutcome::switched);
    EXPECT_EQ(loop.events.back().tick_opened % 200, 0);  // back on the grid
}

TEST_P(EitherLoop, AStageThatDoesNotMoveLeadsBackToTheOldMode) {
    loop.ticks(199);
    loop.plant.stage_stuck = true;
    // While the old mode lases under the new reference, the detuning stays near zero: let it be seen elsewhere.
    loop.plant.drift_lambda += 0.1;
    loop.ticks(64);
    loop.plant.stage_stuck = false;
    loop.plant.drift_lambda -= 0.1;
    loop.ticks(60);
    ASSERT_EQ(loop.events.size(), 1u);
    EXPECT_EQ(loop.events[0].outcome, SwitchOutcome::returned);
    EXPECT_EQ(loop.actuator.polarity, 1);
    EXPECT_EQ(loop.plant.helicity(), 1);
}

TEST_P(EitherLoop, ASearchFindsAModeWhenBothKnownPlacesAreLost) {
    loop.ticks(199);
    loop.plant.lamp_on = false;
    loop.ticks(100);
    EXPECT_EQ(loop.state.mode_switch.phase, SwitchPhase::searching);
    EXPECT_NE(loop.health.back() & health_searching, 0u);
    loop.plant.drift_lambda = 0.37;
    loop.plant.lamp_on = true;
    loop.ticks(90);
    ASSERT_EQ(loop.events.size(), 1u);
    EXPECT_EQ(loop.events[0].outcome, SwitchOutcome::found);
    EXPECT_TRUE(loop.tracks());
    EXPECT_LT(std::abs(loop.plant.detuning_lambda()), 1e-3);
    EXPECT_EQ(loop.plant.helicity(), loop.actuator.polarity);
}

TEST_P(EitherLoop, AHundredThousandHalvesOfGarbageLeaveNoTraceOfThemselves) {
    for (const bool monitored : {false, true}) {
        GyroControlConfig c = config_of(GetParam());
        if (monitored) {
            c.limits.bias_counts = 150.0;
            c.limits.coil_ratio = 0.003;
            c.limits.light_noise = Wavelengths{0.0033};
            c.limits.bias_chi = 3.6;
            c.limits.detuning_change_lambda2 = 0.002;
        }
        GyroControlState s = initial_state(c);
        Garbage garbage;
        for (std::int64_t half = 0; half < 100000; ++half) {
            const GyroControlOutput out = step(c, s, garbage.frame(half));
            ASSERT_NO_FATAL_FAILURE(expect_sane(out, s)) << half;
            ASSERT_EQ(out.record.half, half);
        }
    }
}

TEST_P(EitherLoop, AfterABurstOfGarbageTheGyroFindsItselfAgain) {
    Garbage garbage;
    loop.ticks(150);
    for (int half = 300; half < 700; ++half) (void)loop.half([&](SensorFrame& f) { f = garbage.frame(half); });
    loop.ticks(1000);
    EXPECT_TRUE(loop.tracks());
    EXPECT_EQ(loop.plant.helicity(), loop.actuator.polarity);
    EXPECT_TRUE(loop.records.back().valid);
    EXPECT_EQ(loop.health.back() & ~health_warming_up, 0u);
    EXPECT_LT(std::abs(loop.records.back().detuning_lambda), 1e-3);
}

}  // namespace zlg::core::test
