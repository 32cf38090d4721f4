// The twin as a laser: what it shows of its light, counts and reversals.

#include <zlg/twin/four_wave.hpp>
#include <zlg/twin/twin.hpp>

#include "laser_gyro.hpp"

namespace zlg::twin::twin_laser_test {

constexpr double plateau_hz = 60430.0;  // of the four-wave equations for the default gas, at 15 G

TEST(TwinLaser, TheBeamsAreTheLightOfBothModesAtTheFieldOfTheHalf) {
    const FourWave laser{LaserConfig{}};
    for (const double dl : {0.0, 0.05, 0.19, 0.22, 0.25}) {
        Twin twin{as_laser(held_gyro()), Motion::rest()};
        for (int h = 0; h < 12; ++h) {
            const TwinHalf half = twin.advance(frame(true, 1, 150.0 + 80.0 * dl));
            if (h < 10) continue;  // the high voltage is still on its way
            const LaserLight light = laser.at(dl, h % 2 == 0 ? 15.0 : -15.0);
            // A DAC of 24 bits leaves 1e-5 of light.
            EXPECT_NEAR(half.sensor.light_a[5] / (1000.0 * light.cw() / laser.centre_intensity()), 1.0, 3e-4) << dl;
            EXPECT_NEAR(half.sensor.light_b[5] / (1000.0 * light.ccw() / laser.centre_intensity()), 1.0, 3e-4) << dl;
        }
    }
}

// Of unequal isotopes the loop settles where the beams are equal, off the middle of the mode: the loop of a formula
// too.
TEST(TwinLaser, AnExponentialLoopSettlesWhereTheBeamsAreEqual) {
    TwinConfig config = as_laser(quiet_gyro());
    config.perimeter.loop = Loop::exponential;
    config.perimeter.miss_lambda = 0.0;
    config.laser.upper_isotope_ratio = 0.53;
    Twin twin{config, Motion::rest()};
    const auto signal = [](const TwinHalf& half) {
        const double a = half.sensor.light_a[8];
        const double b = half.sensor.light_b[8];
        return (a - b) / (a + b);
    };
    EXPECT_NEAR(signal(advance(twin, frame(true, 1), 4).back()), 0.0, 1e-4) << "from the start";
    (void)advance(twin, frame(false, 1, 152.0), 8);
    const TwinHalf half = advance(twin, frame(true, 1), 100).back();
    EXPECT_NEAR(signal(half), 0.0, 1e-4) << "closed again";
    EXPECT_NEAR(half.truth.detuning_end_lambda, 0.024, 0.002);
}

TEST(TwinLaser, AHalfCountsTheBiasOfItsPlateauLessItsEdges) {
    Twin twin{as_laser(held_gyro()), Motion::rest()};
    const TwinHalf first = twin.advance(frame(true, 1));
    const double expected = plateau_hz * (2500e-6 - 25e-6);
    EXPECT_NEAR(static_cast<double>(static_cast<std::int64_t>(first.sensor.counter)), expected, 1.1);
    EXPECT_NEAR(static_cast<double>(count_between(first, twin.advance(frame(true, 1)))), -expected, 1.1);
}

std::int64_t signed_count(const TwinHalf& half) { return static_cast<std::int64_t>(half.sensor.counter); }

// Schawlow and Townes: the beat of two beams spreads by (FSR mu)^2 h nu/(4 pi^2 P) square turns a second. Of two whole
// counts the parts are cut off, which adds 1/6.
TEST(TwinLaser, AtRestTheBeatWalksAsQuantumNoiseSays) {
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> uniform{0.0, 1.0};
    const auto drawn = [&](double low, double high) { return low * std::pow(high / low, uniform(random)); };
    for (int draw = 0; draw < 6; ++draw) {
        TwinConfig config = as_laser(held_gyro());
        config.laser.perimeter_m = drawn(0.10, 0.28);
        config.laser.round_trip_loss_ratio = drawn(0.002, 0.01);
        config.laser.beam_power_w = drawn(1e-10, 1e-9);
        config.seed = static_cast<std::uint64_t>(draw + 1);
        Twin twin{config, Motion::rest()};
        constexpr int n_blocks = 4000;
        constexpr int halves_a_block = 8;
        double sum_sq = 0.0;
        std::int64_t before = signed_count(advance(twin, frame(true, 1), halves_a_block).back());
        for (int block = 0; block < n_blocks; ++block) {
            const std::int64_t now = signed_count(advance(twin, frame(true, 1), halves_a_block).back());
            sum_sq += static_cast<double>((now - before) * (now - before));
            before = now;
        }
        const double fsr_loss_hz = 299792458.0 / config.laser.perimeter_m * config.laser.round_trip_loss_ratio;
        const double per_second = fsr_loss_hz * fsr_loss_hz * 6.62607015e-34 * 4.7376e14 /
                                  (4.0 * std::numbers::pi * std::numbers::pi * config.laser.beam_power_w);
        const double found = (sum_sq / n_blocks - 1.0 / 6.0) / (halves_a_block * 2.5e-3);
        EXPECT_NEAR(std::sqrt(found / per_second), 1.0, 0.05) << draw;
    }
}

// Rotation and field move waves and lines alike, so the gas takes f0/(2 z) = 1107 ppm of a turn's counts, and less as
// the bias falls with the detuning. gyro.scale_arcsec holds where there is none.
TEST(TwinLaser, TheScaleMovesWithTheBias) {
    constexpr double rate_arcsec_s = 4e5;
    constexpr int n = 1600;  // halves, 4 s
    const auto counts = [&](double dl) {
        Twin twin{as_laser(held_gyro()), Motion::sines(rate_arcsec_s, {})};
        const TwinHalf before = advance(twin, frame(true, 1, 150.0 + 80.0 * dl), 20).back();
        return static_cast<double>(count_between(before, advance(twin, frame(true, 1, 150.0 + 80.0 * dl), n).back()));
    };
    const double undetuned = rate_arcsec_s / TwinConfig{}.gyro.scale_arcsec * n * 2.5e-3;
    EXPECT_NEAR(counts(0.0), undetuned, 1.5);
    const double more = plateau_hz / (2.0 * 15.0 * 1.82e6) * 3.59 * 0.19 * 0.19 * undetuned;
    EXPECT_NEAR(counts(0.19) - counts(0.0), more, 2.5);
}

// Half a wavelength further the other helicity has the opposite beat and the opposite discriminator.
TEST(TwinLaser, TheOtherModeHasTheOtherSign) {
    Twin twin{as_laser(held_gyro()), Motion::rest()};
    const TwinHalf before = advance(twin, frame(true, -1, 190.8), 20).back();
    const TwinHalf half = twin.advance(frame(true, -1, 190.8));
    EXPECT_NEAR(static_cast<double>(count_between(before, half)), -plateau_hz * 2475e-6, 1.1);
    const double a = half.sensor.light_a[8];
    const double b = half.sensor.light_b[8];
    EXPECT_NEAR((a - b) / (a + b), -0.332 * 0.01, 0.02 * 0.332 * 0.01);
}

TEST(TwinLaser, QuartersAreCountedFourTimes) {
    TwinConfig whole = as_laser(quiet_gyro(), 150.0);
    TwinConfig quarters = whole;
    quarters.laser.quadrature = Quadrature::x4;
    quarters.gyro.scale_arcsec = whole.gyro.scale_arcsec / 4.0;
    Twin by_turns{whole, Motion::sines(7000.0, {})};
    Twin by_quarters{quarters, Motion::sines(7000.0, {})};
    for (int h = 0; h < 400; ++h) {
        const auto turns = static_cast<std::int64_t>(by_turns.advance(frame(true, 1)).sensor.counter);
        const auto fourth = static_cast<std::int64_t>(by_quarters.advance(frame(true, 1)).sensor.counter);
        ASSERT_EQ(turns, fourth >> 2) << h;
    }
}

// Ends of the halves at +250, -100, +40 ticks in turn: each counts the bias between its own reversals.
TEST(TwinLaser, TheCounterIsLatchedAtTheShiftedReversal) {
    TwinConfig config = as_laser(quiet_gyro());
    config.laser.quadrature = Quadrature::x4;
    Twin twin{config, Motion::rest()};
    const std::int32_t offsets[] = {250, -100, 40};
    TwinHalf before = twin.advance(frame(true, 1));
    std::int32_t start = 0;
    for (std::uint64_t h = 1; h < 30; ++h) {
        core::ActuatorFrame shifted = frame(true, 1);
        shifted.edge_offset_ticks = offsets[h % 3];
        const TwinHalf half = twin.advance(shifted);
        const double length_s = 2500e-6 + 1e-7 * (shifted.edge_offset_ticks - start);
        const double turns = half.sensor.bias_sign * plateau_hz * (length_s - 25e-6);
        EXPECT_NEAR(static_cast<double>(count_between(before, half)), 4.0 * turns, 1.1) << h;
        EXPECT_EQ(half.sensor.timer_ticks, 25000 * (h + 1) + static_cast<std::uint64_t>(offsets[h % 3])) << h;
        start = shifted.edge_offset_ticks;
        before = half;
    }
}

TEST(TwinLaser, RefusesAReversalThatWouldMeetItsNeighbour) {
    Twin twin{as_laser(quiet_gyro()), Motion::rest()};
    core::ActuatorFrame shifted = frame(true, 1);
    shifted.edge_offset_ticks = 12250;  // half of 2500 us less 50 us
    EXPECT_NO_THROW(twin.advance(shifted));
    shifted.edge_offset_ticks = -12251;
    EXPECT_THROW(twin.advance(shifted), std::invalid_argument);
}

// Warming weakens the field; the bias follows it within a twentieth.
TEST(TwinLaser, TheBiasFollowsTheFieldThatWarmingWeakens) {
    TwinConfig config = as_laser(quiet_gyro());
    config.gyro.bias_temperature_coefficient_per_c = -5e-3;
    config.drift.thermal_time_s = 0.1;
    config.laser.quadrature = Quadrature::x4;
    Twin twin{config, Motion::rest()};
    const TwinHalf before = advance(twin, frame(true, 1), 1000).back();
    const double warm = std::abs(static_cast<double>(count_between(before, twin.advance(frame(true, 1)))));
    EXPECT_NEAR(1.0 - warm / (4.0 * plateau_hz * 2475e-6), 0.1, 0.05 * 0.1);
}

TEST(TwinLaser, WithTheWrongReferenceTheLoopPushesAway) {
    TwinConfig config = as_laser(quiet_gyro());
    config.perimeter.miss_lambda = 0.0;
    config.piezo.dac_bits = 24;
    Twin right{config, Motion::rest()};
    Twin wrong{config, Motion::rest()};
    advance(right, frame(false, 1, 150.8), 20);
    advance(wrong, frame(false, 1, 150.8), 20);
    EXPECT_LT(advance(right, frame(true, 1), 2).back().truth.detuning_end_lambda, 0.006);
    EXPECT_GT(advance(wrong, frame(true, -1), 2).back().truth.detuning_end_lambda, 0.016);
}

// The light of both modes tells which way to go: there is no place between them where the loop rests.
TEST(TwinLaser, TheLoopPullsInFromBetweenTheModes) {
    TwinConfig config = as_laser(quiet_gyro());
    config.perimeter.miss_lambda = 0.0;
    Twin twin{config, Motion::rest()};
    advance(twin, frame(false, 1, 150.0 + 0.25 * 80.0), 40);
    EXPECT_NEAR(advance(twin, frame(true, 1), 60).back().truth.detuning_end_lambda, 0.0, 1e-4);
}

// Isotopes of unequal share: the loop settles where the beams are equal, off the centre.
TEST(TwinLaser, UnequalIsotopesMoveThePlaceWhereTheLoopSettles) {
    TwinConfig config = as_laser(quiet_gyro());
    config.laser.upper_isotope_ratio = 0.48;
    Twin twin{config, Motion::rest()};
    const TwinHalf half = advance(twin, frame(true, 1), 100).back();
    EXPECT_LT(half.truth.detuning_end_lambda, -0.005);
    EXPECT_NEAR(half.sensor.light_a[8] / half.sensor.light_b[8], 1.0, 1e-5);
}

TEST(TwinLaser, RefusesALaserWithoutLight) {
    TwinConfig config = as_laser(quiet_gyro());
    config.laser.gain_loss_ratio = 0.99;
    EXPECT_THROW((Twin{config, Motion::rest()}), std::runtime_error);
}

}  // namespace zlg::twin::twin_laser_test
