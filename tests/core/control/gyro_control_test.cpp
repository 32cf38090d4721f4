#include "small_plant.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>

namespace zlg::core {
namespace {

using test::SmallPlant;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

constexpr GyroControlConfig config_with(auto change) {
    GyroControlConfig c;
    c.schedule.interval_ticks = 200;
    c.mode_switch.start_set_point = Volts{160.0};
    change(c);
    return c;
}
constexpr GyroControlConfig config_of(LoopKind kind) {
    return config_with([kind](GyroControlConfig& c) { c.loop.kind = kind; });
}

static_assert(check(GyroControlConfig{}) == GyroControlFault::none);
static_assert(check(config_of(LoopKind::digital)) == GyroControlFault::none);
constexpr GyroControlFault fault(auto change) { return check(config_with(change)); }
static_assert(fault([](auto& c) { c.detector.dark_fraction = nan_value; }) == GyroControlFault::detector);
static_assert(fault([](auto& c) { c.loop.slew_v_s = nan_value; }) == GyroControlFault::loop);
static_assert(fault([](auto& c) { c.half_wave.gate = 0.0; }) == GyroControlFault::half_wave);
static_assert(fault([](auto& c) { c.schedule.interval_ticks = 0; }) == GyroControlFault::schedule);
static_assert(fault([](auto& c) { c.mode_switch.gap_ticks = 0; }) == GyroControlFault::mode_switch);
static_assert(fault([](auto& c) { c.commutator.half_ticks = 0; }) == GyroControlFault::commutator);
static_assert(fault([](auto& c) { c.health.counts_limit = -1; }) == GyroControlFault::health);
static_assert(fault([](auto& c) { c.presumed_temperature = Celsius{nan_value}; }) == GyroControlFault::temperature);
static_assert(fault([](auto& c) { c.loop.range.max = Volts{290.0}; }) == GyroControlFault::ranges_differ);

bool all_finite(const HalfRecord& r) {
    return std::isfinite(r.detuning_lambda) && std::isfinite(r.detuning_sq_lambda2) && std::isfinite(r.piezo_v) &&
           std::isfinite(r.temperature_c);
}

// Control and a plant in closed loop; frames can be spoilt between the two.
class Loop {
public:
    explicit Loop(const GyroControlConfig& c, std::uint64_t counter = 0) : plant{c.loop.kind}, config{c} {
        plant.counter = counter;
        state = initial_state(c, counter);
        actuator = initial_actuator(c);
    }

    template <class Spoil>
    const GyroControlOutput& half(Spoil spoil) {
        SensorFrame frame = plant.advance(actuator);
        spoil(frame);
        out = step(config, state, frame);
        actuator = out.actuator;
        records.push_back(out.record);
        health.push_back(out.health);
        if (out.has_event) events.push_back(out.event);
        return out;
    }
    const GyroControlOutput& half() {
        return half([](SensorFrame&) {});
    }
    template <class Spoil>
    void ticks(int n, Spoil spoil) {
        for (int k = 0; k < 2 * n; ++k) (void)half(spoil);
    }
    void ticks(int n) {
        ticks(n, [](SensorFrame&) {});
    }

    // First half of every run of open halves, and its length.
    [[nodiscard]] std::vector<std::pair<std::int64_t, int>> open_runs() const {
        std::vector<std::pair<std::int64_t, int>> runs;
        for (std::size_t h = 0; h < records.size(); ++h) {
            if (records[h].loop_closed) continue;
            if (h == 0 || records[h - 1].loop_closed) runs.emplace_back(records[h].half, 0);
            ++runs.back().second;
        }
        return runs;
    }

