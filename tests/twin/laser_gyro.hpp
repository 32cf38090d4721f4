#pragma once
// Gyros of fidelity `laser` without noise or drift: what they are held against has no quantum noise either.

#include "quiet_gyro.hpp"

namespace zlg::twin {

inline TwinConfig as_laser(TwinConfig config, double lock_hz = 0.0) {
    config.gyro.fidelity = Fidelity::laser;
    config.laser.beam_power_w = 0.0;
    config.laser.lock_in_left_hz = lock_hz;
    config.laser.lock_in_right_hz = lock_hz;
    return config;
}

}  // namespace zlg::twin
