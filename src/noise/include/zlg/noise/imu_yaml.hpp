#pragma once
// The noise of a gyro as Kalibr's imu.yaml has it.

#include <string>

#include <zlg/noise/noise_units.hpp>

namespace zlg::noise {

// The keys gyroscope_noise_density, gyroscope_random_walk and update_rate, at the top or one level down, as in imu0.
//
// errors  logs::IoError: the file cannot be read; logs::FormatError: it is no YAML, a key is missing, a value is not a
//         number above 0 (the random walk: 0 or more).
[[nodiscard]] KalibrGyro read_imu_yaml(const std::string& path);

// The same keys with the units as comments. The keys of an accelerometer are left to be filled in. Kalibr itself
// refuses a random walk of 0.
[[nodiscard]] std::string imu_yaml(const KalibrGyro& gyro);

}  // namespace zlg::noise
