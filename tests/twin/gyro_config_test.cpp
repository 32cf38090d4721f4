#include <zlg/twin/gyro_config.hpp>

#include "test.hpp"

namespace zlg::twin::gyro_config_test {

// A 0.16 m ring with 3.263 arcsec per count, 200 Hz ticks and a bias of 60 kHz.
TEST(GyroConfig, TheDefaultsAreThePublishedGyro) {
    const GyroConfig gyro;
    EXPECT_EQ(gyro.tick_s, 0.005);
    EXPECT_EQ(gyro.scale_arcsec, 3.263);
    EXPECT_EQ(gyro.bias_hz, 60e3);
    EXPECT_EQ(gyro.bias_chi, 3.6);
    EXPECT_EQ(gyro.light_samples, 16);
    EXPECT_EQ(gyro.light_noise_lambda, 0.0033);
    const DriftConfig drift;
    EXPECT_EQ(drift.magnetic_arcsec_s, 0.7);
    EXPECT_EQ(drift.magnetic_thermal_arcsec_s, 0.7);
    EXPECT_EQ(drift.thermal_time_s, 3000.0);
    EXPECT_EQ(drift.nonmagnetic_arcsec_s, 0.05);
    EXPECT_EQ(drift.random_walk_arcsec_sqrt_s, 0.14);
    const PerimeterConfig perimeter;
    EXPECT_EQ(perimeter.loop, Loop::analog);
    EXPECT_EQ(perimeter.tau_s, 0.0065);
    EXPECT_EQ(perimeter.limit_lambda, 0.09);
    EXPECT_EQ(perimeter.miss_lambda, 0.22);
    const PiezoConfig piezo;
    EXPECT_EQ(piezo.half_wave_v, 40.0);
    EXPECT_EQ(piezo.rc_s, 0.001);
    EXPECT_EQ(piezo.slew_v_s, 4000.0);
}

}  // namespace zlg::twin::gyro_config_test
