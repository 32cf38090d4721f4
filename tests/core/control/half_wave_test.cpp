#include <zlg/core/control/half_wave.hpp>

#include "support.hpp"

namespace zlg::core::half_wave_test {

constexpr HalfWaveConfig config{};

static_assert(is_allowed(config));
static_assert(!is_allowed(HalfWaveConfig{.half_wave = Volts{0.0}}));
static_assert(!is_allowed(HalfWaveConfig{.half_wave = Volts{not_a_number}}));
static_assert(!is_allowed(HalfWaveConfig{.reference = Celsius{not_a_number}}));
static_assert(!is_allowed(HalfWaveConfig{.range = {.max = Volts{-1.0}}}));

// A piezo whose length is not the model's: plays at other thresholds, and a slope that falls with temperature.
class Piezo {
public:
    double half_wave_v = 41.0;
    double hysteresis = 0.0;  // of the slope, in plays
    double per_c = 0.0;
    double temperature_c = 20.0;

    double length(double v) {
        double sum = 0.0;
        for (std::size_t i = 0; i < play_v_.size(); ++i) {
            const double r = 1.5 + 3.0 * static_cast<double>(i);
            play_v_[i] = std::clamp(play_v_[i], v - r, v + r);
            sum += play_v_[i];
        }
        const double slope = 0.5 / half_wave_v / (1.0 + per_c * (temperature_c - 20.0));
        return slope * ((1.0 - hysteresis) * v + hysteresis * sum / static_cast<double>(play_v_.size()));
    }

private:
    std::array<double, 5> play_v_{150.0, 150.0, 150.0, 150.0, 150.0};
};

// Switches up and down; in between the loop moves the voltage by `walk_v` against the last move, as creep makes it.
class Switches {
public:
    Piezo piezo;
    double v = 150.0;
    double walk_v = 0.0;
    bool sees_temperature = true;

    // Miss of the next switch, wavelengths.
    double next() {
        walk();
        const double start = piezo.length(v);
        const Celsius now{sees_temperature ? piezo.temperature_c : 20.0};
        begin_move(config, state, Volts{v});
        const double move_v = predicted_move(config, state, sign_, Volts{v}, now).value();
        v += move_v;
        follow(config, state, Volts{v});
        const double miss = piezo.length(v) - start - 0.5 * sign_;
        arrive(config, state, sign_, Volts{v}, Wavelengths{miss}, now);
        learnt = confirm(state, true);
        sign_ = static_cast<std::int8_t>(-sign_);
        return std::abs(miss);
    }

private:
    void walk() {
        v += walk_v * sign_;
        (void)piezo.length(v);
        follow(config, state, Volts{v});
    }

