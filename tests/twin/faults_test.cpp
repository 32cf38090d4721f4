#include <zlg/twin/faults.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <zlg/twin/twin.hpp>

#include "counter_limit.hpp"
#include "quiet_gyro.hpp"

namespace zlg::twin {
namespace {

constexpr double half_s = 0.0025;

// A quiet gyro whose light, counter and converters have nothing but the fault.
std::vector<TwinHalf> with_faults(TwinConfig config, std::vector<Fault> faults, int n_halves,
                                  const Motion& motion = Motion::rest()) {
    config.faults = std::move(faults);
    Twin twin{config, motion};
    return advance(twin, frame(true, 1), n_halves);
}

std::vector<TwinHalf> with_fault(FaultKind kind, double at_s, double duration_s, double size, int n_halves) {
    return with_faults(quiet_gyro(), {{kind, at_s, duration_s, size}}, n_halves);
}

std::int64_t counts(const std::vector<TwinHalf>& halves, std::size_t h) {
    return count_between(halves[h - 1], halves[h]);
}

double light_ratio(const core::SensorFrame& s, std::size_t k) { return double{s.light_a[k]} / double{s.light_b[k]}; }

bool same_bits(const TwinHalf& a, const TwinHalf& b) {
    return a.sensor.counter == b.sensor.counter && a.sensor.light_a == b.sensor.light_a &&
           a.sensor.light_b == b.sensor.light_b && a.sensor.piezo_v == b.sensor.piezo_v &&
           a.sensor.coil_current_a == b.sensor.coil_current_a && a.sensor.temperature_c == b.sensor.temperature_c &&
           a.sensor.sequence == b.sensor.sequence && a.sensor.timer_ticks == b.sensor.timer_ticks &&
           a.sensor.status == b.sensor.status && a.truth.dtheta_arcsec == b.truth.dtheta_arcsec &&
           a.truth.detuning_end_lambda == b.truth.detuning_end_lambda;
}

void expect_same(const TwinConfig& with, const TwinConfig& without, int n_halves) {
    Twin a{with, Motion::sines(5000.0, {})};
    Twin b{without, Motion::sines(5000.0, {})};
    for (int h = 0; h < n_halves; ++h) {
        const auto command = frame(h % 100 > 6, h / 100 % 2 == 0 ? 1 : -1, 150.0 + 40.0 * (h / 100 % 2));
        ASSERT_TRUE(same_bits(a.advance(command), b.advance(command))) << "half " << h;
    }
}

TEST(Faults, NoneChangesNothingBeforeItBegins) {
    for (const Fidelity fidelity : {Fidelity::averaged, Fidelity::laser}) {
        TwinConfig without;
        without.fidelity = fidelity;
        without.bias_temperature_coefficient_per_c = -5e-4;
        for (const FaultKind kind : all_fault_kinds) {
            // Its table must reach farther from the start on; its light is the same to 1e-4 only.
            if (fidelity == Fidelity::laser && kind != FaultKind::shock) continue;
            TwinConfig with = without;
            with.faults = {random_fault(kind, 1.0, 3)};
            expect_same(with, without, 399);
        }
    }
}

TEST(Faults, EachKindMakesADifferenceAndTheSameAgain) {
    for (const FaultKind kind : all_fault_kinds) {
        // At an opening of the loop, and long enough to hold one.
        Fault fault = random_fault(kind, 0.4 * half_s, 5);
        fault.duration_s = std::max(fault.duration_s, 1.5);
        if (kind == FaultKind::overspeed) fault.size = std::copysign(fault.size, 1.0);
        TwinConfig with;
        with.faults = {fault};
        with.counter_max_hz = 502e3;
        TwinConfig without;
        without.counter_max_hz = 502e3;
        Twin a{with, Motion::rest()};
        Twin again{with, Motion::rest()};
        Twin b{without, Motion::rest()};
        bool differs = false;
        for (int h = 0; h < 600; ++h) {
            const auto command = frame(h % 200 > 6, h / 200 % 2 == 0 ? 1 : -1, 150.0 + 40.0 * (h / 200 % 2));
            const TwinHalf one = a.advance(command);
            const TwinHalf two = again.advance(command);
            // A difference from itself where a field is NaN is none.
            const auto has_nan = [](const auto& samples) {
                return std::ranges::any_of(samples, [](float x) { return std::isnan(x); });
            };
            if (!has_nan(one.sensor.light_a) && !std::isnan(one.sensor.piezo_v) &&
                !std::isnan(one.sensor.temperature_c))
                ASSERT_TRUE(same_bits(one, two)) << facts(kind).name;
            if (!same_bits(one, b.advance(command))) differs = true;
        }
        EXPECT_TRUE(differs) << facts(kind).name;
    }
}

TEST(Faults, LaserThatIsOffGivesNoLightAndGarbageUntilItIsBack) {
    const auto halves = with_fault(FaultKind::laser_off, 10 * half_s, 4 * half_s, 0.0, 30);
    for (std::size_t h = 1; h < 30; ++h) {
        const bool is_off = h >= 10 && h < 14;
        EXPECT_EQ(halves[h].truth.lit, !is_off);
        EXPECT_NEAR(halves[h].sensor.light_a[7], is_off ? 0.0 : 1000.0, 1e-3);
        EXPECT_NEAR(halves[h].sensor.light_b[7], is_off ? 0.0 : 1000.0, 1e-3);
        if (!is_off) EXPECT_NEAR(static_cast<double>(std::abs(counts(halves, h))), 150.0, 1.0);
    }
}

TEST(Faults, LightThatFadesIsLeastInTheMiddle) {
    const auto halves = with_fault(FaultKind::beam_fades, 0.0, 16 * half_s, 0.6, 20);
    // The middle of sample 7 lies (7 + 0.5)/16 into its half.
    const auto expected = [](std::size_t h) {
        const double depth = std::sin(std::numbers::pi * (static_cast<double>(h) + 7.5 / 16.0) / 16.0);
        return 1000.0 * (1.0 - 0.6 * depth * depth);
    };
    for (const std::size_t h : {0u, 4u, 8u, 12u}) EXPECT_NEAR(halves[h].sensor.light_a[7], expected(h), 0.01) << h;
    for (const TwinHalf& half : halves) EXPECT_NEAR(half.sensor.light_b[3], 1000.0, 0.01);
    for (const TwinHalf& half : halves) EXPECT_TRUE(half.truth.lit);
}

// The loop holds its integrator in the dark: what the block does meanwhile is found as detuning afterwards.
TEST(Faults, TheAnalogLoopHoldsInTheDark) {
    TwinConfig config = quiet_gyro();
    const auto halves = with_faults(config,
                                    {{FaultKind::laser_off, 10 * half_s, 10 * half_s, 0.0},
                                     {FaultKind::perimeter_ramp, 12 * half_s, 4 * half_s, 2.0}},
                                    21);
    EXPECT_NEAR(halves[19].truth.perimeter_v, halves[9].truth.perimeter_v, 1e-6);
    EXPECT_NEAR(halves[19].truth.detuning_end_lambda, 2.0 * 4 * half_s, 1e-6);
}

TEST(Faults, LengthsThatStayAreTakenUpByTheVoltage) {
    // U_lambda/2 = 40 V: 80 V a wavelength, against the growth.
    const double start_v = with_faults(quiet_gyro(), {}, 1).front().truth.perimeter_v;
    struct Case {
        FaultKind kind;
        double duration_s, size, grown_lambda;
    };
    for (const Case& c : {Case{FaultKind::piezo_step, 0.01, 0.1, 0.1}, Case{FaultKind::piezo_step, 0.0, -0.1, -0.1},
                          Case{FaultKind::perimeter_ramp, 0.5, 0.6, 0.3}}) {
        const auto halves = with_fault(c.kind, 0.1, c.duration_s, c.size, 500);
        EXPECT_NEAR(halves.back().truth.perimeter_v, start_v - 80.0 * c.grown_lambda, 0.01) << facts(c.kind).name;
        EXPECT_NEAR(halves.back().truth.detuning_end_lambda, 0.0, 1e-4);
    }
    // By half a wavelength another mode lases, from which the loop of the old polarity drives the length away.
    const auto hop = with_fault(FaultKind::mode_hop, 0.1, 0.0, 0.48, 500);
    // The lag of the high voltage makes it slower than the loop alone.
    EXPECT_LT(hop[40].truth.detuning_end_lambda, -0.02);
    EXPECT_GT(hop[40].truth.detuning_end_lambda, -0.02 * std::exp(half_s / 0.0065));
    EXPECT_FALSE(hop.back().truth.lit) << "until the processor helps it";
}

// A held perimeter shows the disturbance itself.
TEST(Faults, VibrationAndShockDetuneThePerimeter) {
    TwinConfig config = held_gyro();
    config.vibration_hz = 100.0;  // 4 halves a period
    const auto swing = with_faults(config, {{FaultKind::vibration, 4 * half_s, 8 * half_s, 0.1}}, 20);
    const double at_rest = swing[0].truth.detuning_end_lambda;
    for (std::size_t h = 0; h < 20; ++h) {
        const double phase = 0.5 * std::numbers::pi * (static_cast<double>(h) + 1.0 - 4.0);
        const double expected = h >= 4 && h < 11 ? 0.1 * std::sin(phase) : 0.0;
        EXPECT_NEAR(swing[h].truth.detuning_end_lambda - at_rest, expected, 1e-9) << h;
    }
    const auto bulge = with_faults(config, {{FaultKind::shock, 4 * half_s, 4 * half_s, -0.2}}, 12);
    EXPECT_NEAR(bulge[5].truth.detuning_end_lambda - at_rest, -0.2, 1e-9);
    EXPECT_NEAR(bulge[4].truth.detuning_end_lambda - at_rest, -0.2 * std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(bulge[9].truth.detuning_end_lambda - at_rest, 0.0, 1e-12);
}

TEST(Faults, ASwitchIsSentOffItsTarget) {
    for (const double miss_lambda : {0.0, 0.1}) {
        const auto landed = [&](std::vector<Fault> faults) {
            TwinConfig config = quiet_gyro();
            config.miss_lambda = miss_lambda;
            config.faults = std::move(faults);
            Twin twin{config, Motion::rest()};
            advance(twin, frame(true, 1), 4);
            const double from_v = advance(twin, frame(false, -1, 190.0), 6).back().truth.perimeter_v;
            return std::pair{from_v, twin.advance(frame(true, -1, 190.0)).truth.detuning_end_lambda};
        };
        const auto good = landed({});
        const auto wrong = landed({{FaultKind::switch_wrong_mode, 2 * half_s, 10 * half_s, -0.4}});
        const auto late = landed({{FaultKind::switch_no_mode, 6 * half_s, 10 * half_s, 0.25}});
        EXPECT_NEAR(wrong.first - good.first, -0.4 * 80.0, 0.5) << miss_lambda;
        EXPECT_EQ(late.first, good.first) << "a loop that is open already has its target";
    }
}

TEST(Faults, AnotherHalfWaveVoltageChangesTheLengthOfAVoltage) {
    TwinConfig config = held_gyro();
    config.faults = {{FaultKind::half_wave_error, 2 * half_s, 4 * half_s, 0.25}};
    Twin twin{config, Motion::rest()};
    // 166 V is 16 V off the middle: 0.2 wavelength, and 0.16 where half a wave takes 50 V.
    const auto halves = advance(twin, frame(true, 1, 166.0), 8);
    EXPECT_NEAR(halves[5].truth.detuning_end_lambda, 0.16, 2e-3);
    EXPECT_NEAR(halves[7].truth.detuning_end_lambda, 0.20, 2e-3);
}

TEST(Faults, AThermalShockIsReadAndMovesThePerimeter) {
    TwinConfig config = held_gyro();
    config.temperature_rise_c = 0.0;
    config.expansion_lambda_per_c = 0.025;
    config.bias_temperature_coefficient_per_c = -1e-3;
    const auto halves = with_faults(config, {{FaultKind::thermal_shock, 4 * half_s, 4 * half_s, 8.0}}, 40);
    EXPECT_DOUBLE_EQ(halves[3].sensor.temperature_c, 20.0);
    EXPECT_NEAR(halves[5].sensor.temperature_c, 24.0, 1e-9);
    EXPECT_NEAR(halves[39].sensor.temperature_c, 28.0, 1e-9);
    EXPECT_NEAR(halves[39].truth.detuning_end_lambda - halves[3].truth.detuning_end_lambda, 0.2, 1e-9);
    // (1 - 8e-3)(1 - 3.6 0.2^2) of 150 counts, the share of the reversals left out.
    EXPECT_NEAR(static_cast<double>(std::abs(counts(halves, 38))), 150.0 * 0.992 * (1.0 - 3.6 * 0.04), 1.5);
}

TEST(Faults, ConvertersOfLightStickSaturateAndFail) {
    TwinConfig noisy = quiet_gyro();
    noisy.light_noise_lambda = 0.0033;
    const auto stuck = with_faults(noisy, {{FaultKind::light_stuck, 4 * half_s, 2 * half_s, 0.0}}, 8);
    for (const std::size_t h : {4u, 5u}) {
        for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(stuck[h].sensor.light_a[k], stuck[3].sensor.light_a[15]);
        EXPECT_NE(stuck[h].sensor.light_b[0], stuck[h].sensor.light_b[1]);
    }
    EXPECT_NE(stuck[6].sensor.light_a[0], stuck[6].sensor.light_a[1]);
    const auto both = with_faults(noisy, {{FaultKind::light_stuck, 4 * half_s, 2 * half_s, 2.0}}, 8);
    EXPECT_EQ(both[5].sensor.light_a[3], both[3].sensor.light_a[15]);
    EXPECT_EQ(both[5].sensor.light_b[3], both[3].sensor.light_b[15]);

    const auto saturated = with_faults(noisy, {{FaultKind::light_saturated, 4 * half_s, 2 * half_s, 0.8}}, 8);
    EXPECT_EQ(saturated[4].sensor.light_a[0], 800.0f);
    EXPECT_EQ(saturated[5].sensor.light_b[15], 800.0f);
    EXPECT_GT(saturated[6].sensor.light_a[0], 800.0f);

    // From the middle of the half on: samples 8 .. 15.
    const auto nan = with_fault(FaultKind::light_nan, 4.5 * half_s, 0.5 * half_s, 0.0, 8);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(std::isnan(nan[4].sensor.light_a[k]), k >= 8) << k;
    EXPECT_FALSE(std::isnan(nan[5].sensor.light_b[0]));
}

TEST(Faults, NoisyLightHasTheNoiseAskedFor) {
    const auto halves = with_fault(FaultKind::light_noisy, 0.0, 1000 * half_s, 0.05, 1000);
    double sum = 0.0;
    for (const TwinHalf& h : halves) {
        for (std::size_t k = 0; k < 16; ++k) sum += std::pow(h.sensor.light_a[k] - 1000.0, 2.0);
    }
    // 16 000 samples: the standard deviation is known to 0.6 %.
    EXPECT_NEAR(std::sqrt(sum / 16000.0), 50.0, 1.5);
}

TEST(Faults, SlowConvertersStickAndFail) {
    TwinConfig config = quiet_gyro();
    config.adc_noise_v = 1.0;
    const auto stuck = with_faults(config, {{FaultKind::piezo_adc_stuck, 4.5 * half_s, 3 * half_s, 0.0}}, 10);
    for (const std::size_t h : {4u, 5u, 6u}) EXPECT_EQ(stuck[h].sensor.piezo_v, stuck[3].sensor.piezo_v) << h;
    EXPECT_NE(stuck[7].sensor.piezo_v, stuck[6].sensor.piezo_v);
    const auto nan = with_faults(config,
                                 {{FaultKind::piezo_adc_nan, 4.5 * half_s, 3 * half_s, 0.0},
                                  {FaultKind::temperature_nan, 5.5 * half_s, 3 * half_s, 0.0}},
                                 10);
    for (std::size_t h = 0; h < 10; ++h) {
        EXPECT_EQ(std::isnan(nan[h].sensor.piezo_v), h >= 4 && h < 7) << h;
        EXPECT_EQ(std::isnan(nan[h].sensor.temperature_c), h >= 5 && h < 8) << h;
    }
}

TEST(Faults, AStuckBitOfTheCounterReadsOne) {
    const auto good = with_faults(quiet_gyro(), {}, 40);
    const auto halves = with_fault(FaultKind::counter_bit_stuck, 4.5 * half_s, 30 * half_s, 3.0, 40);
    for (std::size_t h = 0; h < 40; ++h) {
        const std::uint64_t bit = h >= 4 && h < 34 ? 8 : 0;
        EXPECT_EQ(halves[h].sensor.counter, good[h].sensor.counter | bit) << h;
    }
}

// What the processor gets: numbers of the frames, and which of them are marked as missed.
struct Delivered {
    std::vector<int> sequence;
    std::set<int> missed;
};

Delivered delivered(FaultKind kind, double halves) {
    Delivered got;
    int h = 0;
    for (const TwinHalf& half : with_fault(kind, 4.5 * half_s, halves * half_s, 0.0, 10)) {
        got.sequence.push_back(static_cast<int>(half.sensor.sequence));
        if (half.sensor.status & core::frame_missed) got.missed.insert(h);
        ++h;
    }
    return got;
}

TEST(Faults, FramesAreMissedRepeatedOrLate) {
    const Delivered missed = delivered(FaultKind::frame_missed, 2.0);
    EXPECT_EQ(missed.missed, (std::set<int>{4, 5}));
    EXPECT_EQ(missed.sequence, (std::vector<int>{0, 1, 2, 3, 3, 3, 6, 7, 8, 9}));
    const Delivered repeated = delivered(FaultKind::frame_repeated, 2.0);
    EXPECT_TRUE(repeated.missed.empty());
    EXPECT_EQ(repeated.sequence, (std::vector<int>{0, 1, 2, 3, 3, 3, 6, 7, 8, 9}));
    // Frame 4 comes with 5, frame 5 with 6; that of 6 is overtaken by 7, which is in time.
    const Delivered late = delivered(FaultKind::frame_late, 3.0);
    EXPECT_EQ(late.missed, std::set<int>{4});
    EXPECT_EQ(late.sequence, (std::vector<int>{0, 1, 2, 3, 3, 4, 5, 7, 8, 9}));
}

TEST(Faults, AFrameThatIsMissedTakesItsCountsToTheNext) {
    const auto good = with_faults(quiet_gyro(), {}, 10);
    const auto missed = with_fault(FaultKind::frame_missed, 4.5 * half_s, 2 * half_s, 0.0, 10);
    EXPECT_EQ(missed[6].sensor.counter, good[6].sensor.counter);
}

TEST(Faults, TheCoilTellsWhatHappensToTheBias) {
    const auto lost = with_fault(FaultKind::bias_lost, 4 * half_s, 4 * half_s, 0.5, 12);
    const auto skewed = with_fault(FaultKind::bias_asymmetric, 4 * half_s, 4 * half_s, 0.04, 12);
    for (std::size_t h = 1; h < 12; ++h) {
        const bool acts = h >= 4 && h < 8;
        const int sign = h % 2 == 0 ? 1 : -1;
        const double of_lost = acts ? 0.5 : 1.0;
        const double of_skewed = acts ? 1.0 + 0.04 * sign : 1.0;
        EXPECT_NEAR(lost[h].sensor.coil_current_a, sign * of_lost, 1e-3);
        EXPECT_NEAR(skewed[h].sensor.coil_current_a, sign * of_skewed, 1e-3);
        EXPECT_NEAR(static_cast<double>(counts(lost, h)), sign * 150.0 * of_lost, 1.0) << h;
        EXPECT_NEAR(static_cast<double>(counts(skewed, h)), sign * 150.0 * of_skewed, 1.0) << h;
    }
}

TEST(Faults, TheCurrentIsReadWithNoiseAndInCodes) {
    TwinConfig config = quiet_gyro();
    config.coil_noise_a = 0.01;
    const auto halves = with_faults(config, {}, 2000);
    double sum = 0.0;
    for (const TwinHalf& h : halves) {
        EXPECT_EQ(std::remainder(h.sensor.coil_current_a, 4.0 / 4096.0), 0.0);
        sum += std::pow(h.sensor.coil_current_a - h.sensor.bias_sign, 2.0);
    }
    EXPECT_NEAR(std::sqrt(sum / 2000.0), 0.01, 0.0007);
}

TEST(Faults, AFieldPulseTurnsWithTheMode) {
    const auto drift = [](int polarity, double set_point_v) {
        TwinConfig config = held_gyro();
        config.faults = {{FaultKind::field_pulse, 100 * half_s, 400 * half_s, 10.0}};
        Twin twin{config, Motion::rest()};
        const auto halves = advance(twin, frame(true, polarity, set_point_v), 500);
        return count_between(halves[99], halves[499]);
    };
    // 10 Hz for a second.
    EXPECT_NEAR(static_cast<double>(drift(1, 150.0)), 10.0, 1.0);
    EXPECT_NEAR(static_cast<double>(drift(-1, 190.0)), -10.0, 1.0);
}

// The mean of sin^2 is a half, so a burst turns the case by half of its height times its time.
TEST(Faults, ABurstOfRotationIsPartOfTheTruth) {
    const auto halves = with_fault(FaultKind::overspeed, 10.3 * half_s, 20 * half_s, 2e5, 60);
    double sum = 0.0;
    for (const TwinHalf& h : halves) sum += h.truth.dtheta_arcsec;
    EXPECT_NEAR(sum, 0.5 * 2e5 * 20 * half_s, 1e-6);
    EXPECT_NEAR(static_cast<double>(halves[59].sensor.counter - halves[1].sensor.counter), sum / 3.263, 2.0);
    EXPECT_EQ(halves[9].truth.dtheta_arcsec, 0.0);
    EXPECT_EQ(halves[31].truth.dtheta_arcsec, 0.0);
}

TEST(Faults, BeyondItsRateTheCounterLosesCounts) {
    TwinConfig config = quiet_gyro();
    config.counter_max_hz = 502e3;
    // 2000 deg/s for two seconds' burst: far beyond at its height.
    const auto halves = with_faults(config, {{FaultKind::overspeed, 0.0, 1.0, 7.2e6}}, 400);
    // 502 kHz for 2.5 ms.
    for (const std::size_t h : {199u, 200u, 201u}) EXPECT_EQ(counts(halves, h), 1255);
    for (std::size_t h = 1; h < 400; ++h) EXPECT_LE(counts(halves, h), 1255);
}

TEST(Faults, CounterLimitFollowsUpToItsRate) {
    CounterLimit limit{1000.0};
    EXPECT_EQ(limit.shown(7, 0.01), 7u);
    EXPECT_EQ(limit.shown(17, 0.01), 17u);
    EXPECT_EQ(limit.shown(40, 0.01), 27u);
    EXPECT_EQ(limit.shown(39, 0.01), 26u);
    EXPECT_EQ(limit.shown(0, 0.01), 16u);
    EXPECT_EQ(limit.shown(50, 0.02), 36u);
    CounterLimit none{std::numeric_limits<double>::infinity()};
    EXPECT_EQ(none.shown(std::uint64_t{1} << 62, 0.01), std::uint64_t{1} << 62);
}

TEST(Faults, ALaserObeysTheSameFaults) {
    const auto lived = [](std::vector<Fault> faults) {
        TwinConfig config = quiet_gyro();
        config.fidelity = Fidelity::laser;
        config.faults = std::move(faults);
        Twin twin{config, Motion::rest()};
        return advance(twin, frame(true, 1), 12);
    };
    const auto good = lived({});
    const auto off = lived({{FaultKind::laser_off, 4 * half_s, 4 * half_s, 0.0}});
    EXPECT_TRUE(off[3].truth.lit);
    EXPECT_FALSE(off[5].truth.lit);
    EXPECT_TRUE(off[9].truth.lit);
    EXPECT_NEAR(off[5].sensor.light_a[3], 0.0, 1e-3);
    const auto lost = lived({{FaultKind::bias_lost, 4 * half_s, 4 * half_s, 0.5}});
    // f0 is proportional to the field within some per cent.
    EXPECT_NEAR(static_cast<double>(counts(lost, 6)) / static_cast<double>(counts(good, 6)), 0.5, 0.03);
    const auto skewed = lived({{FaultKind::bias_asymmetric, 4 * half_s, 4 * half_s, 0.1}});
    EXPECT_NEAR(static_cast<double>(counts(skewed, 6)) / static_cast<double>(counts(good, 6)), 1.1, 0.02);
    const auto faded = lived({{FaultKind::beam_fades, 4 * half_s, 4 * half_s, 1.0}});
    EXPECT_LT(light_ratio(faded[5].sensor, 15), 0.05);
    EXPECT_NEAR(light_ratio(faded[9].sensor, 0), light_ratio(good[9].sensor, 0), 1e-6);
}

TEST(Faults, RandomOnesAreAllowed) {
    for (const FaultKind kind : all_fault_kinds) {
        const FaultFacts& f = facts(kind);
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            const Fault fault = random_fault(kind, 1.5, seed);
            ASSERT_EQ(fault.kind, kind);
            ASSERT_EQ(fault.at_s, 1.5);
            ASSERT_TRUE(fault.duration_s >= f.random_s.least && fault.duration_s <= f.random_s.most) << f.name;
            ASSERT_TRUE(fault.size >= f.size.least && fault.size <= f.size.most) << f.name;
            ASSERT_TRUE(std::abs(fault.size) >= f.random_size.least && std::abs(fault.size) <= f.random_size.most)
                << f.name;
        }
    }
}

TEST(Faults, RandomOnesComeAsOftenAsAskedAndFromTheirSeed) {
    const auto faults = random_faults(360.0, 1e5, 7, {});
    // 10 000 expected, with a standard deviation of 100.
    EXPECT_NEAR(static_cast<double>(faults.size()), 1e4, 400.0);
    EXPECT_TRUE(std::ranges::is_sorted(faults, {}, &Fault::at_s));
    std::vector<int> of_kind(n_fault_kinds);
    for (const Fault& f : faults) ++of_kind[static_cast<std::size_t>(f.kind)];
    for (const int n : of_kind) EXPECT_NEAR(n, 1e4 / 26.0, 100.0);
    const auto again = random_faults(360.0, 1e5, 7, {});
    ASSERT_EQ(again.size(), faults.size());
    EXPECT_TRUE(std::ranges::equal(again, faults, {}, &Fault::size, &Fault::size));
    EXPECT_NE(random_faults(360.0, 1e5, 8, {}).front().at_s, faults.front().at_s);
    const std::vector only{FaultKind::shock};
    for (const Fault& f : random_faults(360.0, 1e4, 7, only)) EXPECT_EQ(f.kind, FaultKind::shock);
    EXPECT_TRUE(random_faults(0.0, 1e5, 7, {}).empty());
    EXPECT_THROW((void)random_faults(-1.0, 1e5, 7, {}), std::invalid_argument);
    EXPECT_THROW((void)random_faults(std::nan(""), 1e5, 7, {}), std::invalid_argument);
    EXPECT_THROW((void)random_faults(1e9, 1e9, 7, {}), std::invalid_argument);
}

std::string complaint(const Fault& fault, LoopKind loop = LoopKind::analog) {
    TwinConfig config = quiet_gyro();
    config.loop = loop;
    config.faults = {fault};
    try {
        Twin twin{config, Motion::rest()};
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

TEST(Faults, WhatCannotBeIsRefused) {
    EXPECT_EQ(complaint({FaultKind::beam_fades, 1.0, 1.0, 1.5}),
              "fault beam_fades: faults.size is 1.5, allowed is 0..1");
    EXPECT_EQ(complaint({FaultKind::shock, -1.0, 1.0, 0.1}),
              "fault shock: faults.at_s is -1, allowed is 0..1000000000");
    EXPECT_NE(complaint({FaultKind::shock, 0.0, std::nan(""), 0.1}), "none");
    EXPECT_NE(complaint({FaultKind::counter_bit_stuck, 0.0, 1.0, 64.0}), "none");
    EXPECT_NE(complaint({static_cast<FaultKind>(99), 0.0, 1.0, 0.0}), "none");
    EXPECT_NE(complaint({FaultKind::mode_hop, 0.0, 1.0, 0.5}, LoopKind::exponential).find("exponential loop"),
              std::string::npos);
    EXPECT_EQ(complaint({FaultKind::frame_late, 0.0, 1.0, 0.0}, LoopKind::exponential), "none");
    EXPECT_EQ(complaint({FaultKind::mode_hop, 0.0, 1.0, 0.5}), "none");
}

}  // namespace
}  // namespace zlg::twin
