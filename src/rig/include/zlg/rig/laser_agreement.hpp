#pragma once
// What a laser implies of the constants that its processor presumes: taken together or not at all.

#include <string>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::rig {

struct LaserAgreement {
    config::Config config;
    std::vector<std::string> notes;     // what was taken from [laser]
    std::vector<std::string> warnings;  // what contradicts it, with both values
};

// Of a gyro of fidelity laser: gyro.bias_hz, gyro.bias_chi, gyro.discriminator_per_lambda, the calibrated points of
// [perimeter] with their centre, gyro.scale_arcsec and drift.random_walk_arcsec_sqrt_s follow from [laser]. Where what
// is given of them (config::is_given) agrees with the laser, the others are taken from it. Where something given
// contradicts it, the processor is a wrongly calibrated one: nothing is taken, and each constant that is off is named.
// A slope that is given without points is the whole law of the discriminator.
//
// The scale is that of a square ring. A given one contradicts it below 0.78 of that, which
// no plane ring of this perimeter has, and above 1.31, a triangle. The random walk is that of lock-in and quantum
// noise; a given one contradicts nothing, for a gyro may have more reasons to walk.
//
// Of a gyro of fidelity averaged, whose discriminator is linear and whose bias is largest where the loop settles,
// nothing is taken; points in [perimeter] that read such a discriminator wrongly are named, and so is a centre that is
// not 0.
//
// errors  config::ConfigError where [laser] does not make a gyro.
// cost    that of calibration_of_laser.
[[nodiscard]] LaserAgreement agreed_with_laser(const config::Config& config);

}  // namespace zlg::rig
