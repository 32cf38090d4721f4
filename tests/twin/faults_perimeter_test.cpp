// Faults that move the perimeter.

#include "faults_support.hpp"

namespace zlg::twin::faults_perimeter_test {

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

// <1 - chi dl^2> of dl = A sin is 1 - chi A^2/2, whatever the frequency: also at the rate of the light samples, 6400
// Hz, and its multiples.
TEST(Faults, AVibrationWeakensTheBiasBySizeAtEveryFrequency) {
    constexpr int n_halves = 400;
    for (const int light_samples : {4, 16, 64}) {
        for (const double vibration_hz : {170.0, 1000.0, 3200.0, 6400.0, 6400.2, 12800.0, 25600.0}) {
            TwinConfig config = held_gyro();
            config.gyro.light_samples = light_samples;
            config.gyro.scale_arcsec = 1e-3;
            config.gyro.bias_hz = 6e7;  // so that a count is little
            config.vibration_hz = vibration_hz;
            const auto halves = with_faults(config, {{FaultKind::vibration, 0.0, 1e3, 0.05}}, n_halves);
            double sum = 0.0;
            for (std::size_t h = 1; h < halves.size(); ++h) sum += std::abs(static_cast<double>(counts(halves, h)));
            const double bias = config.gyro.bias_hz * half_s;
            EXPECT_NEAR(sum / (n_halves - 1) / bias, 1.0 - config.gyro.bias_chi * 0.5 * 0.05 * 0.05, 5e-5)
                << vibration_hz << " Hz, " << light_samples << " samples";
        }
    }
}

TEST(Faults, WhatIsTooQuickForTheTwinIsRefused) {
    TwinConfig config = quiet_gyro();
    config.vibration_hz = 110e3;
    config.faults = {{FaultKind::vibration, 0.0, 1.0, 0.05}};
    EXPECT_THROW((Twin{config, Motion::rest()}), std::invalid_argument);
    config.vibration_hz = 100e3;
    EXPECT_NO_THROW((Twin{config, Motion::rest()}));
    config.faults = {{FaultKind::shock, 0.0, 20e-6, 0.05}};
    EXPECT_THROW((Twin{config, Motion::rest()}), std::invalid_argument);
    config.faults = {{FaultKind::shock, 0.0, 30e-6, 0.05}};
    EXPECT_NO_THROW((Twin{config, Motion::rest()}));
}

// The second shock turns the bias over, the first alone does not; one that takes back what the gyro warms by is
// allowed.
TEST(Faults, AThermalShockThatTurnsTheBiasOverIsRefused) {
    TwinConfig config = quiet_gyro();
    config.gyro.temperature_rise_c = 0.0;
    config.gyro.bias_temperature_coefficient_per_c = -0.02;
    config.faults = {{FaultKind::thermal_shock, 1.0, 1.0, 30.0}};
    EXPECT_NO_THROW((Twin{config, Motion::rest()}));
    config.faults.push_back({FaultKind::thermal_shock, 5.0, 1.0, 30.0});
    EXPECT_THROW((Twin{config, Motion::rest()}), std::invalid_argument);
    config.faults.push_back({FaultKind::thermal_shock, 3.0, 1.0, -30.0});
    EXPECT_NO_THROW((Twin{config, Motion::rest()}));
    config.gyro.temperature_rise_c = 25.0;
    EXPECT_THROW((Twin{config, Motion::rest()}), std::invalid_argument);
}

// int (A sin(pi t/T))^2 dt = A^2 T/2, however short the shock.
TEST(Faults, AShockCostsItsSquareHoweverShort) {
    for (const double duration_s : {50e-6, 200e-6, 1e-3}) {
        TwinConfig config = held_gyro();
        config.gyro.scale_arcsec = 1e-3;
        config.gyro.bias_hz = 2e8;  // so that a count is little
        const auto halves = with_faults(config, {{FaultKind::shock, 0.00601, duration_s, 0.2}}, 4);
        const double lost = 2e8 * half_s - std::abs(static_cast<double>(counts(halves, 2)));
        const double expected = 2e8 * config.gyro.bias_chi * 0.5 * 0.2 * 0.2 * duration_s;
        EXPECT_NEAR(lost / expected, 1.0, 0.02) << duration_s;
    }
}

TEST(Faults, ASwitchIsSentOffItsTarget) {
    for (const double miss_lambda : {0.0, 0.1}) {
        const auto landed = [&](std::vector<Fault> faults) {
            TwinConfig config = quiet_gyro();
            config.perimeter.miss_lambda = miss_lambda;
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
    config.gyro.temperature_rise_c = 0.0;
    config.perimeter.expansion_lambda_per_c = 0.025;
    config.gyro.bias_temperature_coefficient_per_c = -1e-3;
    const auto halves = with_faults(config, {{FaultKind::thermal_shock, 4 * half_s, 4 * half_s, 8.0}}, 40);
    EXPECT_DOUBLE_EQ(halves[3].sensor.temperature_c, 20.0);
    EXPECT_NEAR(halves[5].sensor.temperature_c, 24.0, 1e-9);
    EXPECT_NEAR(halves[39].sensor.temperature_c, 28.0, 1e-9);
    EXPECT_NEAR(halves[39].truth.detuning_end_lambda - halves[3].truth.detuning_end_lambda, 0.2, 1e-9);
    // (1 - 8e-3)(1 - 3.6 0.2^2) of 150 counts, the share of the reversals left out.
    EXPECT_NEAR(static_cast<double>(std::abs(counts(halves, 38))), 150.0 * 0.992 * (1.0 - 3.6 * 0.04), 1.5);
}

}  // namespace zlg::twin::faults_perimeter_test
