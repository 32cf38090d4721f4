#include "perimeter/piezo_mirror.hpp"

#include "quiet_gyro.hpp"

namespace zlg::twin::piezo_mirror_test {

constexpr double step_s = 78.125e-6;

TwinConfig with_hysteresis(double hysteresis, double stroke_v) {
    TwinConfig c;
    c.piezo.hysteresis = hysteresis;
    c.piezo.hysteresis_stroke_v = stroke_v;
    return c;
}

// Moves evenly to a voltage; the length there.
double move_to(PiezoMirror& piezo, double& v, double to, int steps = 200) {
    const double from = v;
    double length = 0.0;
    for (int k = 1; k <= steps; ++k) {
        v = from + (to - from) * k / steps;
        length = piezo.move(v);
    }
    return length;
}

// Lengths at the ends and, on the way up and down, at the middle of a loop that has closed. In wavelengths, 80 V each.
struct VoltageLoop {
    double top;
    double bottom;
    double middle_up;
    double middle_down;
};

VoltageLoop loop(const TwinConfig& c, double half_stroke_v) {
    PiezoMirror piezo{c, step_s};
    const double a = half_stroke_v / 80.0;
    double v = 0.0;
    move_to(piezo, v, a);
    const double bottom = move_to(piezo, v, -a);
    const double middle_up = move_to(piezo, v, 0.0);
    const double top = move_to(piezo, v, a);
    return {top, bottom, middle_up, move_to(piezo, v, 0.0)};
}

TEST(PiezoMirror, IsTheVoltageItselfByDefault) {
    PiezoMirror piezo{TwinConfig{}, step_s};
    EXPECT_TRUE(piezo.is_ideal());
    EXPECT_EQ(piezo.length_at(0.3), 0.3);
    EXPECT_EQ(piezo.voltage_for(0.3), 0.3);
}

TEST(PiezoMirror, ALoopOfTheStatedStrokeIsAsWideAsItsFigureSays) {
    for (const double stroke_v : {300.0, 120.0, 40.0, 20.0}) {
        for (const double h : {0.05, 0.12, 0.4}) {
            const VoltageLoop l = loop(with_hysteresis(h, stroke_v), 0.5 * stroke_v);
            EXPECT_NEAR((l.middle_down - l.middle_up) / (l.top - l.bottom), h, 1e-9) << stroke_v << " V, " << h;
        }
    }
}

TEST(PiezoMirror, ALoopOfTheHalfWaveVoltageMovesHalfAWavelength) {
    for (const double stroke_v : {300.0, 40.0, 20.0}) {
        const VoltageLoop l = loop(with_hysteresis(0.12, stroke_v), 20.0);
        EXPECT_NEAR(l.top - l.bottom, 0.5, 1e-9) << stroke_v;
    }
}

TEST(PiezoMirror, TheFirstMoveOfAllIsLonger) {
    // Thresholds up to 20 V: a virgin move of 40 V passes them all, once instead of twice.
    PiezoMirror piezo{with_hysteresis(0.12, 40.0), step_s};
    double v = 0.0;
    EXPECT_NEAR(move_to(piezo, v, 0.5), 0.5 * (0.76 + 0.48 * 0.75), 1e-9);
}

// A unit step of the stroke, from the sum of exponentials computed apart.
TEST(PiezoMirror, CreepGrowsByItsFigureEachDecade) {
    TwinConfig c;
    c.piezo.creep_per_decade = 0.015;
    PiezoMirror piezo{c, 1e-3};
    double length = piezo.move(0.5);
    double after_1_s = 0.0;
    for (int k = 1; k <= 100000; ++k) {
        length = piezo.move(0.5);
        if (k == 1000) after_1_s = length;
        if (k != 100 && k != 10000 && k != 100000) continue;
        double expected = 0.5;
        // The stroke grew evenly within the first step: it is half a step old then.
        for (int d = -2; d <= 4; ++d) expected += 0.5 * 0.015 * -std::expm1(-(k + 0.5) * 1e-3 / std::pow(10.0, d));
        EXPECT_NEAR(length, expected, 2e-6) << k;
    }
    EXPECT_NEAR(length - after_1_s, 0.5 * 0.015 * 2.0, 0.5 * 0.015 * 2.0 * 0.03);
}

TEST(PiezoMirror, CreepIsTheSameInLargeAndSmallStepsOfAnEvenMotion) {
    TwinConfig c;
    c.piezo.creep_per_decade = 0.015;
    PiezoMirror coarse{c, 0.01};
    PiezoMirror fine{c, 0.0001};
    for (int k = 1; k <= 50; ++k) {
        const double length = coarse.move(0.01 * k);
        double exact = 0.0;
        for (int j = 1; j <= 100; ++j) exact = fine.move(0.01 * (k - 1) + 0.0001 * j);
        ASSERT_NEAR(length, exact, 1e-12) << k;
    }
}

// The lag of an even motion and the ringing when it stops, in closed form.
TEST(PiezoMirror, TheMirrorRingsAsAnOscillatorOfSecondOrder) {
    TwinConfig c;
    c.piezo.mirror_hz = 5000.0;
    PiezoMirror piezo{c, step_s};
    const double w = 2.0 * std::numbers::pi * 5000.0;
    const double ringing = w * std::sqrt(1.0 - 0.0025);
    const double rate_s = 50.0;  // wavelengths a second: 4 V/ms
    double v = 0.0;
    for (int k = 1; k <= 400; ++k) {
        const double t = k * step_s;
        v = rate_s * t;
        const double lag_s = 0.1 / w;
        const double decay = std::exp(-0.05 * w * t);
        const double b_s = (0.05 * w * lag_s - 1.0) / ringing;
        const double expected =
            rate_s * (t - lag_s + decay * (lag_s * std::cos(ringing * t) + b_s * std::sin(ringing * t)));
        ASSERT_NEAR(piezo.move(v), expected, 1e-12) << k;
    }
}

TEST(PiezoMirror, TheVoltageForALengthLeadsThere) {
    TwinConfig c = with_hysteresis(0.12, 40.0);
    c.piezo.creep_per_decade = 0.015;
    PiezoMirror piezo{c, step_s};
    double v = 0.0;
    move_to(piezo, v, 0.4);
    for (const double length : {0.3, -0.7, 0.9, 0.41}) {
        const double target = piezo.voltage_for(length);
        EXPECT_NEAR(piezo.length_at(target), length, 1e-12);
        piezo.jump(target);
        EXPECT_NEAR(piezo.length_at(target), length, 1e-12);
    }
}

TEST(PiezoMirror, EveryLengthGrowsWithTheHalfWave) {
    TwinConfig c = with_hysteresis(0.12, 40.0);
    c.piezo.creep_per_decade = 0.015;
    c.piezo.mirror_hz = 5000.0;
    PiezoMirror piezo{c, step_s};
    PiezoMirror grown{c, step_s};
    double v = 0.0;
    move_to(piezo, v, 0.4);
    v = 0.0;
    move_to(grown, v, 0.4);
    grown.scale(1.1);
    for (const double at : {0.41, 0.3, 0.0, -0.2}) EXPECT_NEAR(grown.move(1.1 * at), 1.1 * piezo.move(at), 1e-13);
}

// The whole twin with its piezo: the miss asked for, the drive, the light.
TEST(PiezoMirror, TheMissIsPutInPlaceThroughHysteresisAndCreep) {
    for (const Loop kind : {Loop::analog, Loop::digital}) {
        TwinConfig c = quiet_gyro();
        c.perimeter.loop = kind;
        c.perimeter.tau_s = 0.05;
        c.perimeter.miss_lambda = 0.17;
        c.piezo.hysteresis = 0.12;
        c.piezo.hysteresis_stroke_v = 40.0;
        c.piezo.creep_per_decade = 0.015;
        c.piezo.mirror_hz = 5000.0;
        Twin twin{c, Motion::rest()};
        int polarity = 1;
        double from_v = 150.0;
        for (const double target_v : {190.0, 150.0, 110.0, 150.0, 190.0}) {
            polarity = -polarity;
            advance(twin, frame(false, polarity, target_v), 7);
            const TwinHalf half = advance(twin, frame(true, polarity, target_v), 1).back();
            // Within the half that follows, creep moves on by a small part of a decade, and the analog loop by
            // 0.09 wavelength a time constant.
            const double miss = target_v > from_v ? -0.17 : 0.17;
            EXPECT_NEAR(half.truth.detuning_end_lambda, miss, kind == Loop::analog ? 6.5e-3 : 2e-3) << target_v;
            // Near the centre, by the loop or by what a processor's own adds: the next switch is one out of a held
            // mode.
            advance(twin, frame(true, polarity, target_v - 80.0 * miss), 400);
            from_v = target_v;
        }
    }
}

TEST(PiezoMirror, TheAnalogLoopPullsInThroughAllOfIt) {
    TwinConfig c = quiet_gyro();
    c.perimeter.miss_lambda = 0.2;
    c.piezo.hysteresis = 0.12;
    c.piezo.hysteresis_stroke_v = 40.0;
    c.piezo.creep_per_decade = 0.015;
    c.piezo.mirror_hz = 5000.0;
    const std::vector<TwinHalf> halves = relocked(c, 190.0, 80);
    EXPECT_LT(std::abs(halves[19].truth.detuning_end_lambda), 0.02);
    EXPECT_LT(std::abs(halves[79].truth.detuning_end_lambda), 1e-3);
}

TEST(PiezoMirror, RefusesWhatNoPlayOperatorsGiveAndTheIdealisedLoop) {
    const auto refused = [](auto change) {
        TwinConfig c;
        change(c);
        EXPECT_THROW((Twin{c, Motion::rest()}), std::invalid_argument);
    };
    refused([](TwinConfig& c) { c.piezo.hysteresis_stroke_v = 0.0; });
    refused([](TwinConfig& c) {
        c.perimeter.loop = Loop::exponential;
        c.piezo.mirror_hz = 5000.0;
    });
    refused([](TwinConfig& c) {
        c.piezo.hysteresis = 0.1;
        c.piezo.range_max_v = 110.0;
    });
}

}  // namespace zlg::twin::piezo_mirror_test
