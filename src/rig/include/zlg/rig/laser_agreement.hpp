#pragma once
// What a laser implies of the constants that its processor presumes.

#include <string>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::rig {

struct LaserAgreement {
    config::Config config;
    std::vector<std::string> notes;     // what was taken from [laser]
    std::vector<std::string> warnings;  // what is given and contradicts it, with both values
};

// Of a gyro of fidelity laser: gyro.bias_hz, gyro.bias_chi, gyro.discriminator_per_lambda, the calibrated points of
// [perimeter] with their centre, gyro.scale_arcsec and drift.random_walk_arcsec_sqrt_s follow from [laser], but for
// what is given of them (config::is_given). A number that is given and contradicts the laser is named. A slope that is
// given without points is the whole law of the discriminator.
//
// The scale is that of a square ring. The random walk is that of lock-in and quantum noise; a given one contradicts
// nothing, for a gyro may have more reasons to walk. Of any other fidelity nothing is taken.
//
// errors  config::ConfigError where [laser] does not make a gyro.
// cost    that of calibration_of_laser.
[[nodiscard]] LaserAgreement agreed_with_laser(const config::Config& config);

}  // namespace zlg::rig
