#include <zlg/noise/imu_yaml.hpp>

#include <fmt/format.h>

namespace zlg::noise {

std::string imu_yaml(const KalibrGyro& gyro) {
    return fmt::format(
        "# accelerometer_noise_density:  # m/s^2/sqrt(Hz), not known here\n"
        "# accelerometer_random_walk:    # m/s^3/sqrt(Hz), not known here\n"
        "gyroscope_noise_density: {}  # rad/s/sqrt(Hz), continuous: angle random walk\n"
        "gyroscope_random_walk: {}  # rad/s^2/sqrt(Hz), continuous: rate random walk{}\nrostopic: /imu0\n"
        "update_rate: {}  # Hz\n",
        gyro.noise_density_rad_s_sqrt_hz, gyro.random_walk_rad_s2_sqrt_hz,
        gyro.random_walk_is_limit ? "; upper limit, none was found" : "", gyro.update_rate_hz);
}

}  // namespace zlg::noise
