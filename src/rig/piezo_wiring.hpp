#pragma once
// What the control presumes of the piezo.

#include <zlg/config/config.hpp>

namespace zlg::rig {

[[nodiscard]] inline double presumed_half_wave_v(const config::Config& config) {
    return config.piezo.half_wave_v * (1.0 + config.piezo.half_wave_error);
}

[[nodiscard]] inline bool has_no_hysteresis_or_creep(const config::Config& config) {
    return config.piezo.hysteresis == 0.0 && config.piezo.creep_per_decade == 0.0;
}

}  // namespace zlg::rig
