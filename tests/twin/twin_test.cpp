#include <zlg/twin/twin.hpp>

#include "quiet_gyro.hpp"

namespace zlg::twin::twin_test {

struct Moments {
    double mean = 0.0;
    double sigma = 0.0;
    double next_correlation = 0.0;
};

Moments moments(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Moments result;
    for (const double v : values) result.mean += v / n;
    double square = 0.0;
    double product = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double d = values[k] - result.mean;
        square += d * d;
        if (k > 0) product += d * (values[k - 1] - result.mean);
    }
    result.sigma = std::sqrt(square / (n - 1.0));
    result.next_correlation = product / square;
    return result;
}

TEST(Twin, AtRestTheBiasCancelsOverEveryTick) {
    Twin twin{quiet_gyro(), Motion::rest()};
    TwinHalf before = twin.advance(frame(true, 1));
    for (int tick = 0; tick < 2000; ++tick) {
        twin.advance(frame(true, 1));
        const TwinHalf after = twin.advance(frame(true, 1));
        ASSERT_EQ(count_between(before, after), 0) << "tick " << tick;
        before = after;
    }
}

// With 1e12 Hz a half counts 2.5e9 fringes, so one fringe is 4e-10 of the mean: edges and plateau must fit exactly.
TEST(Twin, TheMeanBiasOverAHalfIsTheOneAskedForWhateverTheEdges) {
    for (const double edge_s : {0.0, 50e-6, 2e-3}) {
        TwinConfig config = quiet_gyro();
        config.gyro.bias_hz = 1e12;
        config.gyro.bias_edge_s = edge_s;
        config.gyro.first_bias_sign = -1;
        Twin twin{config, Motion::rest()};
        const TwinHalf first = twin.advance(frame(true, 1));
        EXPECT_NEAR(static_cast<double>(static_cast<std::int64_t>(first.sensor.counter)), -2.5e9, 1.0);
        EXPECT_NEAR(static_cast<double>(count_between(first, twin.advance(frame(true, 1)))), 2.5e9, 1.0);
    }
}

TEST(Twin, TheFreeRunningCounterLosesNothingInAnHour) {
    TwinConfig config = quiet_gyro();
    config.gyro.light_samples = 13;
    const double rate_arcsec_s = -1234.567;
    Twin twin{config, Motion::sines(rate_arcsec_s, {})};
    long double told_arcsec = 0.0L;  // 1.4 million additions
    for (int tick = 1; tick <= 720000; ++tick) {
        told_arcsec += twin.advance(frame(true, 1)).truth.dtheta_arcsec;
        const TwinHalf half = twin.advance(frame(true, 1));
        told_arcsec += half.truth.dtheta_arcsec;
        const double counted_arcsec =
            static_cast<double>(static_cast<std::int64_t>(half.sensor.counter)) * config.gyro.scale_arcsec;
        ASSERT_LE(std::abs(counted_arcsec - rate_arcsec_s * tick * 0.005), config.gyro.scale_arcsec) << tick;
    }
    EXPECT_NEAR(static_cast<double>(told_arcsec), rate_arcsec_s * 3600.0, 1e-6);
}

TEST(Twin, MagneticDriftFlipsWithHelicityAndTheNonmagneticDoesNot) {
    TwinConfig config = quiet_gyro();
    config.drift.magnetic_arcsec_s = 3000.0;
    config.drift.nonmagnetic_arcsec_s = 1000.0;
    config.perimeter.miss_lambda = 0.0;
    Twin twin{config, Motion::rest()};
    const auto rate = [&](int polarity, double set_point_v) {
        advance(twin, frame(false, polarity, set_point_v), 12);
        const TwinHalf before = advance(twin, frame(true, polarity), 200).back();
        const TwinHalf after = advance(twin, frame(true, polarity), 400).back();
        return static_cast<double>(count_between(before, after)) * config.gyro.scale_arcsec / 1.0;
    };
    EXPECT_NEAR(rate(1, 150.0), 4000.0, config.gyro.scale_arcsec);
    EXPECT_NEAR(rate(-1, 190.0), -2000.0, config.gyro.scale_arcsec);
    EXPECT_NEAR(rate(1, 150.0), 4000.0, config.gyro.scale_arcsec);
}