    SmallPlant plant;
    GyroControlConfig config;
    GyroControlState state;
    ActuatorFrame actuator;
    GyroControlOutput out;
    std::vector<HalfRecord> records;
    std::vector<std::uint32_t> health;
    std::vector<SwitchEvent> events;
};

class EitherLoop : public testing::TestWithParam<LoopKind> {};
INSTANTIATE_TEST_SUITE_P(GyroControl, EitherLoop, testing::Values(LoopKind::analog, LoopKind::digital));

TEST_P(EitherLoop, SwitchesOnTheGridForExactlyTheGap) {
    Loop loop{config_of(GetParam())};
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
    Loop loop{config_of(GetParam())};
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
    c.half_wave.presumed = c.stroke.half_wave = Volts{38.0};
    Loop loop{c};
    loop.ticks(210);
    EXPECT_NEAR(std::abs(loop.plant.miss_lambda), 0.025, 0.003);  // 2 V of 80 V per wavelength
    loop.ticks(1000);
    EXPECT_NEAR(loop.state.half_wave.estimate_v, 40.0, 0.1);
    EXPECT_LT(sigma(loop.state.half_wave).value(), 0.3);
    EXPECT_LT(std::abs(loop.plant.miss_lambda), 0.002);
    EXPECT_NEAR(loop.events.back().half_wave_v, 40.0, 0.1);
}

TEST_P(EitherLoop, DetuningDecaysToNothingBetweenSwitches) {
    GyroControlConfig c = config_of(GetParam());
    c.half_wave.presumed = c.stroke.half_wave = Volts{36.0};
    Loop loop{c};
    loop.ticks(230);
    EXPECT_LT(std::abs(loop.records.back().detuning_lambda), 1e-3);
    const HalfRecord& first_closed = loop.records[406];
    EXPECT_GT(std::abs(first_closed.detuning_lambda), 0.02);
    EXPECT_EQ(loop.events.at(0).miss_lambda, first_closed.detuning_lambda);
    EXPECT_GE(first_closed.detuning_sq_lambda2, first_closed.detuning_lambda * first_closed.detuning_lambda);
}

TEST_P(EitherLoop, ASteadyDriftOfThePerimeterIsCarriedAndTheRangeIsKept) {
    Loop loop{config_of(GetParam())};
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
    Loop loop{config_of(GetParam())};
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

TEST_P(EitherLoop, AMissedFrameCostsOneHalfAndNoCounts) {
    Loop loop{config_of(GetParam())};
    loop.ticks(50);
    const std::int8_t sign_before = loop.records.back().bias_sign;
    const std::uint64_t reference = loop.plant.counter;
    const HalfRecord missed = loop.half([](SensorFrame& f) {
                                      f = SensorFrame{};
                                      f.status = frame_missed;
                                      f.piezo_v = nan_value;
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

TEST_P(EitherLoop, AFrameThatDoesNotFollowIsNotCounted) {
    Loop loop{config_of(GetParam())};
    loop.ticks(50);
    const HalfRecord r = loop.half([](SensorFrame& f) { f.sequence += 5; }).record;
    EXPECT_FALSE(r.valid);
    EXPECT_EQ(r.counts, 0);
    EXPECT_EQ(loop.health.back(), health_sequence_error);
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
    EXPECT_EQ(bits([](SensorFrame& f) { f.bias_sign = 0; }), (Seen{health_sign_error, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.timer_ticks += 100; }), (Seen{health_timer_error, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.polarity = 0; }), (Seen{health_echo_error, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.loop_closed = false; }), (Seen{health_echo_error, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.n_light = 0; }), (Seen{health_light_unusable, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.n_light = 255; }), (Seen{health_light_unusable, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.light_b[3] = std::nanf(""); }), (Seen{health_light_unusable, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.light_b.fill(0.0f); }), (Seen{health_light_lost, false}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.piezo_v = nan_value; }), (Seen{health_piezo_not_finite, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.piezo_v = 299.0; }), (Seen{health_piezo_near_range_end, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.temperature_c = -1.0 / 0.0; }), (Seen{health_temperature_not_finite, true}));
    EXPECT_EQ(bits([](SensorFrame& f) { f.counter += 1u << 20; }), (Seen{health_counter_jump, false}));
    EXPECT_EQ(bits([](SensorFrame&) {}), (Seen{0u, true}));
}

TEST_P(EitherLoop, UnusableLightRecordsCountsButNoDetuning) {
    Loop loop{config_of(GetParam())};
    loop.ticks(50);
    const HalfRecord r = loop.half([](SensorFrame& f) { f.light_a.fill(std::nanf("")); }).record;
    EXPECT_NEAR(static_cast<double>(r.counts), 200.0, 1.1);
    EXPECT_EQ(r.detuning_lambda, 0.0);
    EXPECT_EQ(r.detuning_sq_lambda2, 0.0);
}

TEST_P(EitherLoop, SpoiltFramesInAndAroundASwitchDoNotMoveTheGrid) {
    const auto missed = [](SensorFrame& f) { f.status = frame_missed; };
    const auto not_finite = [](SensorFrame& f) {
        f.light_a.fill(std::nanf(""));
        f.piezo_v = f.temperature_c = nan_value;
    };
    for (const bool all_missed : {true, false}) {
        Loop loop{config_of(GetParam())};
        loop.ticks(195);
        if (all_missed) {
            loop.ticks(12, missed);
        } else {
            loop.ticks(12, not_finite);
        }
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

TEST_P(EitherLoop, ADarkSecondIsSurvived) {
    Loop loop{config_of(GetParam())};
    loop.ticks(100);
    loop.plant.lamp_on = false;
    loop.ticks(200);  // the first switch falls into the dark
    loop.plant.lamp_on = true;
    loop.ticks(650);
    EXPECT_EQ(loop.state.mode_switch.phase, SwitchPhase::tracking);
    EXPECT_EQ(loop.plant.helicity(), loop.actuator.polarity);
    EXPECT_LT(std::abs(loop.records.back().detuning_lambda), 1e-3);
    EXPECT_TRUE(loop.records.back().valid);
    EXPECT_EQ(loop.events.back().outcome, SwitchOutcome::switched);
    EXPECT_EQ(loop.events.back().tick_opened % 200, 0);  // back on the grid
}

TEST_P(EitherLoop, AStageThatDoesNotMoveLeadsBackToTheOldMode) {
    Loop loop{config_of(GetParam())};
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
    Loop loop{config_of(GetParam())};
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
    EXPECT_EQ(loop.state.mode_switch.phase, SwitchPhase::tracking);
    EXPECT_LT(std::abs(loop.plant.detuning_lambda()), 1e-3);
    EXPECT_EQ(loop.plant.helicity(), loop.actuator.polarity);
}

TEST_P(EitherLoop, OneBeamIsEnough) {
    Loop loop{config_of(GetParam())};
    loop.ticks(1100, [](SensorFrame& f) { f.has_light_b = false; });
    EXPECT_EQ(loop.events.size(), 5u);
    for (const SwitchEvent& e : loop.events) EXPECT_EQ(e.outcome, SwitchOutcome::switched);
    EXPECT_NEAR(loop.state.half_wave.estimate_v, 40.0, 0.1);
}

TEST_P(EitherLoop, ACopyOfTheStateGoesOnLikeTheOriginal) {
    Loop loop{config_of(GetParam())};
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

TEST_P(EitherLoop, ADetuningOfUncertainSignIsNotUsed) {
    for (const bool sign_lost : {true, false}) {
        Loop loop{config_of(GetParam())};
        loop.ticks(50);
        const HalfRecord r = loop.half([sign_lost](SensorFrame& f) {
                                     for (float& x : f.light_a) x *= 1.05f;
                                     if (sign_lost) {
                                         f.bias_sign = 0;
                                     } else {
                                         f.polarity = 0;
                                     }
                                 })
                                 .record;
        EXPECT_EQ(r.detuning_lambda, 0.0);
        EXPECT_EQ(r.detuning_sq_lambda2, 0.0);
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
    Loop loop{config_of(GetParam())};
    loop.ticks(200);
    const double before = loop.state.detector.both.level;
    while (loop.state.mode_switch.phase != SwitchPhase::tracking) {
        (void)loop.half([](SensorFrame& f) {
            for (float& x : f.light_a) x *= 0.8f;
            for (float& x : f.light_b) x *= 0.8f;
        });
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

TEST(GyroControl, TheFirstCommandIsTheStartOfTheConfiguration) {
    GyroControlConfig c;
    c.mode_switch.start_set_point = Volts{120.0};
    c.mode_switch.start_polarity = -1;
    const ActuatorFrame a = initial_actuator(c);
    EXPECT_TRUE(a.loop_closed);
    EXPECT_EQ(a.polarity, -1);
    EXPECT_EQ(a.n_set_points, 1);
    EXPECT_EQ(a.set_point_v[0], 120.0);
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

void expect_sane(const GyroControlOutput& out, const GyroControlState& s) {
    ASSERT_TRUE(all_finite(out.record));
    ASSERT_TRUE(out.actuator.polarity == 1 || out.actuator.polarity == -1);
    ASSERT_TRUE(out.actuator.n_set_points == 1 || out.actuator.n_set_points == 16);
    for (std::size_t k = 0; k < out.actuator.n_set_points; ++k) {
        ASSERT_TRUE(out.actuator.set_point_v[k] >= 0.0 && out.actuator.set_point_v[k] <= 300.0);
    }
    for (const double weight : s.stroke.weight) ASSERT_TRUE(std::isfinite(weight));
    for (const double play : s.stroke.play) ASSERT_TRUE(std::isfinite(play));
    ASSERT_TRUE(s.loop.slew_ratio >= 0.25 && s.loop.slew_ratio <= 4.0);
    ASSERT_TRUE(out.record.mode == 1 || out.record.mode == -1);
    ASSERT_TRUE(out.record.bias_sign == 1 || out.record.bias_sign == -1);
    ASSERT_TRUE(std::isfinite(out.event.half_wave_v) && std::isfinite(out.event.miss_lambda));
    ASSERT_TRUE(s.half_wave.estimate_v >= 20.0 && s.half_wave.estimate_v <= 80.0);
    ASSERT_TRUE(s.half_wave.variance_v2 > 0.0 && s.half_wave.variance_v2 <= 16.0);
    ASSERT_TRUE(std::isfinite(s.piezo_v) && std::isfinite(s.temperature_c));
    ASSERT_TRUE(std::isfinite(s.detector.both.level) && std::isfinite(s.detector.both.candidate));
    ASSERT_TRUE(std::isfinite(s.detector.single.level) && std::isfinite(s.detector.single.candidate));
    ASSERT_TRUE(std::isfinite(s.detector.mean_a));
    ASSERT_TRUE(std::isfinite(s.mode_switch.detuning_lambda) && std::isfinite(s.mode_switch.miss_lambda));
    ASSERT_TRUE(s.mode_switch.set_point_v >= 0.0 && s.mode_switch.set_point_v <= 300.0);
    ASSERT_TRUE(std::isfinite(s.mode_switch.good_v));
    ASSERT_TRUE(std::isfinite(s.bias_monitor.bias_counts) && std::isfinite(s.light_monitor.last_lambda));
    ASSERT_TRUE(std::isfinite(s.coil_monitor.odd) && std::isfinite(s.coil_monitor.even));
    ASSERT_TRUE(std::isfinite(s.coil_monitor.spread) && std::isfinite(s.temperature_before_c));
    for (const double v : s.mode_switch.readings.voltage_v) ASSERT_TRUE(std::isfinite(v));
}

TEST_P(EitherLoop, AHundredThousandHalvesOfGarbageLeaveNoTraceOfThemselves) {
    for (const bool monitored : {false, true}) {
        GyroControlConfig c = config_of(GetParam());
        if (monitored) {
            c.bias_monitor.presumed_counts = 150.0;
            c.coil_monitor.tolerance_ratio = 0.003;
            c.counter_monitor.watches = true;
            c.light_monitor = {.noise = Wavelengths{0.0033}, .bias_chi = 3.6};
            c.detuning_monitor.max_change_lambda2 = 0.002;
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
    Loop loop{config_of(GetParam())};
    Garbage garbage;
    loop.ticks(150);
    for (int half = 300; half < 700; ++half) (void)loop.half([&](SensorFrame& f) { f = garbage.frame(half); });
    loop.ticks(1000);
    EXPECT_EQ(loop.state.mode_switch.phase, SwitchPhase::tracking);
    EXPECT_EQ(loop.plant.helicity(), loop.actuator.polarity);
    EXPECT_TRUE(loop.records.back().valid);
    EXPECT_EQ(loop.health.back() & ~health_warming_up, 0u);
    EXPECT_LT(std::abs(loop.records.back().detuning_lambda), 1e-3);
}

GyroControlConfig dithered(LoopKind kind, DitherMethod method) {
    return config_with([&](GyroControlConfig& c) {
        c.loop.kind = kind;
        c.commutator.dither.method = method;
    });
}

TEST_P(EitherLoop, EachRecordHoldsTheShiftThatWasCommandedForItsEnd) {
    Loop loop{dithered(GetParam(), DitherMethod::random)};
    std::int32_t commanded = loop.actuator.edge_offset_ticks;
    EXPECT_EQ(commanded, 0);
    for (int half = 0; half < 2200; ++half) {
        const auto miss = [&](SensorFrame& f) {
            if (half % 97 == 50) f.status = frame_missed;
        };
        const GyroControlOutput& out = loop.half(miss);
        ASSERT_EQ(out.record.edge_offset_ticks, commanded);
        commanded = out.actuator.edge_offset_ticks;
        ASSERT_EQ(out.health & health_timer_error, 0u);
    }
    EXPECT_EQ(loop.open_runs().size(), 5u);
}

// Whatever the law, the angle is that of the rotation to a count at the end of every tick: nothing is left of the shifts.
TEST_P(EitherLoop, ShiftedEdgesLeaveTheAngleAsItIs) {
    for (const DitherMethod method :
         {DitherMethod::none, DitherMethod::automatic, DitherMethod::paired, DitherMethod::random}) {
        for (const double rate_counts : {0.0, 50.3, -700.0}) {
            GyroControlConfig c = dithered(GetParam(), method);
            c.schedule.interval_ticks = 100000;
            Loop loop{c};
            loop.plant.rate_counts = rate_counts;
            GyroCompensationState state;
            for (int half = 0; half < 2000; ++half) {
                const CompensationOutput out = step(GyroCompensationConfig{}, state, loop.half().record);
                if (!out.has_sample) continue;
                ASSERT_NEAR(out.angle_arcsec / 3.263, rate_counts * (half + 1), 1.01) << half;
            }
        }
    }
}

TEST(GyroControl, TheLawFollowsTheRate) {
    for (const double rate_counts : {0.0, 1.0}) {
        Loop loop{dithered(LoopKind::analog, DitherMethod::automatic)};
        loop.plant.rate_counts = rate_counts;
        loop.ticks(300);
        EXPECT_EQ(loop.state.commutator.dither.law, rate_counts > 0.0 ? DitherLaw::random : DitherLaw::paired);
    }
}

TEST(GyroControl, AnImpossibleDitherIsRefused) {
    EXPECT_EQ(check(config_with([](GyroControlConfig& c) {
                  c.commutator.dither = {.method = DitherMethod::paired, .half_ticks = 20000};
              })),
              GyroControlFault::commutator);
}

}  // namespace
}  // namespace zlg::core
