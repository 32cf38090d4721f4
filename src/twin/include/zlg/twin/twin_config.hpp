#pragma once
// What makes a twin: the gyro at rest in its numbers, and what breaks in it.

#include <cstdint>
#include <limits>
#include <vector>

#include <zlg/twin/environment_config.hpp>
#include <zlg/twin/faults.hpp>
#include <zlg/twin/gyro_config.hpp>
#include <zlg/twin/laser_config.hpp>

namespace zlg::twin {

struct AveragedLaser;

inline constexpr double timer_hz = 1e7;  // of the gyro's timer, which stamps and shifts reversals

// Sections of a configuration, each member within the range of its key, and what the twin needs beside them.
struct TwinConfig {
    std::uint64_t seed = 1;
    GyroConfig gyro{};
    DriftConfig drift{};
    TemperatureConfig temperature{};  // its files are read
    FieldConfig field{};              // the same
    PerimeterConfig perimeter{};
    PiezoConfig piezo{};
    LightConfig light{};
    PhotodiodesConfig photodiodes{};

    // Of fidelity laser alone, which in turn takes its bias, chi and discriminator from the gas and its random walk
    // from lock-in: gyro.bias_hz, bias_chi and discriminator_per_lambda and drift.random_walk_arcsec_sqrt_s do nothing
    // there.
    LaserConfig laser{};

    double coil_noise_a = 0.001;  // of the coil's current as it is read, whose plateau is 1 A; 12 bits for +-2 A
    double counter_max_hz = std::numeric_limits<double>::infinity();  // faster fringes are lost

    std::vector<Fault> faults{};  // in any order
    double vibration_hz = default_vibration_hz;
};

// The averaged gyro of the same bias: its mean over a half, edges included, in counts; chi; the slope of the
// discriminator.
[[nodiscard]] GyroConfig with_laser(GyroConfig gyro, Quadrature quadrature, const AveragedLaser& laser);

}  // namespace zlg::twin
