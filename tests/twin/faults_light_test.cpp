// Faults of the light and of its converters.

#include "faults_support.hpp"

namespace zlg::twin::faults_light_test {

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

TEST(Faults, ConvertersOfLightStickSaturateAndFail) {
    TwinConfig noisy = quiet_gyro();
    noisy.gyro.light_noise_lambda = 0.0033;
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

}  // namespace zlg::twin::faults_light_test