TEST(Twin, MagneticDriftAndPerimeterWarmUpByTheThermalLaw) {
    TwinConfig config = quiet_gyro();
    config.drift.magnetic_arcsec_s = 500.0;
    config.drift.magnetic_thermal_arcsec_s = 2000.0;
    config.drift.thermal_time_s = 0.7;
    config.perimeter.expansion_lambda_per_c = 0.025;
    Twin twin{config, Motion::rest()};
    const TwinHalf last = advance(twin, frame(true, 1), 800).back();
    const double risen = 1.0 - std::exp(-2.0 / 0.7);
    const double angle = 500.0 * 2.0 + 2000.0 * (2.0 - 0.7 * risen);
    EXPECT_NEAR(static_cast<double>(last.sensor.counter) * config.gyro.scale_arcsec, angle,
                2.0 * config.gyro.scale_arcsec);
    EXPECT_NEAR(last.sensor.temperature_c, 20.0 + 20.0 * risen, 1e-12);
    // The loop takes back what the block expands; it lags by the growth over its time constant.
    EXPECT_NEAR(last.truth.perimeter_v, 150.0 - 0.5 * risen * 80.0, 0.1);
    EXPECT_LT(std::abs(last.truth.detuning_end_lambda), 0.0065 * 0.5 / 0.7);
}

// The law is computed from two parts: every half of several blocks, and a gyro that has been warm for long.
TEST(Twin, WarmsByTheExponentialInEveryHalf) {
    for (const double thermal_time_s : {0.05, 0.7, 3000.0, 1e9}) {
        TwinConfig config = quiet_gyro();
        config.drift.thermal_time_s = thermal_time_s;
        Twin twin{config, Motion::rest()};
        for (int half = 1; half <= 200; ++half) {
            const double risen = -std::expm1(-half * 0.5 * config.gyro.tick_s / thermal_time_s);
            const double warmed_c = twin.advance(frame(true, 1)).sensor.temperature_c - 20.0;
            EXPECT_NEAR(warmed_c, 20.0 * risen, 1e-14 + 4e-15 * 20.0) << thermal_time_s << " s, half " << half;
        }
    }
}

TEST(Twin, BiasFollowsTheTemperature) {
    TwinConfig config = quiet_gyro();
    config.gyro.bias_hz = 1e9;
    config.gyro.bias_temperature_coefficient_per_c = -5e-4;
    config.drift.thermal_time_s = 1e-3;
    Twin twin{config, Motion::rest()};
    const std::vector<TwinHalf> halves = advance(twin, frame(true, 1), 42);
    EXPECT_NEAR(std::abs(static_cast<double>(count_between(halves[40], halves[41]))), 2.5e6 * (1.0 - 5e-4 * 20.0), 1.0);
}

TEST(Twin, RandomWalkGrowsWithTheRootOfTime) {
    TwinConfig config = quiet_gyro();
    config.drift.random_walk_arcsec_sqrt_s = 1000.0;
    Twin twin{config, Motion::rest()};
    TwinHalf before = advance(twin, frame(true, 1), 40).back();
    std::vector<double> angles;
    for (int k = 0; k < 1000; ++k) {
        const TwinHalf after = advance(twin, frame(true, 1), 40).back();
        angles.push_back(static_cast<double>(count_between(before, after)) * config.gyro.scale_arcsec);
        before = after;
    }
    const Moments m = moments(angles);
    // Standard error of sigma over 1000 values is 2.2 %, of the mean sigma/32.
    EXPECT_NEAR(m.sigma, 1000.0 * std::sqrt(0.1), 0.08 * m.sigma);
    EXPECT_LT(std::abs(m.mean), 0.12 * m.sigma);
    EXPECT_LT(std::abs(m.next_correlation), 0.12);
}

TEST(Twin, ALightSampleHasTheNoiseAskedForAndNoMemory) {
    TwinConfig config = quiet_gyro();
    config.gyro.light_noise_lambda = 0.0033;
    Twin twin{config, Motion::rest()};
    std::vector<double> detunings;
    for (int h = 0; h < 1000; ++h) {
        const core::SensorFrame sensor = twin.advance(frame(true, 1)).sensor;
        ASSERT_EQ(sensor.n_light, 16);
        ASSERT_TRUE(sensor.has_light_b);
        for (std::size_t k = 0; k < 16; ++k) {
            const double a = static_cast<double>(sensor.light_a[k]);
            const double b = static_cast<double>(sensor.light_b[k]);
            detunings.push_back(sensor.bias_sign * (a - b) / (a + b) / config.gyro.discriminator_per_lambda);
        }
    }
    const Moments m = moments(detunings);
    EXPECT_NEAR(m.sigma, 0.0033, 0.03 * 0.0033);
    EXPECT_LT(std::abs(m.mean), 4.0 * 0.0033 / std::sqrt(16000.0));
    EXPECT_LT(std::abs(m.next_correlation), 4.0 / std::sqrt(16000.0));
}

