// Faults of what the frame holds: slow converters, counter, delivery, bias current, rotation.

#include "counter_limit.hpp"
#include "faults_support.hpp"

namespace zlg::twin::faults_frame_test {

TEST(Faults, SlowConvertersStickAndFail) {
    TwinConfig config = quiet_gyro();
    config.piezo.adc_noise_v = 1.0;
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

}  // namespace zlg::twin::faults_frame_test
