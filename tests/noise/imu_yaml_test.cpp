#include <zlg/noise/imu_yaml.hpp>

#include "test.hpp"

namespace zlg::noise::imu_yaml_test {

TEST(ImuYaml, holds_the_numbers_to_the_bit) {
    const double density = 5.8177e-7 / 3.0;
    const std::string text = imu_yaml(
        {.noise_density_rad_s_sqrt_hz = density, .random_walk_rad_s2_sqrt_hz = 1.1e-9, .update_rate_hz = 200.0});
    const auto value = [&](const std::string& key) {
        return std::stod(text.substr(text.find("\n" + key + ": ") + key.size() + 3));
    };
    EXPECT_EQ(value("gyroscope_noise_density"), density);
    EXPECT_EQ(value("gyroscope_random_walk"), 1.1e-9);
    EXPECT_EQ(value("update_rate"), 200.0);
}

TEST(ImuYaml, a_limit_is_called_so) {
    KalibrGyro gyro{.noise_density_rad_s_sqrt_hz = 1e-6, .random_walk_rad_s2_sqrt_hz = 1e-9, .update_rate_hz = 200.0};
    EXPECT_EQ(imu_yaml(gyro).find("limit"), std::string::npos);
    gyro.random_walk_is_limit = true;
    zlg::test::expect_contains(imu_yaml(gyro), "upper limit, none was found");
}

}  // namespace zlg::noise::imu_yaml_test
