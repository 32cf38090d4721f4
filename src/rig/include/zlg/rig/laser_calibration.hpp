#pragma once
// What a perfect calibration would tell the processor of a gyro whose laser is known.

#include <zlg/config/config.hpp>

namespace zlg::rig {

// The constants that the processor is given, and how well they describe the laser.
struct LaserCalibration {
    config::Config config;
    double third_wave_lambda = 0.0;          // detuning from which a third wave bends the discriminator
    double curve_error_lambda = 0.0;         // largest error of the inverse discriminator up to there
    double curve_error_beyond_lambda = 0.0;  // and from there to the last point
    double chi_error_ratio = 0.0;            // largest departure of the bias from its law, within 0.1 wavelength
};

// The configuration with gyro.bias_hz, bias_chi and discriminator_per_lambda, and the calibrated points of the
// discriminator in [perimeter], as they follow from [laser].
//
// Whatever the fidelity: an averaged gyro then agrees with the laser where both are valid.
// accuracy  of the inverse discriminator through these points: 2e-4 wavelength with two waves, 5e-3 with three.
// errors    config::ConfigError where [laser] does not make a gyro.
// cost      about 50 ms.
[[nodiscard]] LaserCalibration calibration_of_laser(const config::Config& config);
[[nodiscard]] config::Config calibrated_by_laser(const config::Config& config);

}  // namespace zlg::rig
