#include <zlg/study/gyro_drift.hpp>

#include "test.hpp"

namespace zlg::study::gyro_drift_test {

TEST(GyroDrift, HasEachConstantOfTheConfigurationInItsPlace) {
    config::Config config;
    config.drift.nonmagnetic_arcsec_s = 1.0;
    config.drift.magnetic_arcsec_s = 2.0;
    config.drift.magnetic_thermal_arcsec_s = 3.0;
    config.drift.thermal_time_s = 4.0;
    const design::GyroDrift drift = gyro_drift(config);
    EXPECT_EQ(drift.nonmagnetic_arcsec_s, 1.0);
    EXPECT_EQ(drift.magnetic_arcsec_s, 2.0);
    EXPECT_EQ(drift.magnetic_thermal_arcsec_s, 3.0);
    EXPECT_EQ(drift.thermal_time_s, 4.0);
}

}  // namespace zlg::study::gyro_drift_test