    std::int8_t sign_ = 1;

public:
    HalfWaveState state = initial_state(config, Volts{150.0});
    bool learnt = true;
};

TEST(HalfWave, KnowsTheHalfWaveVoltageBeforeAnyMove) {
    const HalfWaveState s = initial_state(config, Volts{150.0});
    EXPECT_NEAR(predicted_move(config, s, 1, Volts{150.0}, Celsius{20.0}).value(), 40.0, 0.01);
    EXPECT_NEAR(predicted_move(config, s, -1, Volts{170.0}, Celsius{35.0}).value(), -40.0, 0.01);
}

TEST(HalfWave, OneMoveOfAPiezoWithoutHysteresisTeachesItsHalfWaveVoltage) {
    Switches gyro;
    EXPECT_NEAR(gyro.next(), 0.5 / 41.0, 1e-4);
    EXPECT_LT(gyro.next(), 0.002);
    for (int k = 0; k < 4; ++k) (void)gyro.next();
    EXPECT_LT(gyro.next(), 5e-4);
}

// 4 V before any move; then the noise of one measured length of half a wavelength, 0.001 and a tenth of the miss.
TEST(HalfWave, ItsSigmaIsThatOfALengthAsTheLast) {
    Switches gyro;
    EXPECT_DOUBLE_EQ(sigma(gyro.state, Volts{40.0}).value(), 4.0);
    const double miss = gyro.next();
    EXPECT_NEAR(sigma(gyro.state, Volts{40.0}).value(), 80.0 * std::hypot(0.001, 0.1 * miss), 1e-3);
}

TEST(HalfWave, LearnsALoopThatItsPlaysDoNotDescribe) {
    Switches gyro;
    gyro.piezo.hysteresis = 0.2;
    for (int k = 0; k < 6; ++k) (void)gyro.next();
    for (int k = 0; k < 6; ++k) EXPECT_LT(gyro.next(), 0.002) << k;
}

// The voltage has walked back into the loop since the last switch, more each time: a growing interval.
TEST(HalfWave, TheTurnBackSinceTheLastSwitchIsForeseen) {
    Switches gyro;
    gyro.piezo.hysteresis = 0.2;
    for (int k = 0; k < 24; ++k) {
        gyro.walk_v = 0.3 * k;
        const double miss = gyro.next();
        if (k > 10) EXPECT_LT(miss, 0.004) << k;
    }
    // What a fixed move would have missed over this: its part of the slope that the walk has already turned.
    Piezo walked, straight;
    walked.hysteresis = straight.hysteresis = 0.2;
    for (Piezo* p : {&walked, &straight}) (void)p->length(190.0);
    const double turned = walked.length(183.0);
    const double blind = (turned - walked.length(143.0)) - (straight.length(190.0) - straight.length(150.0));
    EXPECT_GT(std::abs(blind), 0.008);
}

TEST(HalfWave, TemperatureIsFollowedWhereTheIntervalGrows) {
    const auto worst = [](bool sees_temperature) {
        Switches gyro;
        gyro.sees_temperature = sees_temperature;
        gyro.piezo.per_c = 0.004;
        double found = 0.0;
        for (int k = 0; k < 24; ++k) {
            gyro.piezo.temperature_c = 20.0 + 20.0 * std::pow(k / 24.0, 3.0);
            const double miss = gyro.next();
            if (k > 12) found = std::max(found, miss);
        }
        return found;
    };
    EXPECT_LT(worst(true), 0.002);
    EXPECT_GT(worst(false), 0.004);
}

TEST(HalfWave, AnOutlierTeachesNothingAndASecondOneEverything) {
    Switches gyro;
    for (int k = 0; k < 6; ++k) (void)gyro.next();
    gyro.piezo.half_wave_v = 46.0;
    const StrokeWeights before = gyro.state.weight;
    EXPECT_GT(gyro.next(), 0.05);
    EXPECT_FALSE(gyro.learnt);
    EXPECT_EQ(gyro.state.weight, before);
    (void)gyro.next();
    double miss = 1.0;
    for (int k = 0; k < 6; ++k) miss = gyro.next();
    EXPECT_LT(miss, 0.002);
}

TEST(HalfWave, WhatWasNotConfirmedIsForgotten) {
    HalfWaveState s = initial_state(config, Volts{150.0});
    begin_move(config, s, Volts{150.0});
    follow(config, s, Volts{190.0});
    arrive(config, s, 1, Volts{190.0}, Wavelengths{0.05}, Celsius{20.0});
    const StrokeWeights before = s.weight;
    EXPECT_TRUE(confirm(s, false));
    EXPECT_EQ(s.weight, before);
    EXPECT_TRUE(confirm(s, true));
    EXPECT_EQ(s.weight, before);
}

TEST(HalfWave, NothingButFiniteNumbersStayWhateverComesIn) {
    HalfWaveState s = initial_state(config, Volts{not_a_number});
    const double inf = std::numeric_limits<double>::infinity();
    const std::array<double, 8> odd{not_a_number, inf, -inf, 1e300, -1e300, 0.0, 150.0, 0.3};
    for (int k = 0; k < 512; ++k) {
        const double a = odd[static_cast<std::size_t>(k % 8)];
        const double b = odd[static_cast<std::size_t>(k / 8 % 8)];
        const double d = odd[static_cast<std::size_t>(k / 64 % 8)];
        const auto sign = static_cast<std::int8_t>(k % 2 == 0 ? 1 : -1);
        begin_move(config, s, Volts{a});
        follow(config, s, Volts{b});
        arrive(config, s, sign, Volts{b}, Wavelengths{d}, Celsius{a});
        (void)confirm(s, true);
        for (const double weight : s.weight) ASSERT_TRUE(std::isfinite(weight)) << k;
        for (const double play : s.play) ASSERT_TRUE(std::isfinite(play)) << k;
        const double move_v = predicted_move(config, s, sign, Volts{b}, Celsius{a}).value();
        ASSERT_TRUE(sign * move_v >= 20.0 && sign * move_v <= 80.0) << k;
    }
}

}  // namespace zlg::core::half_wave_test
