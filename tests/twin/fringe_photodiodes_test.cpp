// Both photodiodes of the beat, sampled at the latch: where the bias is reversed and the beat turns round.

#include <zlg/twin/twin.hpp>

#include "laser_gyro.hpp"

namespace zlg::twin::fringe_photodiodes_test {

constexpr double tau = 2.0 * std::numbers::pi;

TwinConfig with_photodiodes(TwinConfig config) {
    config.gyro.readout = Readout::phase;
    config.photodiodes = {.offset_cosine = 0.0,
                          .offset_sine = 0.0,
                          .amplitude_error = 0.0,
                          .angle_error_deg = 0.0,
                          .noise = 0.0,
                          .adc_bits = 24};
    return config;
}

double turns(const core::SensorFrame& f) {
    const double t = std::atan2(f.fringe_s, f.fringe_c) / tau;
    return t < 0.0 ? t + 1.0 : t;
}

double apart(double a, double b) { return std::remainder(a - b, 1.0); }

TEST(FringePhotodiodes, AreNotSampledWhereTheCounterIsAllThatIsRead) {
    Twin twin{held_gyro(), Motion::rest()};
    EXPECT_FALSE(twin.advance(frame(true, 1)).sensor.has_fringe);
}

TEST(FringePhotodiodes, ShowTheVeryPhaseThatTheCounterRoundsDown) {
    Twin twin{with_photodiodes(held_gyro()), Motion::sines(1000.0, {{12000.0, 20.06, 0.0}})};
    for (int h = 0; h < 2000; ++h) {
        const TwinHalf half = twin.advance(frame(true, 1));
        ASSERT_TRUE(half.sensor.has_fringe);
        const double fraction = -half.truth.rounding_arcsec / 3.263;
        EXPECT_NEAR(apart(turns(half.sensor), fraction), 0.0, 1e-6) << h;
        EXPECT_EQ(half.sensor.fringe_quarter, static_cast<int>(4.0 * fraction)) << h;
        EXPECT_NEAR(std::hypot(half.sensor.fringe_c, half.sensor.fringe_s), 1.0, 1e-6);
    }
}

// Without lock-in a gyro at a constant rate turns by the same part of a fringe in every tick.
TEST(FringePhotodiodes, OfALaserTurnByTheRateFromReversalToReversal) {
    constexpr double rate_arcsec_s = 1234.5;
    Twin twin{with_photodiodes(as_laser(held_gyro())), Motion::sines(rate_arcsec_s, {})};
    const auto halves = advance(twin, frame(true, 1), 400);
    const double expected = rate_arcsec_s * 0.005 / 3.263;
    for (std::size_t h = 22; h < halves.size(); ++h) {
        const double turned =
            static_cast<double>(static_cast<std::int64_t>(halves[h].sensor.counter - halves[h - 2].sensor.counter)) +
            turns(halves[h].sensor) - turns(halves[h - 2].sensor);
        // Comparators that lag make the count of a border one off, which is what the quarter is for.
        EXPECT_NEAR(apart(turned, expected), 0.0, 2e-5) << h;
        EXPECT_NEAR(turned, expected, 1.1);
    }
}

// Lock-in pulls the phase while the beat turns round: by about 1/1000 of a fringe, as the slip of the reversal says.
TEST(FringePhotodiodes, OfALaserWithLockInAreOffByItsSlipAlone) {
    constexpr double rate_arcsec_s = 1234.5;
    Twin twin{with_photodiodes(as_laser(held_gyro(), 150.0)), Motion::sines(rate_arcsec_s, {})};
    const auto halves = advance(twin, frame(true, 1), 2000);
    double sum = 0.0;
    for (std::size_t h = 22; h < halves.size(); ++h) {
        const double off = apart(turns(halves[h].sensor) - turns(halves[h - 2].sensor), rate_arcsec_s * 0.005 / 3.263);
        sum += off * off;
    }
    const double rms = std::sqrt(sum / 1978.0);
    // Slip of one reversal by stationary phase: lock_hz sqrt(t_e/(2 f))/sqrt 2 turns rms; two reversals a tick.
    const double slip = 150.0 * std::sqrt(50e-6 / (2.0 * 60430.0)) / std::sqrt(2.0);
    EXPECT_LT(rms, 2.0 * slip);
    EXPECT_GT(rms, 0.2 * slip);
}

TEST(FringePhotodiodes, TheQuarterIsThatOfThePhaseButForTheLagOfTheComparators) {
    for (const Quadrature quadrature : {Quadrature::x1, Quadrature::x4}) {
        TwinConfig config = with_photodiodes(as_laser(held_gyro(), 150.0));
        config.laser.quadrature = quadrature;
        Twin twin{config, Motion::sines(1000.0, {{3000.0, 3.1, 0.0}})};
        const auto halves = advance(twin, frame(true, 1), 2000);
        for (std::size_t h = 20; h < halves.size(); ++h) {
            const double from_middle = apart(turns(halves[h].sensor), 0.25 * (halves[h].sensor.fringe_quarter + 0.5));
            EXPECT_LT(std::abs(from_middle), 0.125 + std::asin(0.1 / 0.9) / tau + 1e-6) << h;
            if (quadrature == Quadrature::x4) EXPECT_EQ(halves[h].sensor.fringe_quarter, halves[h].sensor.counter & 3u);
        }
    }
}

// A chirp through zero: frequency -2 f t/t_e about the latch, in the sense of the half that ends.
TEST(FringePhotodiodes, ASkewShowsTheBeatThatHasTurnedBack) {
    for (const double skew_s : {1e-6, -1e-6, 5e-6}) {
        for (const bool laser : {false, true}) {
            TwinConfig at_latch = with_photodiodes(laser ? as_laser(held_gyro()) : held_gyro());
            TwinConfig skewed = at_latch;
            skewed.photodiodes.skew_s = skew_s;
            Twin a{at_latch, Motion::rest()};
            Twin b{skewed, Motion::rest()};
            const double plateau_hz = laser ? 60430.0 : 60e3 / (1.0 - 50e-6 / 0.005);
            for (int h = 0; h < 40; ++h) {
                const double seen =
                    apart(turns(b.advance(frame(true, 1)).sensor), turns(a.advance(frame(true, 1)).sensor));
                const double sign = h % 2 == 0 ? 1.0 : -1.0;
                EXPECT_NEAR(seen, -sign * plateau_hz * skew_s * skew_s / 50e-6, 2e-5) << skew_s << " " << h;
            }
        }
    }
}

TEST(FringePhotodiodes, HaveTheEllipseNoiseAndConverterThatTheyAreGiven) {
    TwinConfig config = with_photodiodes(held_gyro());
    config.photodiodes = {.offset_cosine = 0.1,
                          .offset_sine = -0.05,
                          .amplitude_error = 0.1,
                          .angle_error_deg = 5.0,
                          .noise = 0.01,
                          .adc_bits = 12};
    Twin ideal{with_photodiodes(held_gyro()), Motion::sines(1234.5, {})};
    Twin real{config, Motion::sines(1234.5, {})};
    double mean_c = 0.0, mean_s = 0.0, square_c = 0.0, square_s = 0.0;
    constexpr int n = 4000;
    for (int h = 0; h < n; ++h) {
        const double p = tau * turns(ideal.advance(frame(true, 1)).sensor);
        const core::SensorFrame f = real.advance(frame(true, 1)).sensor;
        const double off_c = f.fringe_c - (0.1 + std::cos(p));
        const double off_s = f.fringe_s - (-0.05 + 1.1 * std::sin(p + 5.0 * tau / 360.0));
        mean_c += off_c / n;
        mean_s += off_s / n;
        square_c += off_c * off_c / n;
        square_s += off_s * off_s / n;
        const double code = (f.fringe_c + 2.0) * 1024.0;
        EXPECT_NEAR(code, std::round(code), 1e-3);
    }
    // Four standard errors.
    EXPECT_NEAR(mean_c, 0.0, 7e-4);
    EXPECT_NEAR(mean_s, 0.0, 7e-4);
    const double expected = 0.01 * 0.01 + 1.0 / 1024.0 / 1024.0 / 12.0;
    EXPECT_NEAR(square_c / expected, 1.0, 0.09);
    EXPECT_NEAR(square_s / expected, 1.0, 0.09);
}

TEST(FringePhotodiodes, AreDarkWhereTheGyroIsDark) {
    TwinConfig config = with_photodiodes(quiet_gyro());
    Twin twin{config, Motion::rest()};
    advance(twin, frame(true, 1), 20);
    bool dark = false;
    for (const TwinHalf& half : advance(twin, frame(false, -1, 190.0), 6))
        dark = dark || std::hypot(half.sensor.fringe_c, half.sensor.fringe_s) < 1e-3;
    EXPECT_TRUE(dark);
}

}  // namespace zlg::twin::fringe_photodiodes_test
