#pragma once
// The noise of a gyro as Kalibr's imu.yaml has it.

#include <string>

#include <zlg/noise/noise_units.hpp>

namespace zlg::noise {

// Its keys gyroscope_noise_density, gyroscope_random_walk and update_rate, with the units as comments. The keys of an
// accelerometer are left to be filled in. Kalibr itself refuses a random walk of 0.
[[nodiscard]] std::string imu_yaml(const KalibrGyro& gyro);

}  // namespace zlg::noise
