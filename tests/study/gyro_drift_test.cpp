#include <zlg/config/schema.hpp>
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

TEST(GyroDrift, is_refused_where_a_field_or_a_profile_makes_another_of_it) {
    config::Config field, profile;
    field.field.kind = config::FieldKind::constant;
    profile.temperature.profile.points = {{0.0, 20.0}, {200.0, 40.0}};
    for (const auto& [config, key] : {std::pair{field, "field.kind = \"constant\""}, {profile, "temperature.profile"}})
        try {
            (void)gyro_drift(config);
            ADD_FAILURE() << key;
        } catch (const config::ConfigError& error) {
            EXPECT_EQ(std::string{error.what()}.find(key), 0u) << error.what();
        }
}

TEST(RunDrift, is_the_law_or_what_profile_and_field_make_of_it) {
    config::Config c;
    EXPECT_EQ(RunDrift{c}.magnetic_arcsec(100.0, 101.0), design::magnetic_integral_arcsec(gyro_drift(c), 100.0, 101.0));
    // By half of the rise of 20 C half of the growth.
    c.temperature.profile.points = {{0.0, 20.0}, {200.0, 40.0}};
    EXPECT_NEAR(RunDrift{c}.magnetic_arcsec(99.0, 101.0), 2.0 * (0.7 + 0.35), 1e-12);
    c.field = {
        .kind = config::FieldKind::constant, .field_g = 0.5, .sensitivity_arcsec_s_g = 4.0, .sensitivity_per_c = -0.01};
    EXPECT_NEAR(RunDrift{c}.magnetic_arcsec(99.0, 101.0), 2.0 * 2.0 * 0.9, 1e-12);
    c.temperature.profile = {};
    EXPECT_NEAR(RunDrift{c}.magnetic_arcsec(2999.0, 3001.0), 2.0 * 2.0 * (1.0 - 0.2 * (1.0 - std::exp(-1.0))), 1e-12);
}

}  // namespace zlg::study::gyro_drift_test
