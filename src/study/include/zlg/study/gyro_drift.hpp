#pragma once
// The drift of a configuration, as the theory has it.

#include <zlg/config/config.hpp>
#include <zlg/design/magnetic_angle.hpp>

namespace zlg::study {

inline design::GyroDrift gyro_drift(const config::Config& config) {
    const config::Drift& d = config.drift;
    return {.nonmagnetic_arcsec_s = d.nonmagnetic_arcsec_s,
            .magnetic_arcsec_s = d.magnetic_arcsec_s,
            .magnetic_thermal_arcsec_s = d.magnetic_thermal_arcsec_s,
            .thermal_time_s = d.thermal_time_s};
}

}  // namespace zlg::study