TEST(Twin, ThePiezoReadingHasTheNoiseAndTheStepsOfItsConverter) {
    TwinConfig config = quiet_gyro();
    config.piezo.adc_noise_v = 0.5;
    config.piezo.adc_bits = 10;
    Twin twin{config, Motion::rest()};
    std::vector<double> readings;
    for (const TwinHalf& half : advance(twin, frame(true, 1), 4000)) {
        readings.push_back(half.sensor.piezo_v);
        const double code = half.sensor.piezo_v / (300.0 / 1024.0);
        ASSERT_NEAR(code, std::round(code), 1e-9);
    }
    const Moments m = moments(readings);
    EXPECT_NEAR(m.mean, 150.0, 4.0 * 0.5 / std::sqrt(4000.0));
    EXPECT_NEAR(m.sigma, std::hypot(0.5, 300.0 / 1024.0 / std::sqrt(12.0)), 0.05 * 0.5);
}

TEST(Twin, FramesAreNumberedStampedAndEchoWhatWasInForce) {
    TwinConfig config = quiet_gyro();
    config.gyro.first_bias_sign = -1;
    config.gyro.light_samples = 5;
    Twin twin{config, Motion::rest()};
    for (std::uint32_t h = 0; h < 20; ++h) {
        const bool closed = h % 3 != 0;
        const int polarity = h % 5 == 0 ? -1 : 1;
        const core::SensorFrame sensor = twin.advance(frame(closed, polarity)).sensor;
        EXPECT_EQ(sensor.sequence, h);
        EXPECT_EQ(sensor.timer_ticks, (h + 1) * 25000u);
        EXPECT_EQ(sensor.bias_sign, h % 2 == 0 ? -1 : 1);
        EXPECT_EQ(sensor.coil_current_a, sensor.bias_sign);
        EXPECT_EQ(sensor.loop_closed, closed);
        EXPECT_EQ(sensor.polarity, polarity);
        EXPECT_EQ(sensor.n_light, 5);
        EXPECT_EQ(sensor.status, 0u);
    }
}

bool same_bits(const TwinHalf& a, const TwinHalf& b) {
    return a.sensor.counter == b.sensor.counter && a.sensor.light_a == b.sensor.light_a &&
           a.sensor.light_b == b.sensor.light_b && a.sensor.piezo_v == b.sensor.piezo_v &&
           a.truth.false_relock_arcsec == b.truth.false_relock_arcsec;
}

TEST(Twin, TheSameSeedGivesTheSameBitsAndAnotherSeedOthers) {
    TwinConfig config;
    Twin one{config, Motion::sines(0.0, {{12000.0, 7.03, 0.0}})};
    Twin two{config, Motion::sines(0.0, {{12000.0, 7.03, 0.0}})};
    config.seed = 2;
    Twin other{config, Motion::sines(0.0, {{12000.0, 7.03, 0.0}})};
    int different = 0;
    for (int h = 0; h < 100; ++h) {
        const core::ActuatorFrame actuator = frame(h < 20 || h > 26, h < 20 ? 1 : -1, 190.0);
        const TwinHalf half = one.advance(actuator);
        ASSERT_TRUE(same_bits(half, two.advance(actuator))) << "half " << h;
        if (!same_bits(half, other.advance(actuator))) ++different;
    }
    EXPECT_EQ(different, 100);
}

TEST(Twin, NoisesOfDifferentCauseHaveNothingInCommon) {
    TwinConfig config = quiet_gyro();
    config.drift.random_walk_arcsec_sqrt_s = 1e4;
    config.piezo.adc_noise_v = 1.0;
    Twin twin{config, Motion::rest()};
    TwinHalf before = twin.advance(frame(true, 1));
    std::vector<double> product;
    for (int h = 0; h < 2000; ++h) {
        const TwinHalf after = twin.advance(frame(true, 1));
        const double bias_counts = 150.0 * after.sensor.bias_sign;
        const double walk =
            (static_cast<double>(count_between(before, after)) - bias_counts) * config.gyro.scale_arcsec / 500.0;
        product.push_back(walk * (after.sensor.piezo_v - 150.0));
        before = after;
    }
    const Moments m = moments(product);
    EXPECT_NEAR(m.sigma, 1.0, 0.2) << "both are of unit variance here";
    EXPECT_LT(std::abs(m.mean), 4.0 / std::sqrt(2000.0));
}

TEST(Twin, SwitchingOneNoiseOffDoesNotShiftAnother) {
    TwinConfig config;
    Twin noisy{config, Motion::rest()};
    config.drift.random_walk_arcsec_sqrt_s = 0.0;
    config.piezo.adc_noise_v = 0.0;
    Twin partly{config, Motion::rest()};
    for (int h = 0; h < 20; ++h) {
        EXPECT_EQ(noisy.advance(frame(true, 1)).sensor.light_a, partly.advance(frame(true, 1)).sensor.light_a);
    }
}

}  // namespace zlg::twin::twin_test
